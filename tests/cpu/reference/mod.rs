//! The CPU twins, compared with definitions, closed forms and each other.

mod colour;
mod coverage;
mod detect;
mod edge;
#[path = "../../common/meshes.rs"]
mod meshes;
mod visibility;

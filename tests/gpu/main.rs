//! The renderer on a device, under the validation layer, against the exact twins of `gpc::reference`.

mod area;
mod blend;
mod coverage;
mod detect;
mod environment;
mod extremes;
mod golden;
#[path = "../common/golden.rs"]
mod goldens;
mod grow;
mod invariance;
mod lobes;
mod mask;
#[path = "../common/meshes.rs"]
mod meshes;
mod methods;
mod partition;
mod region;
mod scenes;
mod shade;
mod sites;
mod soundness;
mod stage;
mod ties;
mod twin;
mod variation;
mod visibility;

//! Geometry that is hard on a rasterizer, and what must hold of its images.

pub mod meshes;
mod random;
pub mod stage;

pub use meshes::Mesh;
pub use random::Random;

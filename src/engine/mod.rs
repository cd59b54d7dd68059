//! What hosts compile: Vulkan, the passes that antialias triangles, and the interface to an application's own frames.
//!
//! Nothing in this folder knows a file format, a material or a light, and no item in it depends on a feature.

pub mod color;
pub(crate) mod data;
pub mod host;
pub(crate) mod passes;
pub(crate) mod pipelines;
pub(crate) mod sampler;
pub mod sampling;
pub mod vulkan;

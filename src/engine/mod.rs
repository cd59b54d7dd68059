//! The engine, which is all that hosts need: Vulkan, the passes that antialias triangles, and the interface for an
//! application's own frames.
//!
//! Nothing in this folder depends on a file format, a material, a light or a feature.

pub mod color;
pub(crate) mod data;
pub mod host;
pub(crate) mod passes;
pub(crate) mod pipelines;
pub(crate) mod sampler;
pub mod sampling;
pub mod vulkan;

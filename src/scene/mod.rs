//! The scene: what a glTF file holds, and its triangles in the pose of one moment.
//!
//! Nothing here knows of Vulkan. [`load`](fn@load::load) reads a file into a [`Scene`];
//! [`Scene::pose`] flattens one of its scenes into world-space [`Geometry`] that a renderer uploads.

mod geometry;
mod light;
mod material;
mod view;

pub use geometry::{Draw, DrawClass, Geometry, VertexStreams};
pub use light::{Light, LightKind};
pub use material::{
    AlphaMode, Filter, Image, Material, Sampler, Texture, TextureTransform, TextureUse, Wrap,
};
pub use view::{SceneCamera, SceneProjection};

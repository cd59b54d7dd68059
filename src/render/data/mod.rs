//! Device data that passes read: geometry, materials, textures and lights of scenes, and the cells of an output.

mod geometry;
mod output_cells;
#[cfg(test)]
mod rows;
mod scene;

pub use geometry::FrameGeometry;
pub use output_cells::{OutputCells, OutputPlane};
pub(in crate::render) use scene::MaterialBin;
pub use scene::{AlphaUse, FrameLook, GpuScene, SceneUploads};

//! Passes that shade and pose scenes of files, and the scene data that they read. A pass has the name of its shader in
//! `shaders/`.

mod beside_frame;
mod crossings;
mod geometry;
mod neighbours;
mod output_cells;
mod pose;
pub mod prefilter;
mod receivers;
mod scene;
mod shade;
mod shadow;
mod stroke;

pub use crossings::{Crossings, MarkedOutput, SeenLocation};
pub use geometry::FrameGeometry;
pub use neighbours::Neighbours;
pub use output_cells::{OutputCells, OutputPlane};
pub use pose::Pose;
pub use receivers::{LightPlane, Receivers, Receiving};
pub use scene::{FrameLook, GpuScene, SceneUploads};
pub use shade::{Shade, ShadeSource};
pub use shadow::{Shadow, ShadowTarget};
pub use stroke::{Stroke, StrokeSizes};

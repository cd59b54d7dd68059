//! The passes that shade and pose scenes of files, named like their shaders in `shaders/`, and what they read of a scene.

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

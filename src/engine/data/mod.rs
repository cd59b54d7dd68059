//! Memory of a frame that the passes read and write, and the layouts of the data in it.

pub(crate) mod alpha_flags;
mod color_constants;
mod content;
mod counters;
mod draws;
mod host_image;
mod locations;
mod resources;
pub(crate) mod tiles;
mod triangle_word;
pub(crate) mod upload;
mod visibility;

/// Uniform block `Frame` of `shaders/include/frame.glsl`, whose comments explain the fields.
pub use crate::engine::spirv::Frame as FrameUniform;
pub use color_constants::ColorConstants;
pub use content::Content;
pub(crate) use counters::STRETCH;
pub use counters::{Argument, Counter};
pub(crate) use draws::{Draws, HostDraw};
pub(crate) use host_image::HostImage;
pub use locations::{CellSizes, Cells, ListedLocation, LocationSizes};
pub use resources::{Data, IdViews, Offsets, ResourceRequest, ResourceSizes, Resources, SampleSet, Scratch, ShownIds};
pub(crate) use triangle_word::TriangleWord;
pub(crate) use visibility::{VisibilityUniform, VisibleGeometry, visibility_layout};

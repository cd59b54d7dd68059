//! The second pass: from cells (superpixels of an image, locations of a list) to their colours, in rounds.

pub(crate) mod color;
pub(crate) mod engine;
mod error;
pub(crate) mod footprint;
pub(crate) mod image_state;
pub(crate) mod list;
pub(crate) mod plan;
mod settings;
pub(crate) mod statistics;

pub use error::RenderError;
pub use image_state::ImageState;
pub use settings::{
    Coverage, Detection, Footprint, Method, PixelRect, Reference, Settings, Shading, Shadows,
};
pub use statistics::{PassTime, Statistics, TriangleCounts};

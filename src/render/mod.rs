//! Rendering: a scene and a camera in, an image out.
//!
//! [`Renderer`] works in a host's device and command buffers; [`Headless`] owns a device and is built on it.

mod color;
mod engine;
mod error;
mod footprint;
mod frame;
mod headless;
mod plan;
mod renderer;
mod settings;
mod sites;
mod statistics;

pub use error::RenderError;
pub use frame::{Frame, ImageState, Target};
pub use headless::{Headless, HeadlessOptions, PixelAttributes, Rendered};
pub use renderer::{PreparedScene, Renderer};
pub use settings::{
    Coverage, Detection, Footprint, Method, PixelRect, Reference, Settings, Shading, Shadows,
};
pub use sites::{PointSample, Sampled, SiteError};
pub use statistics::{PassTime, Statistics, TriangleCounts};

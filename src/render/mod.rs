//! Rendering: a scene and a camera in, an image out.
//!
//! [`Renderer`] works in a host's device and command buffers; [`Headless`] owns a device and is built on it.

#[cfg(feature = "gltf")]
mod backdrop;
mod color;
mod error;
pub(crate) mod footprint;
#[cfg(feature = "gltf")]
mod frame;
#[cfg(feature = "gltf")]
mod headless;
pub(crate) mod image_state;
#[cfg(feature = "gltf")]
mod locations;
pub(crate) mod plan;
#[cfg(feature = "gltf")]
mod plane;
#[cfg(feature = "gltf")]
mod renderer;
pub(crate) mod sampler;
mod settings;
#[cfg(feature = "gltf")]
mod shadows;
pub(crate) mod statistics;
pub(crate) mod uniform;
#[cfg(feature = "gltf")]
mod viewpoint;

pub use error::RenderError;
#[cfg(feature = "gltf")]
pub use frame::{Frame, Target};
#[cfg(feature = "gltf")]
pub use headless::{Headless, HeadlessOptions, PixelAttributes, Rendered};
pub use image_state::ImageState;
#[cfg(feature = "gltf")]
pub use locations::{LocationError, PointSample, Sampled};
#[cfg(feature = "gltf")]
pub use renderer::{PreparedScene, Renderer};
pub use settings::{
    Coverage, Detection, Footprint, Method, PixelRect, Reference, Settings, Shading, Shadows,
};
pub use statistics::{PassTime, Statistics, TriangleCounts};

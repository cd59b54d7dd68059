//! Rendering: a scene and a camera in, an image out.
//!
//! [`Renderer`] works in a host's device and command buffers; [`Headless`] owns a device and is built on it.

mod backdrop;
pub mod camera;
mod frame;
mod headless;
mod locations;
mod pass_list;
pub(crate) mod passes;
mod plane;
mod renderer;
pub mod scene;
mod shadows;
mod viewpoint;

pub use crate::engine::passes::Encoding;
pub use crate::engine::sampler::{
    Coverage, Detection, Footprint, ImageState, Method, PassTime, PixelRect, Reference,
    RenderError, Settings, Shading, Shadows, Statistics, TriangleCounts,
};
pub use frame::{Frame, Target};
pub use headless::{Headless, HeadlessOptions, PixelAttributes, Rendered};
pub use locations::{LocationError, PointSample, Sampled};
pub use pass_list::FramePass;
pub use renderer::{PreparedScene, Renderer, SceneRequest};

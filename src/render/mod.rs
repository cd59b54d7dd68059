//! Rendering: makes an image from a scene and a camera.
//!
//! [`Renderer`] works in a host's device and command buffers; [`Headless`] has a device of its own and is built on
//! [`Renderer`].

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

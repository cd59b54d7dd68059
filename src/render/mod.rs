//! Rendering: makes an image from a scene and a camera.
//!
//! [`Renderer`] works in a host's device and command buffers. [`Headless`] is built on [`Renderer`]: it submits the
//! commands and waits for them, in a device that it opens or in a host's device.

mod accumulate;
mod backdrop;
pub mod camera;
mod data;
mod error;
mod frame;
mod headless;
mod locations;
mod pass_list;
pub(crate) mod passes;
mod pixel;
mod plane;
mod random;
mod renderer;
pub mod scene;
mod settings;
mod shadows;
#[doc(hidden)]
pub mod testing;
mod viewpoint;

pub use crate::engine::sampler::{
    CellOptions, Detection, EngineError, Footprint, ImageState, Method, MethodKind, PassTime, PixelRect, Reference,
    Shading, Statistics, SuperpixelOptions, TriangleCounts,
};
pub use error::RenderError;
pub use frame::{SceneFrame, Target};
pub use headless::{Headless, HeadlessOptions, PixelAttributes, Rendered};
pub use locations::{LocationError, PointSample, Sampled};
pub use pass_list::{FramePass, RecordedPasses};
pub use passes::Encoding;
pub use pixel::Pixel;
pub use renderer::{PreparedScene, Renderer, SceneRequest};
pub use settings::{SceneSettings, Settings, Shadows};

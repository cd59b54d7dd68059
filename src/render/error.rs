//! Errors of rendering a scene.

use super::locations::LocationError;
use crate::engine::sampler::{EngineError, MethodKind};
use crate::sampling::{FilterShape, PatternError};
use crate::vulkan::VulkanError;

/// An error of the renderer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The settings are impossible, memory runs out, or the device refuses something.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// Method that can't sample locations.
    #[error("{method} can't sample locations; none, superpixel and ssaa can")]
    LocationMethod {
        /// Method of the request.
        method: MethodKind,
    },
    /// Region in a request for locations: only the pixels of an image have regions.
    #[error("a region is a part of an image's pixels; of locations, hand over those that are wanted")]
    LocationRegion,
    /// Pixel filter in a request for a list of locations that make no image.
    #[error(
        "a {shape} filter reaches beyond the pixel, and the locations of a list have no neighbours; take the box, or an image"
    )]
    LocationFilter {
        /// Shape of the filter that was asked for.
        shape: FilterShape,
    },
    /// Width of lines, or size of points, that is not above 0 and at most the limit.
    #[error(
        "lines or points of {0} pixels: their width or size must be above 0 and at most {limit}",
        limit = super::SceneSettings::LARGEST_STROKE
    )]
    Stroke(f32),
    /// A sampling location can't be used.
    #[error(transparent)]
    Location(#[from] LocationError),
    /// The geometry contradicts itself.
    #[error(transparent)]
    Geometry(#[from] crate::scene::GeometryError),
    /// A scene or frame was made for another device.
    #[error("a scene or frame of one device was handed to another")]
    OtherDevice,
    /// A moment or pose is not of the motion that it was handed to.
    #[error(
        "a moment or pose of one motion was handed to another: Scene::pose_in_motion makes pose and motion together"
    )]
    OtherMotion,
    /// A scene is not on the device yet.
    #[error("the scene is not on the device: Headless::upload puts it there")]
    NotUploaded,
    /// A frame was prepared for another type of pixel than its image is read as.
    #[error(
        "the frame was prepared for pixels in the encoding {prepared:?}, and its image is read as {read:?}: name the same type of pixel in Headless::prepare_pixels and render_pixels"
    )]
    OtherPixels {
        /// Encoding that the frame was prepared with; `None` for floats of 32 bits.
        prepared: Option<super::Encoding>,
        /// Encoding of the type of pixel.
        read: Option<super::Encoding>,
    },
    /// Accumulation of pixels that are no light.
    #[error("accumulation averages light: prepare the frame for pixels of [f32; 4]")]
    AccumulatedPixels,
    /// Result that the function of `Headless::stop_when` no longer wants.
    #[error("what was being made is no longer wanted")]
    Stopped,
    /// A camera makes no pinhole.
    #[error(transparent)]
    Pinhole(#[from] crate::camera::PinholeError),
    /// The scene was prepared without shadows.
    #[error("the scene was prepared without shadows: ask for them in its SceneRequest")]
    NoCasters,
    /// More than 32 lights for exact shadows: each shaded point has 32 bits for lights.
    #[error("{found} lights can't all cast shadows; 32 can")]
    ShadowLights {
        /// Number of lights.
        found: usize,
    },
}

impl From<VulkanError> for RenderError {
    fn from(error: VulkanError) -> Self {
        Self::Engine(error.into())
    }
}

impl From<PatternError> for RenderError {
    fn from(error: PatternError) -> Self {
        Self::Engine(error.into())
    }
}

impl RenderError {
    /// Whether the request was impossible, so that other settings or inputs are needed.
    #[must_use]
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Engine(error) => error.is_usage(),
            Self::Location(_)
            | Self::Pinhole(_)
            | Self::LocationMethod { .. }
            | Self::LocationRegion
            | Self::LocationFilter { .. }
            | Self::Stroke(_)
            | Self::ShadowLights { .. } => true,
            _ => false,
        }
    }

    /// Whether the device is lost or out of memory.
    #[must_use]
    pub fn is_device_failure(&self) -> bool {
        matches!(self, Self::Engine(error) if error.is_device_failure())
    }
}

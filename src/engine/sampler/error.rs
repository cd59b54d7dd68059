//! What can go wrong with a frame.

use super::PixelRect;
#[cfg(feature = "gltf")]
use crate::render::LocationError;
use crate::sampling::PatternError;
use crate::vulkan::VulkanError;

/// An error of the renderer.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device refuses.
    #[error(transparent)]
    Vulkan(#[from] VulkanError),
    /// The pattern can't have that many sub-samples.
    #[error(transparent)]
    Pattern(#[from] PatternError),
    /// Multisampling samples pixels.
    #[error("msaa samples the pixels of an image, not any locations; ask another method")]
    LocationMethod,
    /// A region of an image has no pixels or leaves the image.
    #[error(
        "a region of {} x {} pixels from column {}, row {}: it must have pixels and lie in the image of {} x {}",
        region.size[0], region.size[1], region.corner[0], region.corner[1], image[0], image[1]
    )]
    Region {
        /// The region.
        region: PixelRect,
        /// Width and height of the image.
        image: [u32; 2],
    },
    /// Only the pixels of an image have regions.
    #[error(
        "a region is a part of an image's pixels; of locations, hand over those that are wanted"
    )]
    LocationRegion,
    /// A sampling location can't be used.
    #[cfg(feature = "gltf")]
    #[error(transparent)]
    Location(#[from] LocationError),
    /// The geometry contradicts itself.
    #[cfg(feature = "gltf")]
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
    /// `Headless::stop_when` said so.
    #[cfg(feature = "gltf")]
    #[error("what was being made is no longer wanted")]
    Stopped,
    /// A camera makes no pinhole.
    #[cfg(feature = "gltf")]
    #[error(transparent)]
    Pinhole(#[from] crate::camera::PinholeError),
    /// The scene was prepared without shadows.
    #[error("the scene was prepared without shadows: ask for them in its SceneRequest")]
    NoCasters,
    /// A point has 32 bits for lights.
    #[error("{found} lights can't all cast shadows; 32 can")]
    ShadowLights {
        /// How many there are.
        found: usize,
    },
    /// The method can't have that many samples.
    #[error("{method} can't have {asked} samples a pixel; it can have {possible}")]
    Samples {
        /// The method's name.
        method: &'static str,
        /// What was asked for.
        asked: u32,
        /// What can be had.
        possible: String,
    },
    /// Multisampling has several IDs a pixel.
    #[error("msaa has no one depth, ID or normal a pixel; ask another method for them")]
    Attributes,
    /// Texture levels can't be chosen for a footprint of that side.
    #[error("texture levels for a square of {0} pixels: its side must be above 0 and at most 1")]
    Footprint(f32),
    /// Lines or points can't be of that size.
    #[error(
        "lines or points of {0} pixels: their width or size must be above 0 and at most {limit}",
        limit = super::Settings::LARGEST_STROKE
    )]
    Stroke(f32),
    /// A number of the background is not finite.
    #[error("a background of {0:?}: its light must be finite")]
    Background([f32; 3]),
    /// The image has no pixels or too many.
    #[error("an image of {width} x {height} pixels: each side must be from 1 to {limit}")]
    Size {
        /// Asked width.
        width: u32,
        /// Asked height.
        height: u32,
        /// Largest side.
        limit: u32,
    },
    /// Not even the smallest part of the image fits.
    #[error(
        "{needed} bytes of device memory are needed at the least, and the bound on it allows {allowed}"
    )]
    Memory {
        /// The least that will do.
        needed: u64,
        /// What is allowed.
        allowed: u64,
    },
    /// Lists of records outgrew their memory in every round, or lists of triangles what a kernel can walk: one pixel
    /// shows tens of thousands of them.
    #[error(
        "{cells} superpixels have more records than fit in memory, even in parts, or more triangles in them than can be listed; ask for a larger image or fewer samples, or allow more memory"
    )]
    Unfinished {
        /// How many superpixels or tiles are left.
        cells: u64,
    },
    /// The format of a host's image is not one of those that can be written.
    #[error(
        "a target of format {0:?}: it can be R8G8B8A8_UNORM, R8G8B8A8_SRGB, R16G16B16A16_SFLOAT or R32G32B32A32_SFLOAT"
    )]
    TargetFormat(ash::vk::Format),
}

impl RenderError {
    /// Whether what was asked for can't be had from this method at all.
    #[must_use]
    pub fn is_usage(&self) -> bool {
        #[cfg(feature = "gltf")]
        if matches!(self, Self::Location(_) | Self::Pinhole(_)) {
            return true;
        }
        matches!(
            self,
            Self::Pattern(_)
                | Self::Samples { .. }
                | Self::LocationMethod
                | Self::LocationRegion
                | Self::Region { .. }
                | Self::ShadowLights { .. }
                | Self::Attributes
                | Self::Footprint(_)
                | Self::Stroke(_)
                | Self::Background(_)
                | Self::Size { .. }
        )
    }

    /// Whether the device is lost or out of memory.
    #[must_use]
    pub fn is_device_failure(&self) -> bool {
        match self {
            Self::Vulkan(error) => error.is_device_failure(),
            Self::Memory { .. } | Self::Unfinished { .. } => true,
            _ => false,
        }
    }
}

//! What can go wrong in the engine.

use super::PixelRect;
use crate::sampling::PatternError;
use crate::vulkan::VulkanError;

/// An error of the engine that samples triangles.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// The device refuses.
    #[error(transparent)]
    Vulkan(#[from] VulkanError),
    /// The pattern can't have that many sub-samples.
    #[error(transparent)]
    Pattern(#[from] PatternError),
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
}

impl EngineError {
    /// Whether what was asked for can't be had from this method at all.
    #[must_use]
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Pattern(_)
                | Self::Samples { .. }
                | Self::Region { .. }
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

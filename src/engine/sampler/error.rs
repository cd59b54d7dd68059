//! Errors of the engine.

use super::PixelRect;
use crate::sampling::{FilterError, PatternError};
use crate::vulkan::VulkanError;

/// An error of the engine that samples triangles.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// Error of the device.
    #[error(transparent)]
    Vulkan(#[from] VulkanError),
    /// Number of samples that the pattern can't have.
    #[error(transparent)]
    Pattern(#[from] PatternError),
    /// Pixel filter with an impossible radius.
    #[error(transparent)]
    Filter(#[from] FilterError),
    /// Region of an image that has no pixels or leaves the image.
    #[error(
        "a region of {} x {} pixels from column {}, row {}: it must have pixels and lie in the image of {} x {}",
        region.size[0], region.size[1], region.corner[0], region.corner[1], image[0], image[1]
    )]
    Region {
        /// The region that was asked for.
        region: PixelRect,
        /// Width and height of the image.
        image: [u32; 2],
    },
    /// Number of samples that the method can't have.
    #[error("{method} can't have {asked} samples a pixel; it can have {possible}")]
    Samples {
        /// Name of the method.
        method: &'static str,
        /// Number that was asked for.
        asked: u32,
        /// Possible numbers, in words.
        possible: String,
    },
    /// Number of growths that is too large.
    #[error("superpixels can't grow {asked} times; they can grow 0 to {most} times")]
    Growths {
        /// Number that was asked for.
        asked: u8,
        /// Largest number.
        most: u8,
    },
    /// Attributes with multisampling or accumulation, which have several IDs in a pixel.
    #[error("msaa and accumulation have no one depth, ID or normal a pixel; ask another method for them")]
    Attributes,
    /// Footprint with a side that is not above 0 and at most 1.
    #[error("texture levels for a square of {0} pixels: its side must be above 0 and at most 1")]
    Footprint(f32),
    /// Background with a component that is not finite.
    #[error("a background of {0:?}: its light must be finite")]
    Background([f32; 3]),
    /// Image without pixels, or with too many.
    #[error("an image of {width} x {height} pixels: each side must be from 1 to {limit}")]
    Size {
        /// Width that was asked for.
        width: u32,
        /// Height that was asked for.
        height: u32,
        /// Largest possible width and height.
        limit: u32,
    },
    /// Limit for memory that is too small even for the smallest part of the image.
    #[error("{needed} bytes of device memory are needed at the least, and the bound on it allows {allowed}")]
    Memory {
        /// Smallest number of bytes that suffices.
        needed: u64,
        /// Number of bytes that is allowed.
        allowed: u64,
    },
    /// Superpixels that could not be finished: their visibility samples did not fit into memory, or their tiles had
    /// more triangles than a kernel can process, for example because one pixel shows tens of thousands of triangles.
    #[error(
        "{cells} superpixels have more visibility samples than fit in memory, even in parts, or more triangles in them than can be listed; ask for a larger image or fewer samples, or allow more memory"
    )]
    Unfinished {
        /// Number of superpixels or tiles that were not finished.
        cells: u64,
    },
}

impl EngineError {
    /// Whether the request was impossible, so that other settings or inputs are needed.
    #[must_use]
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Pattern(_)
                | Self::Filter(_)
                | Self::Samples { .. }
                | Self::Region { .. }
                | Self::Attributes
                | Self::Footprint(_)
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

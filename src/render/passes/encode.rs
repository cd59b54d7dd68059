//! encode: converts colours to the format of a host's image.

use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};
use ash::vk;

/// Formats of a host's image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// sRGB-encoded, premultiplied: `R8G8B8A8_UNORM` or `R8G8B8A8_SRGB`.
    Rgba8,
    /// Linear, premultiplied: `R16G16B16A16_SFLOAT`.
    Rgba16Float,
    /// Linear, premultiplied: `R32G32B32A32_SFLOAT`; needs no conversion.
    Rgba32Float,
}

impl Encoding {
    /// Encoding for a Vulkan format, if it is supported.
    #[must_use]
    pub fn of(format: vk::Format) -> Option<Self> {
        match format {
            vk::Format::R8G8B8A8_UNORM | vk::Format::R8G8B8A8_SRGB => Some(Self::Rgba8),
            vk::Format::R16G16B16A16_SFLOAT => Some(Self::Rgba16Float),
            vk::Format::R32G32B32A32_SFLOAT => Some(Self::Rgba32Float),
            _ => None,
        }
    }

    /// Bytes of a pixel in the buffer that the pass writes; 0 where none is needed.
    pub(crate) fn encoded_bytes(self) -> u64 {
        match self {
            Self::Rgba8 => 4,
            Self::Rgba16Float => 8,
            Self::Rgba32Float => 0,
        }
    }
}

/// Converts the colours of a region's pixels.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, encoding: Encoding) -> Result<Pass, VulkanError> {
    let format = match encoding {
        Encoding::Rgba16Float => spirv::ENCODE_RGBA16F,
        Encoding::Rgba8 | Encoding::Rgba32Float => spirv::ENCODE_RGBA8_SRGB,
    };
    let encode = layout.kernel(&spirv::Encode { format })?;
    let dispatch = encode.dispatch((), Size::Items(1));
    Ok(Pass::named(spirv::Encode::INTERFACE).dispatch(dispatch))
}

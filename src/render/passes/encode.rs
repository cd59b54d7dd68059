//! encode: converts colours to the format of a host's image.

use crate::engine::passes::spirv;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

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

    /// Bytes of a pixel in the buffer that [`Encode`] writes; 0 where none is needed.
    pub(crate) fn encoded_bytes(self) -> u64 {
        match self {
            Self::Rgba8 => 4,
            Self::Rgba16Float => 8,
            Self::Rgba32Float => 0,
        }
    }
}

/// Converts a region's colours.
pub struct Encode {
    pipeline: Arc<Pipeline>,
}

impl Encode {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, encoding: Encoding) -> Result<Self, VulkanError> {
        let format = match encoding {
            Encoding::Rgba16Float => spirv::ENCODE_RGBA16F,
            Encoding::Rgba8 | Encoding::Rgba32Float => spirv::ENCODE_RGBA8_SRGB,
        };
        Ok(Self {
            pipeline: layout.compute(&spirv::Encode { format }, None)?,
        })
    }

    /// Records the pass for a region of `pixels` pixels.
    pub fn record(&self, recorder: &Recorder<'_>, pixels: u32) {
        recorder.dispatch_each(&self.pipeline, u64::from(pixels));
    }
}

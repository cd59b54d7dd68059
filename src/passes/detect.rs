//! detect: which pixels are superpixels.

use super::{FrameLayout, spirv};
use crate::vulkan::{Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// What makes a pixel a superpixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DetectMode {
    /// A neighbour with a contrasting colour.
    Contrast,
    /// A neighbour with another triangle and a contrasting colour.
    Edges,
    /// A neighbour with another triangle.
    Exact,
    /// A BLEND triangle at its centre.
    Blended,
    /// Every pixel is one.
    Every,
}

/// Writes the mask of superpixels.
pub struct Detect {
    pipeline: Arc<Pipeline>,
}

impl Detect {
    /// Makes the pipeline; `blend_ids` compares the nearest BLEND triangles too, `thin` adds what
    /// [`Thin`](super::Thin) marked, `transparent` compares alpha too, `multisampled` reads the IDs of a multisampled raster (for
    /// [`DetectMode::Blended`]), places have so many words of shadows, pixels `beyond` the region's own become superpixels
    /// too, for [`Grow`](super::Grow).
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(
        layout: &FrameLayout,
        mode: DetectMode,
        blend_ids: bool,
        thin: bool,
        transparent: bool,
        multisampled: bool,
        shadow_words: u32,
        beyond: u32,
    ) -> Result<Self, VulkanError> {
        let constants = Constants::new()
            .with(0, mode as u32)
            .flag(1, blend_ids)
            .flag(2, thin)
            .flag(3, transparent)
            .with(4, beyond)
            .with(25, shadow_words);
        let code = if multisampled {
            spirv::DETECT_MULTISAMPLED
        } else {
            spirv::DETECT
        };
        Ok(Self {
            pipeline: layout.compute(code, &constants, None)?,
        })
    }

    /// Records it for a region of `tiles` tiles.
    pub fn record(&self, recorder: &Recorder<'_>, tiles: u32) {
        recorder.dispatch(&self.pipeline, u64::from(tiles.div_ceil(64)));
    }
}

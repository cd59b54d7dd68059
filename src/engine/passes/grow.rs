//! grow: pixels that contrast with a superpixel beside them become superpixels.

use super::spirv;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Puts the pixels that [`Resolve`](super::Resolve) marked in the place of the superpixels that it resolved.
pub struct Grow {
    pipeline: Arc<Pipeline>,
}

impl Grow {
    /// Makes the pipeline; so many pixels `beyond` the region's own grow too, for another growth.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, beyond: u32) -> Result<Self, VulkanError> {
        Ok(Self {
            pipeline: layout.compute(&spirv::Grow { beyond }, None)?,
        })
    }

    /// Records it for a region of `tiles` tiles.
    pub fn record(&self, recorder: &Recorder<'_>, tiles: u32) {
        recorder.dispatch(&self.pipeline, u64::from(tiles.div_ceil(64)));
    }
}

//! grow: makes pixels superpixels if they contrast with a neighbouring superpixel.

use super::spirv;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Replaces the resolved superpixels in the masks by the pixels that [`Resolve`](super::Resolve) marked.
pub struct Grow {
    pipeline: Arc<Pipeline>,
}

impl Grow {
    /// Makes the pipeline. Pixels in a border of `beyond` pixels around the region grow too, because a later growth
    /// compares with them.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, beyond: u32) -> Result<Self, VulkanError> {
        Ok(Self {
            pipeline: layout.compute(&spirv::Grow { beyond }, None)?,
        })
    }

    /// Records the pass for a region of `tiles` tiles.
    pub fn record(&self, recorder: &Recorder<'_>, tiles: u32) {
        recorder.dispatch_each(&self.pipeline, u64::from(tiles));
    }
}

//! box_filter: averages k x k supersampled pixels.

use crate::engine::passes::spirv;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Averages squares of pixels.
pub struct BoxFilter {
    pipeline: Arc<Pipeline>,
}

impl BoxFilter {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout) -> Result<Self, VulkanError> {
        Ok(Self {
            pipeline: layout.compute(&spirv::BoxFilter, None)?,
        })
    }

    /// Records the pass for a region that becomes `pixels` pixels, each the mean of `side` x `side`.
    pub fn record(&self, recorder: &Recorder<'_>, pixels: u32, side: u32) {
        recorder.push(&self.pipeline, &spirv::BoxFilterPush { side });
        recorder.dispatch_each(&self.pipeline, u64::from(pixels));
    }
}

//! multisample: turns the device's multisampling into visibility samples.

use crate::engine::passes::spirv;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Turns multisampled triangle IDs into visibility samples.
pub struct Multisample {
    pipeline: Arc<Pipeline>,
}

impl Multisample {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        Ok(Self {
            pipeline: layout.compute(&spirv::Multisample { lanes }, None)?,
        })
    }

    /// Records the pass for a region of `tiles` tiles.
    pub fn record(&self, recorder: &Recorder<'_>, tiles: u32) {
        recorder.dispatch_each(&self.pipeline, u64::from(tiles * 32));
    }
}

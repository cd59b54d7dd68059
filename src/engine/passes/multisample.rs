//! multisample: what the device's own multisampling saw, as visibility samples.

use super::{FrameLayout, spirv};
use crate::vulkan::{Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Turns multisampled triangle IDs into records.
pub struct Multisample {
    pipeline: Arc<Pipeline>,
}

impl Multisample {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout) -> Result<Self, VulkanError> {
        let pipeline = layout.compute(
            spirv::MULTISAMPLE,
            &Constants::new().with(1, layout.gpu.limits().lanes),
            None,
        )?;
        Ok(Self { pipeline })
    }

    /// Records it for a region of `tiles` tiles.
    pub fn record(&self, recorder: &Recorder<'_>, tiles: u32) {
        recorder.dispatch(&self.pipeline, u64::from((tiles * 32).div_ceil(64)));
    }
}

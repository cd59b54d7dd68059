//! setup: triangles as edge functions around the tiles they touch.

use super::{Argument, FrameLayout, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError, compute_pipeline};

/// Fills the lists that `schedule` has placed.
pub struct Setup {
    pipeline: Pipeline,
}

impl Setup {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout) -> Result<Self, VulkanError> {
        let pipeline = compute_pipeline(
            &layout.gpu,
            layout.pipeline,
            spirv::SETUP,
            &Constants::new(),
            None,
        )?;
        Ok(Self { pipeline })
    }

    /// Records it over the pairs.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Setup as u32);
    }
}

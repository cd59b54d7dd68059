//! setup: triangles as edge functions around the tiles they touch.

use super::{Argument, FrameLayout, GpuScene, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Fills the lists that `schedule` has placed.
pub struct Setup {
    pipeline: Arc<Pipeline>,
}

impl Setup {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, scene: &GpuScene) -> Result<Self, VulkanError> {
        let pipeline = layout.compute(
            spirv::SETUP,
            &scene.geometry.constants(Constants::new()),
            None,
        )?;
        Ok(Self { pipeline })
    }

    /// Records it over the pairs.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Setup as u32);
    }
}

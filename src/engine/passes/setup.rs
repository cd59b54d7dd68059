//! setup: computes edge functions of triangles around the tiles that they touch.

use super::spirv;
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Fills the lists of candidates that `enlist` has allocated.
pub struct Setup {
    pipeline: Arc<Pipeline>,
}

impl Setup {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, scene: &dyn Content) -> Result<Self, VulkanError> {
        let instanced = scene.is_instanced();
        Ok(Self {
            pipeline: layout.compute(&spirv::Setup { instanced }, None)?,
        })
    }

    /// Records the pass over the pairs.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Setup as u32);
    }
}

//! cull: the triangles that can touch a superpixel.

use super::{Argument, Content, FrameLayout, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Compacts triangles; runs over none where nothing was detected.
pub struct Cull {
    arguments: Arc<Pipeline>,
    pipeline: Arc<Pipeline>,
}

impl Cull {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, scene: &dyn Content) -> Result<Self, VulkanError> {
        let make = |code, constants| layout.compute(code, &constants, None);
        Ok(Self {
            arguments: make(spirv::ARGUMENTS, Constants::new().with(0, 0))?,
            pipeline: make(spirv::CULL, scene.constants(Constants::new()))?,
        })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch(&self.arguments, 1);
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Cull as u32);
    }
}

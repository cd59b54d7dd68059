//! groups: the groups of cells of a round, where cells are sites.

use super::{Argument, FrameLayout, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Lists them by what their samples need, and sizes the dispatches over them.
pub struct Groups {
    pipeline: Arc<Pipeline>,
    arguments: Arc<Pipeline>,
}

impl Groups {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout) -> Result<Self, VulkanError> {
        let make = |code, constants| layout.compute(code, &constants, None);
        Ok(Self {
            pipeline: make(spirv::GROUPS, Constants::new())?,
            arguments: make(spirv::ARGUMENTS, Constants::new().with(0, 6))?,
        })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Groups as u32);
        recorder.dispatch(&self.arguments, 1);
    }
}

//! groups: the groups of cells of a round, where cells are sites.

use super::{Argument, FrameLayout, Sample, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Lists them by what their samples need, and sizes the dispatches over them.
pub struct Groups {
    pipeline: Arc<Pipeline>,
    arguments: Arc<Pipeline>,
}

impl Groups {
    /// Makes the pipelines for what `sample` takes.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, sample: &Sample) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let make = |code, constants| layout.compute(code, &constants, None);
        Ok(Self {
            pipeline: make(
                spirv::GROUPS,
                sample
                    .options()
                    .cells
                    .constants(Constants::new())
                    .with(1, lanes),
            )?,
            arguments: make(spirv::ARGUMENTS, sample.subgroups().clone().with(0, 6))?,
        })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Groups as u32);
        recorder.dispatch(&self.arguments, 1);
    }
}

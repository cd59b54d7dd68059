//! groups: the groups of cells of a round, where cells are locations.

use super::arguments::{After, Arguments};
use super::{Argument, FrameLayout, Sample, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Lists them by what their samples need, and sizes the dispatches over them.
pub struct Groups {
    pipeline: Arc<Pipeline>,
    arguments: Arguments,
}

impl Groups {
    /// Makes the pipelines for what `sample` takes.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, sample: &Sample) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let cells = sample.options().cells;
        let constants = cells.constants(Constants::new()).with(1, lanes);
        Ok(Self {
            pipeline: layout.compute(spirv::GROUPS, &constants, None)?,
            arguments: Arguments::of_samples(layout, After::Groups, sample.subgroups())?,
        })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Groups as u32);
        self.arguments.record(recorder);
    }
}

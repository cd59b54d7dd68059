//! schedule: which tiles' lists are placed in a round.

use super::{FrameLayout, RecordRate, Sample, spirv};
use crate::vulkan::{Constants, Pipeline, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Places as many lists as fit.
pub struct Schedule {
    layout: vk::PipelineLayout,
    pipeline: Arc<Pipeline>,
    /// As `shaders/schedule.comp` takes them.
    pushed: [u32; 6],
}

impl Schedule {
    /// Makes the pipeline for what `sample` writes. Tiles are admitted with `layers` BLEND layers a list and twice as
    /// many lists a block, or more where these are shaded by part; without layers, with four times as many records a
    /// block where a cell has several.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, sample: &Sample, layers: u32) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let options = sample.options();
        let constants = options.cells.constants(Constants::new());
        let constants = layout.lane_constants(constants, lanes).with(0, lanes);
        let [first, all] = sample.subgroups();
        let per_sample = u32::from(options.records == RecordRate::Sample);
        Ok(Self {
            layout: layout.pipeline,
            pipeline: layout.compute(spirv::SCHEDULE, &constants, layout.subgroup())?,
            pushed: [
                sample.block(),
                per_sample,
                layers,
                sample.parts(),
                first,
                all,
            ],
        })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>) {
        recorder.push(self.layout, &self.pushed);
        recorder.dispatch(&self.pipeline, 1);
    }
}

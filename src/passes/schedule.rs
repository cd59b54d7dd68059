//! tally, schedule, enlist: which tiles are in a round, and where their lists are.

use super::{Argument, FrameLayout, RecordRate, Sample, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Takes as many tiles into a round as fit.
pub struct Schedule {
    layout: vk::PipelineLayout,
    tally: Arc<Pipeline>,
    schedule: Arc<Pipeline>,
    enlist: Arc<Pipeline>,
    /// As `shaders/include/load.glsl` takes them.
    pushed: [u32; 6],
}

impl Schedule {
    /// Makes the pipelines for what `sample` writes. Tiles are admitted with `layers` BLEND layers a list and twice as
    /// many lists a block, or more where these are shaded by part; without layers, with four times as many records a
    /// block where a cell has several.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, sample: &Sample, layers: u32) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let options = sample.options();
        let constants = options.cells.constants(Constants::new());
        let constants = layout.lane_constants(constants, lanes).with(0, lanes);
        let make = |code| layout.compute(code, &constants, layout.subgroup());
        let [first, all] = sample.subgroups();
        let per_sample = u32::from(options.records == RecordRate::Sample);
        Ok(Self {
            layout: layout.pipeline,
            tally: make(spirv::TALLY)?,
            schedule: make(spirv::SCHEDULE)?,
            enlist: make(spirv::ENLIST)?,
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

    /// Records what is done once for all rounds, after `bin`.
    pub fn record_tally(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.push(self.layout, &self.pushed);
        recorder.dispatch_indirect(&self.tally, arguments, Argument::Tally as u32);
    }

    /// Records what begins a round.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.push(self.layout, &self.pushed);
        recorder.dispatch(&self.schedule, 1);
        recorder.dispatch_indirect(&self.enlist, arguments, Argument::Enlist as u32);
    }
}

//! schedule: which tiles' lists are placed in a round.

use super::{FrameLayout, RecordRate, Sample, spirv};
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Places as many lists as fit.
pub struct Schedule {
    pipeline: Arc<Pipeline>,
}

impl Schedule {
    /// Makes the pipeline for what `sample` writes. Tiles are admitted with `layers` BLEND layers a chain and twice as
    /// many chains a block, or more where these are shaded by part; without layers, with four times as many records a
    /// block where a cell has several.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, sample: &Sample, layers: u32) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let records = sample.options().records;
        let cells = sample.options().cells;
        let constants = cells.constants(sample.subgroups().clone());
        let constants = layout
            .lane_constants(constants, lanes)
            .with(0, lanes)
            .with(2, sample.block())
            .flag(3, records == RecordRate::Sample)
            .with(4, layers)
            .with(5, sample.parts());
        let pipeline = layout.compute(spirv::SCHEDULE, &constants, layout.subgroup())?;
        Ok(Self { pipeline })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>) {
        recorder.dispatch(&self.pipeline, 1);
    }
}

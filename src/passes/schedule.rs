//! schedule: which tiles' lists are placed in a round.

use super::{FrameLayout, RecordRate, Sample, TileList, spirv};
use crate::vulkan::{Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Places as many lists as fit.
pub struct Schedule {
    pipeline: Arc<Pipeline>,
}

impl Schedule {
    /// Makes the pipeline for what `sample` writes; `layers` is the number of BLEND layers a sample that tiles
    /// are admitted with.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, sample: &Sample, layers: u32) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().subgroup_size;
        let records = sample.options().records;
        let constants = sample
            .options()
            .cells
            .constants(Constants::new())
            .with(0, lanes)
            .with(1, lanes)
            .with(7, sample.block(TileList::Plain))
            .with(2, sample.block(TileList::Masked))
            .flag(3, records == RecordRate::Sample)
            .with(4, layers)
            .with(5, if records == RecordRate::Part { 8 } else { 1 })
            .flag(6, sample.options().apart);
        let pipeline = layout.compute(spirv::SCHEDULE, &constants, Some(lanes))?;
        Ok(Self { pipeline })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>) {
        recorder.dispatch(&self.pipeline, 1);
    }
}

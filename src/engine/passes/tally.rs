//! tally: adds up what the tiles of each stretch need, so that `schedule` takes stretches instead of tiles.

use super::spirv;
use crate::engine::data::{Argument, Cells};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Adds up the needs of the tiles of each stretch.
pub(super) struct Tally {
    pipeline: Arc<Pipeline>,
}

impl Tally {
    /// Makes the pipeline for tiles of these cells.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, cells: Cells) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let shader = spirv::Tally {
            local_size: lanes,
            lanes,
            locations: cells.are_locations(),
            points: cells.are_points(),
            unsure: layout.is_unsure(lanes),
        };
        Ok(Self {
            pipeline: layout.compute(&shader, layout.subgroup())?,
        })
    }

    /// Records the pass, over all stretches.
    pub fn record(&self, recorder: &Recorder<'_>, pushed: &spirv::TallyPush, arguments: &Buffer) {
        recorder.push(&self.pipeline, pushed);
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Tally as u32);
    }
}

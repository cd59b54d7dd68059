//! enlist: gives the tiles of a round their places in its memory, and enters them in the work lists.

use super::spirv;
use crate::engine::data::{Argument, Cells};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Allocates the lists of a round's tiles, and lists its work.
pub(super) struct Enlist {
    pipeline: Arc<Pipeline>,
}

impl Enlist {
    /// Makes the pipeline for tiles of these cells.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, cells: Cells) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let shader = spirv::Enlist {
            local_size: lanes,
            lanes,
            locations: cells.are_locations(),
            unsure: layout.is_unsure(lanes),
        };
        Ok(Self {
            pipeline: layout.compute(&shader, layout.subgroup())?,
        })
    }

    /// Records the pass, over the stretches of the round.
    pub fn record(&self, recorder: &Recorder<'_>, pushed: &spirv::EnlistPush, arguments: &Buffer) {
        recorder.push(&self.pipeline, pushed);
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Enlist as u32);
    }
}

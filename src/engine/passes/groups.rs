//! groups: the groups of cells of a round, where cells are locations.

use super::arguments::{After, Arguments};
use super::{Sample, spirv};
use crate::engine::data::Argument;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, VulkanError};
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
        let shader = spirv::Groups {
            lanes,
            locations: cells.are_locations(),
            points: cells.are_points(),
            occluders: cells.are_occluders(),
        };
        Ok(Self {
            pipeline: layout.compute(&shader, None)?,
            arguments: Arguments::of_samples(layout, After::Groups, sample.subgroups())?,
        })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Groups as u32);
        self.arguments.record(recorder);
    }
}

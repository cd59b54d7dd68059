//! groups: lists the groups of cells of a round, for cells that are locations.

use super::arguments::{After, Arguments};
use super::{Sample, spirv};
use crate::engine::data::Argument;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, Specialized, VulkanError};
use std::sync::Arc;

/// Lists groups by the kernel that their samples need, and computes the sizes of the dispatches over them.
pub struct Groups {
    pipeline: Arc<Pipeline>,
    arguments: Arguments,
}

impl Groups {
    /// Makes the pipelines for the lists of `sample`.
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

    /// Records the pass.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.pass(spirv::Groups::INTERFACE, || {
            recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Groups as u32);
            self.arguments.record(recorder);
        });
    }
}

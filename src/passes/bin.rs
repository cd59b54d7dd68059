//! bin: triangles into lists per tile.

use super::{Argument, FrameLayout, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError, compute_pipeline};

/// Counts, then scatters.
pub struct Bin {
    arguments: Pipeline,
    count: [Pipeline; 2],
    scatter: [Pipeline; 2],
}

impl Bin {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout) -> Result<Self, VulkanError> {
        let make = |code, constants| {
            compute_pipeline(&layout.gpu, layout.pipeline, code, &constants, None)
        };
        let bin =
            |scatter, large| make(spirv::BIN, Constants::new().flag(0, scatter).flag(1, large));
        Ok(Self {
            arguments: make(spirv::ARGUMENTS, Constants::new().with(0, 1))?,
            count: [bin(false, false)?, bin(false, true)?],
            scatter: [bin(true, false)?, bin(true, true)?],
        })
    }

    /// Records the count of every tile's list.
    pub fn record_count(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch(&self.arguments, 1);
        Self::run(&self.count, recorder, arguments);
    }

    /// Records the writing of the lists that `schedule` has placed.
    pub fn record_scatter(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        Self::run(&self.scatter, recorder, arguments);
    }

    fn run(pipelines: &[Pipeline; 2], recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch_indirect(&pipelines[0], arguments, Argument::BinSmall as u32);
        recorder.dispatch_indirect(&pipelines[1], arguments, Argument::BinLarge as u32);
    }
}

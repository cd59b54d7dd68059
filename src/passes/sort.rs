//! sort: visibility records ordered by material bin.

use super::{Argument, Content, FrameLayout, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// A counting sort over the records of a round.
pub struct Sort {
    before: Arc<Pipeline>,
    /// Count, sizes of dispatches, scatter; not needed for a single bin.
    passes: Option<[Arc<Pipeline>; 3]>,
}

impl Sort {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        scene: &dyn Content,
        one_bin: bool,
    ) -> Result<Self, VulkanError> {
        let make = |code, constants| layout.compute(code, &constants, None);
        let sort = |scatter| {
            make(
                spirv::SORT,
                scene.constants(Constants::new().flag(0, scatter)),
            )
        };
        let before = make(spirv::ARGUMENTS, Constants::new().with(0, 2))?;
        let passes = if one_bin {
            None
        } else {
            Some([
                sort(false)?,
                make(spirv::ARGUMENTS, Constants::new().with(0, 3))?,
                sort(true)?,
            ])
        };
        Ok(Self { before, passes })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>, bins: &Buffer, arguments: &Buffer) {
        recorder.clear(bins);
        recorder.barrier();
        recorder.dispatch(&self.before, 1);
        if let Some([count, sizes, scatter]) = &self.passes {
            recorder.dispatch_indirect(count, arguments, Argument::Sort as u32);
            recorder.dispatch(sizes, 1);
            recorder.dispatch_indirect(scatter, arguments, Argument::Sort as u32);
        }
    }
}

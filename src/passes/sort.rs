//! sort: visibility records ordered by material bin.

use super::arguments::{After, Arguments};
use super::{Argument, Content, FrameLayout, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// A counting sort over the records of a round.
pub struct Sort {
    before: Arguments,
    /// Not needed for a single bin.
    passes: Option<Passes>,
}

struct Passes {
    count: Arc<Pipeline>,
    arguments: Arguments,
    scatter: Arc<Pipeline>,
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
        let sort = |scatter| {
            let constants = scene.constants(Constants::new().flag(0, scatter));
            layout.compute(spirv::SORT, &constants, None)
        };
        let passes = || {
            Ok::<_, VulkanError>(Passes {
                count: sort(false)?,
                arguments: Arguments::new(layout, After::Records)?,
                scatter: sort(true)?,
            })
        };
        Ok(Self {
            before: Arguments::new(layout, After::Sample)?,
            passes: (!one_bin).then(passes).transpose()?,
        })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>, bins: &Buffer, arguments: &Buffer) {
        recorder.clear(bins);
        recorder.barrier();
        self.before.record(recorder);
        if let Some(passes) = &self.passes {
            recorder.dispatch_indirect(&passes.count, arguments, Argument::Sort as u32);
            passes.arguments.record(recorder);
            recorder.dispatch_indirect(&passes.scatter, arguments, Argument::Sort as u32);
        }
    }
}

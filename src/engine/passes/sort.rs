//! sort: visibility samples ordered by material bin.

use super::arguments::{After, Arguments};
use super::spirv;
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// A counting sort over the records of a round.
pub struct Sort {
    layout: vk::PipelineLayout,
    before: Arguments,
    /// Not needed for a single bin.
    passes: Option<Passes>,
}

struct Passes {
    pipeline: Arc<Pipeline>,
    arguments: Arguments,
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
        let passes = || {
            let instanced = scene.is_instanced();
            Ok::<_, VulkanError>(Passes {
                pipeline: layout.compute(&spirv::Sort { instanced }, None)?,
                arguments: Arguments::new(layout, After::Records)?,
            })
        };
        Ok(Self {
            layout: layout.pipeline,
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
            let run = |scatter| {
                recorder.push(self.layout, &spirv::SortPush { scatter });
                recorder.dispatch_indirect(&passes.pipeline, arguments, Argument::Sort as u32);
            };
            run(0);
            passes.arguments.record(recorder);
            run(1);
        }
    }
}

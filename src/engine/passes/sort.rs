//! sort: sorts visibility samples by material bin.

use super::arguments::{After, Arguments};
use super::spirv;
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, Specialized, VulkanError};
use std::sync::Arc;

/// Counting sort of a round's visibility samples.
pub struct Sort {
    before: Arguments,
    /// Passes of the sort; `None` for a single bin.
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
            let lanes = layout.gpu.limits().lanes;
            let shader = spirv::Sort {
                local_size: lanes,
                lanes,
                instanced: scene.is_instanced(),
                unsure: layout.is_unsure(lanes),
            };
            Ok::<_, VulkanError>(Passes {
                pipeline: layout.compute(&shader, layout.subgroup())?,
                arguments: Arguments::new(layout, After::Records)?,
            })
        };
        Ok(Self {
            before: Arguments::new(layout, After::Sample)?,
            passes: (!one_bin).then(passes).transpose()?,
        })
    }

    /// Records the pass.
    pub fn record(&self, recorder: &Recorder<'_>, bins: &Buffer, arguments: &Buffer) {
        recorder.pass(spirv::Sort::INTERFACE, || {
            recorder.clear(bins);
            self.before.record(recorder);
            if let Some(passes) = &self.passes {
                let run = |scatter| {
                    recorder.push(&passes.pipeline, &spirv::SortPush { scatter });
                    recorder.dispatch_indirect(&passes.pipeline, arguments, Argument::Sort as u32);
                };
                run(0);
                passes.arguments.record(recorder);
                run(1);
            }
        });
    }
}

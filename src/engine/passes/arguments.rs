//! arguments: what passes counted, as the sizes of the dispatches that follow.

use super::spirv;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// What has counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(crate) enum After {
    Detect = spirv::AFTER_DETECT,
    Cull = spirv::AFTER_CULL,
    Sample = spirv::AFTER_SAMPLE,
    Records = spirv::AFTER_RECORDS,
    Spans = spirv::AFTER_SPANS,
    Thin = spirv::AFTER_THIN,
    Groups = spirv::AFTER_GROUPS,
    Probe = spirv::AFTER_PROBE,
    Pairs = spirv::AFTER_PAIRS,
}

/// One kernel for all that counts: drivers take longer to compile one than to run it.
pub(crate) struct Arguments {
    layout: vk::PipelineLayout,
    pipeline: Arc<Pipeline>,
    /// What has counted, and the subgroups that [`Sample`](super::Sample) gives an entry of a list, in a first run and where it
    /// takes all samples.
    pushed: spirv::ArgumentsPush,
}

impl Arguments {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, after: After) -> Result<Self, VulkanError> {
        Self::of_samples(layout, after, [1, 1])
    }

    /// The same where entries of lists were counted, each of which takes so many subgroups: in a first run, and for all
    /// samples.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn of_samples(
        layout: &FrameLayout,
        after: After,
        [first, all]: [u32; 2],
    ) -> Result<Self, VulkanError> {
        Ok(Self {
            layout: layout.pipeline,
            pipeline: layout.compute(&spirv::Arguments, None)?,
            pushed: spirv::ArgumentsPush {
                after: after as u32,
                subgroups_first: first,
                subgroups: all,
            },
        })
    }

    /// Records it.
    pub fn record(&self, recorder: &Recorder<'_>) {
        recorder.push(self.layout, &self.pushed);
        recorder.dispatch(&self.pipeline, 1);
    }
}

//! arguments: turns the counts of a pass into the sizes of the dispatches that follow.

use super::spirv;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Pass whose counts are used.
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
    Scatter = spirv::AFTER_SCATTER,
}

/// Writes the sizes of dispatches. One kernel serves all passes that count, because drivers take longer to compile a
/// kernel than to run it.
pub(crate) struct Arguments {
    pipeline: Arc<Pipeline>,
    /// Push constants: the pass that counted, and the numbers of subgroups that [`Sample`](super::Sample) uses for an
    /// entry of a list: in the first run, in a run with all samples, and for tiles without a list.
    pushed: spirv::ArgumentsPush,
}

impl Arguments {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, after: After) -> Result<Self, VulkanError> {
        Self::of_samples(layout, after, [1; 3])
    }

    /// Makes the pipeline for the entries of lists. An entry takes `first` subgroups in the first run, `all` in a run
    /// with all samples, and `unlisted` for tiles without a list.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of_samples(
        layout: &FrameLayout,
        after: After,
        [first, all, unlisted]: [u32; 3],
    ) -> Result<Self, VulkanError> {
        Ok(Self {
            pipeline: layout.compute(&spirv::Arguments, None)?,
            pushed: spirv::ArgumentsPush {
                after: after as u32,
                subgroups_first: first,
                subgroups: all,
                subgroups_unlisted: unlisted,
            },
        })
    }

    /// Records the pass.
    pub fn record(&self, recorder: &Recorder<'_>) {
        recorder.push(&self.pipeline, &self.pushed);
        recorder.dispatch(&self.pipeline, 1);
    }
}

//! sort: what is to be shaded, ordered by material bin.

use super::{Argument, FrameLayout, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError, compute_pipeline};

/// What is sorted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SortSource {
    /// Every pixel of a region; background pixels get their colour and, where asked, their display code.
    Pixels {
        /// Write display codes for detection.
        display_codes: bool,
    },
    /// Visibility records.
    Records,
}

/// A counting sort.
pub struct Sort {
    source: SortSource,
    before: Pipeline,
    count: Pipeline,
    between: Pipeline,
    scatter: Pipeline,
}

impl Sort {
    /// Makes the pipelines; `output` are the colour constants of `shaders/include/color.glsl`.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        source: SortSource,
        output: &Constants,
    ) -> Result<Self, VulkanError> {
        let make = |code, constants| {
            compute_pipeline(&layout.gpu, layout.pipeline, code, &constants, None)
        };
        let pixels = source != SortSource::Records;
        let codes = source
            == SortSource::Pixels {
                display_codes: true,
            };
        let sort = |scatter| {
            make(
                spirv::SORT,
                output
                    .clone()
                    .flag(0, scatter)
                    .flag(1, pixels)
                    .flag(2, codes),
            )
        };
        Ok(Self {
            source,
            before: make(spirv::ARGUMENTS, Constants::new().with(0, 2))?,
            count: sort(false)?,
            between: make(spirv::ARGUMENTS, Constants::new().with(0, 3))?,
            scatter: sort(true)?,
        })
    }

    /// Records it, over `pixels` pixels or the records of the round.
    pub fn record(&self, recorder: &Recorder<'_>, bins: &Buffer, arguments: &Buffer, pixels: u32) {
        recorder.clear(bins);
        recorder.barrier();
        let run = |pipeline| match self.source {
            SortSource::Pixels { .. } => {
                recorder.dispatch(pipeline, u64::from(pixels.div_ceil(64)))
            }
            SortSource::Records => {
                recorder.dispatch_indirect(pipeline, arguments, Argument::Sort as u32)
            }
        };
        if self.source == SortSource::Records {
            recorder.dispatch(&self.before, 1);
        }
        run(&self.count);
        recorder.dispatch(&self.between, 1);
        run(&self.scatter);
    }

    /// Records only the sizes of dispatches over records, for a scene with one bin.
    pub fn record_sizes(&self, recorder: &Recorder<'_>) {
        recorder.dispatch(&self.before, 1);
    }
}

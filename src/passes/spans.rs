//! spans: rows of 8 pixels, listed by material bin.

use super::{FrameLayout, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError, compute_pipeline};

/// Lists what of a region is to be shaded; background pixels get their colour.
pub struct Spans {
    count: Pipeline,
    arguments: Pipeline,
    scatter: Pipeline,
}

impl Spans {
    /// Makes the pipelines; `output` are the colour constants of `shaders/include/color.glsl`.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        one_bin: bool,
        display_codes: bool,
        output: &Constants,
    ) -> Result<Self, VulkanError> {
        let make =
            |code, constants| compute_pipeline(&layout.gpu, layout.pipeline, code, &constants, None);
        let spans = |scatter| {
            let constants = output.clone().flag(0, scatter).flag(1, display_codes).flag(2, one_bin);
            make(spirv::SPANS, constants)
        };
        Ok(Self {
            count: spans(false)?,
            arguments: make(spirv::ARGUMENTS, Constants::new().with(0, 4))?,
            scatter: spans(true)?,
        })
    }

    /// Records it for a region of `width` x `height` pixels.
    pub fn record(&self, recorder: &Recorder<'_>, bins: &Buffer, [width, height]: [u32; 2]) {
        let groups = (u64::from(width.div_ceil(8)) * u64::from(height)).div_ceil(64);
        recorder.clear(bins);
        recorder.barrier();
        recorder.dispatch(&self.count, groups);
        recorder.dispatch(&self.arguments, 1);
        recorder.dispatch(&self.scatter, groups);
    }
}

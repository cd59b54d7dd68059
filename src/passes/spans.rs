//! spans: rows of 8 pixels, listed by material bin.

use super::arguments::{After, Arguments};
use super::{Content, FrameLayout, spirv};
use crate::vulkan::{Buffer, Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Lists what of a region is to be shaded.
pub struct Spans {
    /// Not needed for a single bin.
    count: Option<Arc<Pipeline>>,
    scatter: Arc<Pipeline>,
    arguments: Arguments,
}

impl Spans {
    /// Invocations of a workgroup, which may be several subgroups.
    const WORKGROUP: u32 = 64;

    /// Makes the pipelines.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, scene: &dyn Content) -> Result<Self, VulkanError> {
        let one_bin = scene.bin_count() == 1;
        let size = layout.gpu.limits().subgroup_size.min(Self::WORKGROUP);
        let spans = |scatter| {
            let constants = scene.constants(Constants::new());
            let constants = layout
                .lane_constants(constants, size)
                .flag(0, scatter)
                .flag(2, one_bin);
            layout.compute(spirv::SPANS, &constants, layout.subgroup())
        };
        Ok(Self {
            count: if one_bin { None } else { Some(spans(false)?) },
            scatter: spans(true)?,
            arguments: Arguments::new(layout, After::Spans)?,
        })
    }

    /// Records it for a region of `width` x `height` pixels.
    pub fn record(&self, recorder: &Recorder<'_>, bins: &Buffer, [width, height]: [u32; 2]) {
        let groups = (u64::from(width.div_ceil(8)) * u64::from(height)).div_ceil(64);
        recorder.clear(bins);
        recorder.barrier();
        let first = self.count.as_ref().unwrap_or(&self.scatter);
        recorder.dispatch(first, groups);
        self.arguments.record(recorder);
        if self.count.is_some() {
            recorder.dispatch(&self.scatter, groups);
        }
    }
}

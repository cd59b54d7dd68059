//! spans: lists rows of 8 pixels by material bin.

use crate::engine::data::Content;
use crate::engine::passes::arguments::{After, Arguments};
use crate::engine::passes::spirv;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, Specialized, VulkanError};
use std::sync::Arc;

/// Lists the pixels of a region that need shading.
pub struct Spans {
    pipeline: Arc<Pipeline>,
    /// Whether there is a single bin, so that spans need not be counted first.
    one_bin: bool,
    arguments: Arguments,
}

impl Spans {
    /// Number of invocations of a workgroup, which may contain several subgroups.
    const WORKGROUP: u32 = 64;

    /// Makes the pipelines.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, scene: &dyn Content) -> Result<Self, VulkanError> {
        let one_bin = scene.bin_count() == 1;
        let lanes = layout.gpu.limits().subgroup_size.min(Self::WORKGROUP);
        let shader = spirv::Spans {
            lanes,
            one_bin,
            instanced: scene.is_instanced(),
            unsure: layout.is_unsure(lanes),
        };
        Ok(Self {
            pipeline: layout.compute(&shader, layout.subgroup())?,
            one_bin,
            arguments: Arguments::new(layout, After::Spans)?,
        })
    }

    /// Records the pass for a region of `width` x `height` pixels.
    pub fn record(&self, recorder: &Recorder<'_>, bins: &Buffer, [width, height]: [u32; 2]) {
        let groups = (u64::from(width.div_ceil(8)) * u64::from(height)).div_ceil(64);
        recorder.pass(spirv::Spans::INTERFACE, || {
            recorder.clear(bins);
            let run = |scatter| {
                recorder.push(&self.pipeline, &spirv::SpansPush { scatter });
                recorder.dispatch(&self.pipeline, groups);
            };
            run(u32::from(self.one_bin));
            self.arguments.record(recorder);
            if !self.one_bin {
                run(1);
            }
        });
    }
}

//! thin: finds pixels that a thin triangle crosses without covering the centre.

use super::arguments::{After, Arguments};
use super::spirv;
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, Specialized, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Marks pixels, which `detect` makes superpixels.
pub struct Thin {
    layout: vk::PipelineLayout,
    select: Arc<Pipeline>,
    arguments: Arguments,
    walk: Arc<Pipeline>,
}

impl Thin {
    /// Makes the pipelines. `blend_ids` looks for BLEND triangles among the nearest ones; `farther_is_larger` says
    /// whether larger values of the drawn depth are farther away.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        scene: &dyn Content,
        blend_ids: bool,
        farther_is_larger: bool,
    ) -> Result<Self, VulkanError> {
        let thin = |select| {
            let shader = spirv::Thin {
                select,
                blend_ids,
                farther_is_larger,
                instanced: scene.is_instanced(),
            };
            layout.compute(&shader, None)
        };
        Ok(Self {
            layout: layout.pipeline,
            select: thin(true)?,
            arguments: Arguments::new(layout, After::Thin)?,
            walk: thin(false)?,
        })
    }

    /// Records the pass for a scene with `index_count` indices of triangles; `marks` is cleared first.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        marks: &Buffer,
        arguments: &Buffer,
        indices: u32,
    ) {
        recorder.pass(spirv::Thin::INTERFACE, || {
            recorder.clear(marks);
            let invocations = indices.div_ceil(spirv::THIN_PER_INVOCATION);
            recorder.dispatch_each(&self.select, u64::from(invocations));
            self.arguments.record(recorder);
            recorder.unordered(|| {
                for (long, argument) in [(0, Argument::Thin), (1, Argument::ThinLong)] {
                    recorder.push(self.layout, &spirv::ThinPush { long });
                    recorder.dispatch_indirect(&self.walk, arguments, argument as u32);
                }
            });
        });
    }
}

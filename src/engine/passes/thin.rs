//! thin: finds pixels that a thin triangle crosses without covering the centre.

use super::arguments::{After, Arguments};
use super::spirv;
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, Specialized, VulkanError};
use std::sync::Arc;

/// Marks pixels that `detect` turns into superpixels.
pub struct Thin {
    select: Arc<Pipeline>,
    arguments: Arguments,
    walk: Arc<Pipeline>,
    /// Factor and offset that convert values of the depth image to reversed depth, in which larger values are nearer.
    depth_of_image: [f32; 2],
}

impl Thin {
    /// Makes the pipelines. `blend_ids` says whether BLEND triangles are looked up in the IDs of the nearest BLEND
    /// triangles. `depth_of_image` holds the factor and the offset that convert values of the depth image to reversed
    /// depth.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        scene: &dyn Content,
        blend_ids: bool,
        depth_of_image: [f32; 2],
    ) -> Result<Self, VulkanError> {
        let thin = |select| {
            let shader = spirv::Thin {
                select,
                blend_ids,
                instanced: scene.is_instanced(),
            };
            layout.compute(&shader, None)
        };
        Ok(Self {
            select: thin(true)?,
            arguments: Arguments::new(layout, After::Thin)?,
            walk: thin(false)?,
            depth_of_image,
        })
    }

    /// Records the pass for a scene with `indices` triangle slots. `marks` is cleared first.
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
                    let [depth_factor, depth_constant] = self.depth_of_image;
                    let push = spirv::ThinPush {
                        long,
                        depth_factor,
                        depth_constant,
                    };
                    recorder.push(&self.walk, &push);
                    recorder.dispatch_indirect(&self.walk, arguments, argument as u32);
                }
            });
        });
    }
}

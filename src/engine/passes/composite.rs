//! composite: blends the layers that samples see.

use super::spirv;
use crate::engine::data::{Argument, ColorConstants};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Composites each list of layers. The resulting colour replaces that of the list's leaf, where
/// [`Resolve`](super::Resolve) reads it.
pub struct Composite {
    pipeline: Arc<Pipeline>,
}

impl Composite {
    /// Makes the pipeline. `output` holds the colour constants of `shaders/include/color.glsl`.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, output: &ColorConstants) -> Result<Self, VulkanError> {
        let lanes = layout.gpu.limits().lanes;
        let shader = spirv::Composite {
            local_size: lanes,
            lanes,
            unsure: layout.is_unsure(lanes),
            tinted: output.tinted,
            tonemap: output.tonemap,
        };
        Ok(Self {
            pipeline: layout.compute(&shader, layout.subgroup())?,
        })
    }

    /// Records the pass over the visibility samples of the round.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Sort as u32);
    }
}

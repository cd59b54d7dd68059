//! points: writes colour and attributes of locations that are sampled once.

use super::spirv;
use crate::engine::data::{Argument, ColorConstants, Content};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Writes a colour and, on request, two vectors of attributes for each location: see `shaders/points.comp`.
pub struct Points {
    pipeline: Arc<Pipeline>,
}

impl Points {
    /// Makes the pipeline. `output` holds the colour constants of `shaders/include/color.glsl`, `attributes` says
    /// whether attributes are written, and places have `shadow_words` words of shadows.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(
        layout: &FrameLayout,
        scene: &dyn Content,
        output: &ColorConstants,
        (attributes, shadow_words): (bool, u32),
    ) -> Result<Self, VulkanError> {
        let shader = spirv::Points {
            attributes,
            tinted: output.tinted,
            locations: true,
            instanced: scene.is_instanced(),
            shadow_words,
            tonemap: output.tonemap,
            tonemap_codes: output.tonemap_codes,
        };
        Ok(Self {
            pipeline: layout.compute(&shader, None)?,
        })
    }

    /// Records the pass over the visibility samples of the round.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Sort as u32);
    }
}

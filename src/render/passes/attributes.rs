//! attributes: depth, ID, normal and sampling of every pixel, where asked for.

use crate::engine::data::Content;
use crate::engine::passes::spirv;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Writes two vectors a pixel, see `shaders/attributes.comp`.
pub struct Attributes {
    pipeline: Arc<Pipeline>,
}

impl Attributes {
    /// Makes the pipeline; `superpixels` tells them from other pixels, `grown` if [`Grow`](super::Grow) added
    /// some.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(
        layout: &FrameLayout,
        scene: &dyn Content,
        superpixels: bool,
        grown: bool,
    ) -> Result<Self, VulkanError> {
        let shader = spirv::Attributes {
            superpixels,
            grown,
            instanced: scene.is_instanced(),
        };
        Ok(Self {
            pipeline: layout.compute(&shader, None)?,
        })
    }

    /// Records it for a region of `pixels` pixels.
    pub fn record(&self, recorder: &Recorder<'_>, pixels: u32) {
        recorder.dispatch(&self.pipeline, u64::from(pixels.div_ceil(64)));
    }
}

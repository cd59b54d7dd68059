//! attributes: depth, ID, normal and sampling of every pixel, where asked for.

use super::{Content, FrameLayout, spirv};
use crate::vulkan::{Constants, Pipeline, Recorder, VulkanError};
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
        let constants = Constants::new().flag(0, superpixels).flag(1, grown);
        let constants = scene.constants(constants);
        let pipeline = layout.compute(spirv::ATTRIBUTES, &constants, None)?;
        Ok(Self { pipeline })
    }

    /// Records it for a region of `pixels` pixels.
    pub fn record(&self, recorder: &Recorder<'_>, pixels: u32) {
        recorder.dispatch(&self.pipeline, u64::from(pixels.div_ceil(64)));
    }
}

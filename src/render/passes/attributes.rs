//! attributes: writes depth, ID, normal and number of samples of every pixel, on request.

use crate::engine::data::Content;
use crate::engine::passes::spirv;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Writes two vectors for each pixel: see `shaders/attributes.comp`.
pub struct Attributes {
    pipeline: Arc<Pipeline>,
}

impl Attributes {
    /// Makes the pipeline. `superpixels` says whether there are superpixels, `grown` whether [`Grow`](super::Grow) has
    /// added some.
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

    /// Records the pass for a region of `pixels` pixels.
    pub fn record(&self, recorder: &Recorder<'_>, pixels: u32) {
        recorder.dispatch_each(&self.pipeline, u64::from(pixels));
    }
}

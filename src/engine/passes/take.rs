//! take: reads a host's colour image, in which superpixels will be replaced.

use super::host_image::HostImage;
use super::spirv;
use crate::engine::data::ColorConstants;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Reads colours, and computes the codes that detection compares.
pub(crate) struct Take {
    image: Arc<HostImage>,
    pipeline: Arc<Pipeline>,
}

impl Take {
    /// Makes the pipeline; `output` are the colour constants of `shaders/include/color.glsl`.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(
        frame: &FrameLayout,
        image: &Arc<HostImage>,
        output: &ColorConstants,
    ) -> Result<Self, VulkanError> {
        let shader = spirv::Take {
            encoded: image.encoded(),
            tonemap: output.tonemap,
            tonemap_codes: output.tonemap_codes,
        };
        Ok(Self {
            pipeline: frame.compute(&shader, None)?,
            image: image.clone(),
        })
    }

    /// Records the pass for a frame of `pixels` pixels.
    pub fn record(&self, recorder: &Recorder<'_>, pixels: u32) {
        recorder.show(&self.image.sets);
        recorder.dispatch_each(&self.pipeline, u64::from(pixels));
    }
}

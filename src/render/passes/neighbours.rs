//! neighbours: cells of an output that contrast with a superpixel beside them.

use crate::passes::{FrameLayout, spirv};
use crate::vulkan::{Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Marks cells for [`Grow`](crate::passes::Grow), where superpixels are locations of lists.
pub struct Neighbours {
    pipeline: Arc<Pipeline>,
}

impl Neighbours {
    /// Makes the pipeline; `output` are the colour constants of `shaders/include/color.glsl`.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, output: &Constants) -> Result<Self, VulkanError> {
        Ok(Self {
            pipeline: layout.compute(spirv::NEIGHBOURS, output, None)?,
        })
    }

    /// Records it for an output of so many cells.
    pub fn record(&self, recorder: &Recorder<'_>, cells: u32) {
        recorder.dispatch(&self.pipeline, u64::from(cells.div_ceil(64)));
    }
}

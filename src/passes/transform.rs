//! transform: every vertex to pixel-scaled clip space.

use super::{FrameLayout, spirv};
use crate::vulkan::{Constants, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// Projects vertices once, for `raster` and `sample` alike.
pub struct Transform {
    pipeline: Arc<Pipeline>,
}

impl Transform {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout) -> Result<Self, VulkanError> {
        let pipeline = layout.compute(spirv::TRANSFORM, &Constants::new(), None)?;
        Ok(Self { pipeline })
    }

    /// Records it for `vertices` vertices.
    pub fn record(&self, recorder: &Recorder<'_>, vertices: u32) {
        recorder.dispatch(&self.pipeline, u64::from(vertices.div_ceil(64)));
    }
}

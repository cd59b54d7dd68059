//! cull: finds the triangles that can touch a superpixel.

use super::arguments::{After, Arguments};
use super::spirv;
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Pipeline, Recorder, Specialized, VulkanError};
use std::sync::Arc;

/// Filter for the triangles that are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CullFilter {
    /// Triangles that may touch a cell.
    Touching,
    /// Triangles that may touch a cell, and may be thin in some cell.
    Thin,
}

/// Lists triangles that pass the filter. If nothing was detected, no invocation runs.
pub struct Cull {
    arguments: Arguments,
    pipeline: Arc<Pipeline>,
}

impl Cull {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        scene: &dyn Content,
        filter: CullFilter,
    ) -> Result<Self, VulkanError> {
        let shader = spirv::Cull {
            thin_alone: filter == CullFilter::Thin,
            instanced: scene.is_instanced(),
        };
        Ok(Self {
            arguments: Arguments::new(layout, After::Detect)?,
            pipeline: layout.compute(&shader, None)?,
        })
    }

    /// Records the pass.
    pub fn record(&self, recorder: &Recorder<'_>, arguments: &Buffer) {
        recorder.pass(spirv::Cull::INTERFACE, || {
            self.arguments.record(recorder);
            recorder.dispatch_indirect(&self.pipeline, arguments, Argument::Cull as u32);
        });
    }
}

//! coordinates: gathers texture coordinates of a host's vertices, one for each position in clip space.

use super::VertexCounts;
use super::spirv::{self, coordinates_set};
use crate::engine::data::Draws;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, DescriptorSets, Pipeline, Recorder, Specialized, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Kernel that reads coordinates in the order of positions.
pub(crate) struct Coordinates {
    pipeline: Arc<Pipeline>,
}

impl Coordinates {
    /// Makes the pipeline. If draws have matrices, each draw has its own positions.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, draws: &Draws) -> Result<Self, VulkanError> {
        let object = draws.matrices.is_some();
        Ok(Self {
            pipeline: layout.compute(&spirv::Coordinates { object }, None)?,
        })
    }

    /// Makes a set with the draws, the host's vertices and the coordinates.
    ///
    /// # Errors
    /// If the driver refuses it.
    ///
    /// # Safety
    /// The host's buffer outlives the use of the set.
    pub unsafe fn set(
        layout: &FrameLayout,
        draws: &Draws,
        vertices: vk::DescriptorBufferInfo,
        coordinates: &Buffer,
    ) -> Result<DescriptorSets, VulkanError> {
        let buffers = [
            (coordinates_set::DRAWS, (&draws.table).into()),
            (coordinates_set::VERTICES, vertices.into()),
            (coordinates_set::COORDINATES_OUT, coordinates.into()),
        ];
        // SAFETY: the caller guarantees the host's buffer; the others live as long as the frame.
        unsafe { layout.own_set(spirv::Coordinates::INTERFACE, &buffers) }
    }

    /// Records the pass, if there are draws.
    pub fn record(&self, recorder: &Recorder<'_>, set: &DescriptorSets, counts: VertexCounts) {
        recorder.show(set);
        recorder.push(&self.pipeline, &counts);
        recorder.dispatch_each(&self.pipeline, counts.position_count.into());
    }
}

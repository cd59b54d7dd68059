//! coordinates: gathers texture coordinates of a host's vertices, one for each position in clip space.

use super::VertexCounts;
use super::spirv::{self, coordinates_set};
use crate::engine::data::Draws;
use crate::engine::pipelines::OwnSet;
use crate::engine::pipelines::lent_kernel::LentKernel;
use crate::vulkan::{Buffer, Gpu, Pipeline, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Kernel that reads coordinates in the order of positions.
pub(crate) struct Coordinates(LentKernel<spirv::Coordinates, VertexCounts>);

impl Coordinates {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        Ok(Self(LentKernel::new(gpu, &coordinates_set::ALL)?))
    }

    /// Makes the pipeline. If draws have matrices, each draw has its own positions.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(&self, gpu: &Arc<Gpu>, draws: &Draws) -> Result<Pipeline, VulkanError> {
        let object = draws.matrices.is_some();
        self.0.pipeline(gpu, &spirv::Coordinates { object })
    }

    /// Makes a set with the draws, the host's vertices and the coordinates.
    ///
    /// # Safety
    /// The host's buffer outlives the use of the set.
    pub unsafe fn set(
        &self,
        draws: &Draws,
        vertices: vk::DescriptorBufferInfo,
        coordinates: &Buffer,
    ) -> Result<OwnSet, VulkanError> {
        let buffers = [
            (coordinates_set::DRAWS, (&draws.table).into()),
            (coordinates_set::VERTICES, vertices.into()),
            (coordinates_set::COORDINATES_OUT, coordinates.into()),
        ];
        // SAFETY: the caller guarantees the host's buffer; the others live as long as the frame.
        unsafe { self.0.set(&buffers) }
    }

    /// Records the pass, if there are draws.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        pipeline: &Pipeline,
        set: &OwnSet,
        counts: VertexCounts,
    ) {
        let invocations = counts.position_count;
        self.0.record(recorder, pipeline, set, &counts, invocations);
    }
}

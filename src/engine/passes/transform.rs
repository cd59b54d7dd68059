//! transform: positions of a host's vertices in clip space.

use super::spirv::{self, transform_set};
use crate::engine::data::Draws;
use crate::engine::pipelines::lent_kernel::LentKernel;
use crate::engine::pipelines::own_layout::{OwnSet, whole};
use crate::vulkan::{Buffer, Gpu, Pipeline, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Where something of a frame's vertices is in the buffer that the set shows, in words of 4 bytes, and how many positions there
/// are.
pub(crate) use spirv::TransformPush as VertexCounts;

/// Reads vertices, and multiplies them by the matrices of their draws.
pub(crate) struct Transform(LentKernel<spirv::Transform, VertexCounts>);

impl Transform {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        Ok(Self(LentKernel::new(gpu, &transform_set::ALL)?))
    }

    /// The pipeline for three floats in object space, if the draws have matrices, or else for four in clip space.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(&self, gpu: &Arc<Gpu>, draws: &Draws) -> Result<Pipeline, VulkanError> {
        let object = draws.matrices.is_some();
        self.0.pipeline(gpu, &spirv::Transform { object })
    }

    /// A set that shows draws, the host's vertices, matrices and positions.
    ///
    /// # Safety
    /// The host's buffer outlives the set's use.
    pub unsafe fn set(
        &self,
        draws: &Draws,
        vertices: vk::DescriptorBufferInfo,
        positions: &Buffer,
    ) -> Result<OwnSet, VulkanError> {
        // Matrices that are not there are not read.
        let matrices = draws.matrices.as_ref().unwrap_or(&draws.table);
        let buffers = [
            (transform_set::DRAWS, whole(&draws.table)),
            (transform_set::VERTICES, vertices),
            (transform_set::MATRICES, whole(matrices)),
            (transform_set::POSITIONS_OUT, whole(positions)),
        ];
        // SAFETY: of the host's buffer as the caller says; ours go with the frame.
        unsafe { self.0.set(&buffers) }
    }

    /// Records it, where there are draws.
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

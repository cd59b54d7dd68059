//! transform: computes positions of a host's vertices in clip space.

use super::spirv::{self, transform_set};
use crate::engine::data::Draws;
use crate::engine::pipelines::OwnSet;
use crate::engine::pipelines::lent_kernel::LentKernel;
use crate::vulkan::{Buffer, Gpu, Pipeline, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Push constants: the range of positions, the number of draws, and the first word and stride, in words of 4 bytes, of
/// a vertex attribute in the host's buffer.
pub(crate) use spirv::TransformPush as VertexCounts;

/// Kernel that reads vertices, and multiplies them by the matrices of their draws.
pub(crate) struct Transform(LentKernel<spirv::Transform, VertexCounts>);

impl Transform {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        Ok(Self(LentKernel::new(gpu, &transform_set::ALL)?))
    }

    /// Makes the pipeline. If the draws have matrices, a position has three floats in object space; otherwise, four
    /// floats in clip space.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(&self, gpu: &Arc<Gpu>, draws: &Draws) -> Result<Pipeline, VulkanError> {
        let object = draws.matrices.is_some();
        self.0.pipeline(gpu, &spirv::Transform { object })
    }

    /// Makes a set with the draws, the host's vertices, the matrices and the positions.
    ///
    /// # Safety
    /// The host's buffer outlives the use of the set.
    pub unsafe fn set(
        &self,
        draws: &Draws,
        vertices: vk::DescriptorBufferInfo,
        positions: &Buffer,
    ) -> Result<OwnSet, VulkanError> {
        // Without matrices, the shader does not read this binding.
        let matrices = draws.matrices.as_ref().unwrap_or(&draws.table);
        let buffers = [
            (transform_set::DRAWS, (&draws.table).into()),
            (transform_set::VERTICES, vertices.into()),
            (transform_set::MATRICES, matrices.into()),
            (transform_set::POSITIONS_OUT, positions.into()),
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

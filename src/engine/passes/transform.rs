//! transform: positions of a host's vertices in clip space.

use super::draws::Draws;
use super::lent_kernel::LentKernel;
use super::own_layout::{OwnSet, whole};
use super::spirv;
use crate::vulkan::{Buffer, Gpu, Pipeline, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Where something of a frame's vertices is, and how many positions there are.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct VertexCounts {
    pub positions: u32,
    pub draws: u32,
    /// Where it begins in the buffer that the set shows, in words of 4 bytes.
    pub first_word: u32,
    /// Words from one vertex to the next.
    pub stride: u32,
}

/// Reads vertices, and multiplies them by the matrices of their draws.
pub(crate) struct Transform(LentKernel<VertexCounts>);

impl Transform {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        Ok(Self(LentKernel::new(gpu, spirv::TRANSFORM, 4)?))
    }

    /// The pipeline for three floats in object space, if the draws have matrices, or else for four in clip space.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(&self, gpu: &Arc<Gpu>, draws: &Draws) -> Result<Pipeline, VulkanError> {
        self.0.pipeline(gpu, draws.matrices.is_some())
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
            whole(&draws.table),
            vertices,
            whole(matrices),
            whole(positions),
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
        let invocations = counts.positions;
        self.0.record(recorder, pipeline, set, &counts, invocations);
    }
}

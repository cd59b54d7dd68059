//! transform: positions of a host's vertices in clip space.

use super::draws::Draws;
use super::own_layout::{OwnSet, PipelineLayout, SetLayout, whole};
use super::spirv;
use crate::vulkan::{Buffer, Constants, Gpu, Pipeline, Recorder, VulkanError, compute_pipeline};
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
pub(crate) struct Transform {
    layout: PipelineLayout,
    set_layout: SetLayout,
}

impl Transform {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        let set_layout = SetLayout::new(gpu, &[vk::DescriptorType::STORAGE_BUFFER; 4])?;
        let push = size_of::<VertexCounts>() as u32;
        Ok(Self {
            layout: PipelineLayout::new(gpu, &[set_layout.raw], push)?,
            set_layout,
        })
    }

    /// The pipeline for three floats in object space, if the draws have matrices, or else for four in clip space.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(&self, gpu: &Arc<Gpu>, draws: &Draws) -> Result<Pipeline, VulkanError> {
        let constants = Constants::new().flag(0, draws.matrices.is_some());
        compute_pipeline(gpu, self.layout.raw, spirv::TRANSFORM, &constants, None)
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
        let set = self.set_layout.allocate()?;
        // Matrices that are not there are not read.
        let matrices = draws.matrices.as_ref().unwrap_or(&draws.table);
        let buffers = [
            whole(&draws.table),
            vertices,
            whole(matrices),
            whole(positions),
        ];
        // SAFETY: the set is new; of the host's buffer as the caller says, ours go with the frame.
        unsafe { set.write_buffers(0, &buffers) };
        Ok(set)
    }

    /// Records it, where there are draws.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        pipeline: &Pipeline,
        set: &OwnSet,
        counts: VertexCounts,
    ) {
        self.layout.bind(recorder, &[set.raw], &counts);
        recorder.dispatch(pipeline, u64::from(counts.positions.div_ceil(64)));
    }
}

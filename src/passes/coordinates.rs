//! coordinates: texture coordinates of a host's vertices, one for each position in clip space.

use super::draws::Draws;
use super::own_layout::{OwnSet, PipelineLayout, SetLayout, whole};
use super::{VertexCounts, spirv};
use crate::vulkan::{Buffer, Constants, Gpu, Pipeline, Recorder, VulkanError, compute_pipeline};
use ash::vk;
use std::sync::Arc;

/// Reads coordinates in the order of positions.
pub(crate) struct Coordinates {
    layout: PipelineLayout,
    set_layout: SetLayout,
}

impl Coordinates {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        let set_layout = SetLayout::new(gpu, &[vk::DescriptorType::STORAGE_BUFFER; 3])?;
        let push = size_of::<VertexCounts>() as u32;
        Ok(Self {
            layout: PipelineLayout::new(gpu, &[set_layout.raw], push)?,
            set_layout,
        })
    }

    /// The pipeline: each draw has positions of its own if it has a matrix.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(&self, gpu: &Arc<Gpu>, draws: &Draws) -> Result<Pipeline, VulkanError> {
        let constants = Constants::new().flag(0, draws.matrices.is_some());
        compute_pipeline(gpu, self.layout.raw, spirv::COORDINATES, &constants, None)
    }

    /// A set that shows draws, the host's vertices and coordinates.
    ///
    /// # Safety
    /// The host's buffer outlives the set's use.
    pub unsafe fn set(
        &self,
        draws: &Draws,
        vertices: vk::DescriptorBufferInfo,
        coordinates: &Buffer,
    ) -> Result<OwnSet, VulkanError> {
        let set = self.set_layout.allocate()?;
        let buffers = [whole(&draws.table), vertices, whole(coordinates)];
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

//! adopt: a host's triangles as the other passes read them.

use super::draws::Draws;
use super::own_layout::{OwnSet, PipelineLayout, SetLayout, whole};
use super::spirv;
use crate::vulkan::{Buffer, Constants, Gpu, Pipeline, Recorder, VulkanError, compute_pipeline};
use ash::vk;
use std::sync::Arc;

/// How much there is of what a frame adopts.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct AdoptedCounts {
    pub triangles: u32,
    pub draws: u32,
    /// Where indices begin in the buffer that the set shows, in indices.
    pub first_index: u32,
    pub indices: u32,
}

/// Expands indices into triangles.
pub(crate) struct Adopt {
    layout: PipelineLayout,
    set_layout: SetLayout,
}

impl Adopt {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        let set_layout = SetLayout::new(gpu, &[vk::DescriptorType::STORAGE_BUFFER; 4])?;
        let push = size_of::<AdoptedCounts>() as u32;
        Ok(Self {
            layout: PipelineLayout::new(gpu, &[set_layout.raw], push)?,
            set_layout,
        })
    }

    /// The pipeline for indices of 32 bits or, `short`, 16.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(&self, gpu: &Arc<Gpu>, short: bool) -> Result<Pipeline, VulkanError> {
        let constants = Constants::new().flag(0, short);
        compute_pipeline(gpu, self.layout.raw, spirv::ADOPT, &constants, None)
    }

    /// A set that shows draws, the host's indices, triangles and the draw of each.
    ///
    /// # Safety
    /// The host's buffer outlives the set's use.
    pub unsafe fn set(
        &self,
        draws: &Draws,
        indices: vk::DescriptorBufferInfo,
        triangles: &Buffer,
        draw_of: &Buffer,
    ) -> Result<OwnSet, VulkanError> {
        let set = self.set_layout.allocate()?;
        let buffers = [
            whole(&draws.table),
            indices,
            whole(triangles),
            whole(draw_of),
        ];
        // SAFETY: the set is new; of the host's buffer as the caller says, ours go with the frame.
        unsafe { set.write_buffers(0, &buffers) };
        Ok(set)
    }

    /// Records it, where there are triangles.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        pipeline: &Pipeline,
        set: &OwnSet,
        counts: AdoptedCounts,
    ) {
        self.layout.bind(recorder, &[set.raw], &counts);
        recorder.dispatch(pipeline, u64::from(counts.triangles.div_ceil(64)));
    }
}

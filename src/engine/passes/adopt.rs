//! adopt: a host's triangles as the other passes read them.

use super::draws::Draws;
use super::lent_kernel::LentKernel;
use super::own_layout::{OwnSet, whole};
use super::spirv;
use crate::vulkan::{Buffer, Gpu, Pipeline, Recorder, VulkanError};
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
pub(crate) struct Adopt(LentKernel<AdoptedCounts>);

impl Adopt {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        Ok(Self(LentKernel::new(gpu, spirv::ADOPT, 4)?))
    }

    /// The pipeline for indices of 32 bits or, `short`, 16.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(&self, gpu: &Arc<Gpu>, short: bool) -> Result<Pipeline, VulkanError> {
        self.0.pipeline(gpu, short)
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
        let buffers = [
            whole(&draws.table),
            indices,
            whole(triangles),
            whole(draw_of),
        ];
        // SAFETY: of the host's buffer as the caller says; ours go with the frame.
        unsafe { self.0.set(&buffers) }
    }

    /// Records it, where there are triangles.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        pipeline: &Pipeline,
        set: &OwnSet,
        counts: AdoptedCounts,
    ) {
        let invocations = counts.triangles;
        self.0.record(recorder, pipeline, set, &counts, invocations);
    }
}

//! adopt: a host's triangles as the other passes read them.

use super::own_layout::{OwnSet, PipelineLayout, SetLayout};
use super::spirv;
use crate::vulkan::{Buffer, Constants, Gpu, Pipeline, Recorder, VulkanError, compute_pipeline};
use ash::vk;
use std::sync::Arc;

/// A draw as the shader reads it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct AdoptedDraw {
    /// Index of its first triangle among those of all draws.
    pub first_triangle: u32,
    pub first_index: u32,
    /// Added to each index, modulo 2^32.
    pub vertex_offset: u32,
    /// The triangles' last word: see `shaders/include/frame.glsl`.
    pub word: u32,
}

/// How much there is of what a frame adopts.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct AdoptedCounts {
    pub triangles: u32,
    pub draws: u32,
    pub indices: u32,
    pub vertices: u32,
}

/// Expands indices into triangles.
pub(crate) struct Adopt {
    pipeline: Pipeline,
    layout: PipelineLayout,
    set_layout: SetLayout,
}

impl Adopt {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        let set_layout = SetLayout::new(gpu, &[vk::DescriptorType::STORAGE_BUFFER; 3])?;
        let push = size_of::<AdoptedCounts>() as u32;
        let layout = PipelineLayout::new(gpu, &[set_layout.raw], push)?;
        Ok(Self {
            pipeline: compute_pipeline(gpu, layout.raw, spirv::ADOPT, &Constants::new(), None)?,
            layout,
            set_layout,
        })
    }

    /// A set that shows the host's indices, a buffer of draws, and that of triangles.
    ///
    /// # Safety
    /// The host's buffer outlives the set's use.
    pub unsafe fn set(
        &self,
        indices: vk::DescriptorBufferInfo,
        draws: &Buffer,
        triangles: &Buffer,
    ) -> Result<OwnSet, VulkanError> {
        let whole = |buffer: &Buffer| {
            vk::DescriptorBufferInfo::default()
                .buffer(buffer.handle())
                .range(vk::WHOLE_SIZE)
        };
        let set = self.set_layout.allocate()?;
        // SAFETY: the set is new; of the host's buffer as the caller says, ours go with the frame.
        unsafe { set.write_buffers(&[indices, whole(draws), whole(triangles)]) };
        Ok(set)
    }

    /// Records it, with the draws' upload before it.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        set: &OwnSet,
        buffer: &Buffer,
        draws: &[AdoptedDraw],
        counts: AdoptedCounts,
    ) {
        /// Draws of an inline update, which can have 65,536 bytes.
        const AT_ONCE: usize = 65_536 / size_of::<AdoptedDraw>();
        recorder.barrier();
        let (device, raw) = (recorder.device(), recorder.raw());
        for (chunk, draws) in draws.chunks(AT_ONCE).enumerate() {
            let offset = (chunk * 65_536) as u64;
            let bytes = bytemuck::cast_slice(draws);
            // SAFETY: the recorder's contract; callers have sized the buffer for the draws.
            unsafe { device.cmd_update_buffer(raw, buffer.handle(), offset, bytes) };
        }
        recorder.barrier();
        if counts.triangles == 0 {
            return;
        }
        // SAFETY: the recorder's contract; set and constants are of the pipeline's layout.
        unsafe {
            device.cmd_bind_descriptor_sets(
                raw,
                vk::PipelineBindPoint::COMPUTE,
                self.layout.raw,
                0,
                &[set.raw],
                &[],
            );
            device.cmd_push_constants(
                raw,
                self.layout.raw,
                vk::ShaderStageFlags::COMPUTE,
                0,
                bytemuck::bytes_of(&counts),
            );
        }
        recorder.dispatch(&self.pipeline, u64::from(counts.triangles.div_ceil(64)));
    }
}

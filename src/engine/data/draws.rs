//! Draws of a host, on the device.

use crate::vulkan::{Buffer, Memory, MemoryUse, Recorder, VulkanError};
use ash::vk;

/// A draw, laid out as in `shaders/include/draws.glsl`.
pub(crate) use crate::engine::spirv::Draw as HostDraw;

/// Table of draws, and a matrix for each if positions are in object space.
pub(crate) struct Draws {
    pub(crate) table: Buffer,
    pub(crate) matrices: Option<Buffer>,
}

impl Draws {
    /// Allocates memory for `capacity` draws.
    ///
    /// # Errors
    /// If memory runs out or a limit of the device is exceeded.
    pub fn new(memory: &Memory, capacity: u64, has_matrices: bool) -> Result<Self, VulkanError> {
        let storage = |name, bytes| {
            let usage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_DST;
            memory.storage_buffer(name, bytes, usage, MemoryUse::Device)
        };
        Ok(Self {
            table: storage("draws", capacity * size_of::<HostDraw>() as u64)?,
            matrices: has_matrices.then(|| storage("matrices of draws", capacity * 64)).transpose()?,
        })
    }

    /// Records the upload of draws, which must not exceed the capacity.
    pub fn record_upload(&self, recorder: &Recorder<'_>, draws: &[HostDraw], matrices: &[[[f32; 4]; 4]]) {
        recorder.update(&self.table, 0, bytemuck::cast_slice(draws));
        if let Some(buffer) = &self.matrices {
            recorder.update(buffer, 0, bytemuck::cast_slice(matrices));
        }
    }
}

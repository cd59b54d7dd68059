//! A host's draws on the device.

use super::TriangleWord;
use crate::vulkan::{Buffer, Memory, MemoryUse, Recorder, VulkanError};
use ash::vk;

/// A draw, as `shaders/include/draws.glsl` describes it.
pub(crate) use crate::engine::passes::spirv::Draw as HostDraw;

impl HostDraw {
    /// Whether back faces show.
    pub fn is_double_sided(&self) -> bool {
        self.word & TriangleWord::DOUBLE_SIDED != 0
    }
}

/// Draws, and a matrix for each where positions are in object space.
pub(crate) struct Draws {
    pub(crate) table: Buffer,
    pub(crate) matrices: Option<Buffer>,
}

impl Draws {
    /// Memory for so many draws.
    ///
    /// # Errors
    /// If memory runs out or the device's limits are passed.
    pub fn new(memory: &Memory, capacity: u32, has_matrices: bool) -> Result<Self, VulkanError> {
        let storage = |name, bytes| {
            let usage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_DST;
            memory.storage_buffer(name, bytes, usage, MemoryUse::Device)
        };
        let capacity = u64::from(capacity);
        Ok(Self {
            table: storage("draws", capacity * size_of::<HostDraw>() as u64)?,
            matrices: has_matrices
                .then(|| storage("matrices of draws", capacity * 64))
                .transpose()?,
        })
    }

    /// Records their upload. They fit in what was asked for.
    pub fn record_upload(
        &self,
        recorder: &Recorder<'_>,
        draws: &[HostDraw],
        matrices: &[[[f32; 4]; 4]],
    ) {
        recorder.barrier();
        recorder.update(&self.table, 0, bytemuck::cast_slice(draws));
        if let Some(buffer) = &self.matrices {
            recorder.update(buffer, 0, bytemuck::cast_slice(matrices));
        }
        recorder.barrier();
    }
}

//! Count of the shadows that passes could not find.

use crate::vulkan::{Buffer, Memory, MemoryUse, Recorder, VulkanError};
use ash::vk;

/// Count of the receivers and tiles that the passes of a frame's shadows could not finish, on the device and in a copy
/// that the host reads.
pub struct Unshadowed {
    counted: Buffer,
    kept: Buffer,
}

impl Unshadowed {
    /// Makes the buffers.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn new(memory: &Memory) -> Result<Self, VulkanError> {
        let words = |name, usage, place| memory.buffer(name, 4, usage, place);
        let transfer = vk::BufferUsageFlags::TRANSFER_DST;
        let storage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_SRC;
        Ok(Self {
            counted: words("shadows left", storage | transfer, MemoryUse::Device)?,
            kept: words("shadows left, read back", transfer, MemoryUse::Readback)?,
        })
    }

    /// Buffer with the count, as `shaders/shadow.comp` describes it.
    pub fn buffer(&self) -> &Buffer {
        &self.counted
    }

    /// Records the beginning of a frame.
    pub fn record_begin(&self, recorder: &Recorder<'_>) {
        recorder.clear(&self.counted);
    }

    /// Records the end of a frame.
    pub fn record_end(&self, recorder: &Recorder<'_>) {
        recorder.copy(&self.counted, self.counted.size(), &self.kept, 0);
    }

    /// Number of receivers and tiles that the last frame could not finish.
    ///
    /// # Errors
    /// If the count can't be read.
    pub fn read(&self) -> Result<u32, VulkanError> {
        let words: &[u32] = self.kept.read(1)?;
        Ok(words.first().copied().unwrap_or(0))
    }
}

//! Count of the shadows that `occlude` could not find.

use crate::engine::sampler::{PlaneRoom, Shortfall};
use crate::vulkan::{Buffer, Memory, MemoryUse, Recorder, VulkanError};
use ash::vk;

/// Count of the receivers that `occlude` has left in a frame, and the room that their lists need, on the device and in a
/// copy that the host reads.
pub struct Unshadowed {
    counted: Buffer,
    kept: Buffer,
}

impl Unshadowed {
    /// Number of words, which `shaders/occlude.comp` describes.
    const WORDS: usize = 3;

    /// Makes the buffers.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn new(memory: &Memory) -> Result<Self, VulkanError> {
        let words = |name, usage, place| memory.buffer(name, 4 * Self::WORDS as u64, usage, place);
        let transfer = vk::BufferUsageFlags::TRANSFER_DST;
        let storage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_SRC;
        Ok(Self {
            counted: words("shadows left", storage | transfer, MemoryUse::Device)?,
            kept: words("shadows left, read back", transfer, MemoryUse::Readback)?,
        })
    }

    /// Buffer with the count, as `shaders/occlude.comp` describes it.
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

    /// Adds what the last frame could not finish.
    ///
    /// # Errors
    /// If the count can't be read.
    pub(crate) fn add_shortfall(&self, shortfall: &mut Shortfall) -> Result<(), VulkanError> {
        if let [left, pairs, longest] = *self.kept.read::<u32>(Self::WORDS)? {
            shortfall.unshadowed += u64::from(left);
            shortfall.planes = shortfall.planes.most(PlaneRoom { pairs, longest });
        }
        Ok(())
    }
}

//! Filling device buffers from the host.

use crate::vulkan::{Buffer, BufferView, Memory, MemoryUse, Recorder, VulkanError};
use ash::vk;
use bytemuck::NoUninit;

/// A copy that the device makes in the first frame: from a buffer of its own, to another, of so many bytes.
pub(super) struct Upload {
    from: Buffer,
    to: vk::Buffer,
    size: u64,
}

impl Upload {
    pub(super) fn record(&self, recorder: &Recorder<'_>) {
        let region = [vk::BufferCopy::default().size(self.size)];
        // SAFETY: the recorder's contract; both buffers hold `size` bytes.
        unsafe {
            recorder
                .device()
                .cmd_copy_buffer(recorder.raw(), self.from.raw, self.to, &region)
        };
    }
}

/// Fills device buffers: directly where the host sees them, else through an [`Upload`].
pub(super) struct Uploader<'a> {
    memory: &'a Memory,
    pub(super) uploads: Vec<Upload>,
}

impl<'a> Uploader<'a> {
    pub(super) fn new(memory: &'a Memory) -> Self {
        Self {
            memory,
            uploads: Vec::new(),
        }
    }

    fn fill(&mut self, name: &str, buffer: &mut Buffer, bytes: &[u8]) -> Result<(), VulkanError> {
        if let Some(mapped) = buffer.bytes_mut().get_mut(..bytes.len()) {
            mapped.copy_from_slice(bytes);
            return Ok(());
        }
        self.uploads.push(Upload {
            from: self.memory.upload(&format!("{name} upload"), bytes)?,
            to: buffer.raw,
            size: bytes.len() as u64,
        });
        Ok(())
    }

    /// A texel buffer of the data, an element a texel.
    pub(super) fn texels<T: NoUninit>(
        &mut self,
        name: &str,
        format: vk::Format,
        data: &[T],
    ) -> Result<BufferView, VulkanError> {
        let usage = vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER | vk::BufferUsageFlags::TRANSFER_DST;
        let mut view =
            self.memory
                .texel_buffer(name, data.len() as u64, format, usage, MemoryUse::Device)?;
        self.fill(name, &mut view.buffer, bytemuck::cast_slice(data))?;
        Ok(view)
    }

    /// A texel buffer of vectors of three and a fourth component.
    pub(super) fn vectors(
        &mut self,
        name: &str,
        data: &[[f32; 3]],
        fourth: f32,
    ) -> Result<BufferView, VulkanError> {
        let wide: Vec<[f32; 4]> = data.iter().map(|&[x, y, z]| [x, y, z, fourth]).collect();
        self.texels(name, vk::Format::R32G32B32A32_SFLOAT, &wide)
    }

    /// A storage buffer of these bytes.
    pub(super) fn storage(&mut self, name: &str, bytes: &[u8]) -> Result<Buffer, VulkanError> {
        let limit = self.memory.gpu().limits().max_storage_bytes;
        let needed = bytes.len() as u64;
        if needed > limit {
            return Err(VulkanError::TooLarge {
                what: name.to_owned(),
                needed,
                unit: "bytes",
                limit,
            });
        }
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_DST;
        let mut buffer = self.memory.buffer(name, needed, usage, MemoryUse::Device)?;
        self.fill(name, &mut buffer, bytes)?;
        Ok(buffer)
    }
}

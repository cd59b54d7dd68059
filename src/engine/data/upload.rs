//! Filling of device buffers from the host.

use crate::vulkan::{Buffer, Memory, MemoryUse, Recorder, TexelBuffer, VulkanError};
use ash::vk;
use bytemuck::NoUninit;

/// Copy of bytes from a staging buffer to another buffer, which the device executes in the first frame.
pub(crate) struct Upload {
    from: Buffer,
    to: vk::Buffer,
    size: u64,
}

impl Upload {
    pub(crate) fn new(memory: &Memory, name: &str, to: &Buffer, bytes: &[u8]) -> Result<Self, VulkanError> {
        Ok(Self { from: memory.upload(name, bytes)?, to: to.raw, size: bytes.len() as u64 })
    }

    pub(crate) fn record(&self, recorder: &Recorder<'_>) {
        let region = [vk::BufferCopy::default().size(self.size)];
        // SAFETY: guaranteed by the recorder's caller; both buffers hold `size` bytes.
        unsafe { recorder.copy_raw(self.from.raw, self.to, &region) };
    }
}

/// Fills device buffers: directly if the host can write them, otherwise through an [`Upload`].
pub(crate) struct Uploader<'a> {
    pub(crate) memory: &'a Memory,
    pub(crate) uploads: Vec<Upload>,
}

impl<'a> Uploader<'a> {
    pub(crate) fn new(memory: &'a Memory) -> Self {
        Self { memory, uploads: Vec::new() }
    }

    fn fill(&mut self, name: &str, buffer: &mut Buffer, bytes: &[u8]) -> Result<(), VulkanError> {
        if let Some(mapped) = buffer.bytes_mut().get_mut(..bytes.len()) {
            mapped.copy_from_slice(bytes);
            return Ok(());
        }
        let name = format!("{name} upload");
        let upload = Upload::new(self.memory, &name, buffer, bytes)?;
        self.uploads.push(upload);
        Ok(())
    }

    /// Makes a texel buffer with the contents `data`; each element is a texel.
    pub(crate) fn texels<T: NoUninit>(
        &mut self,
        name: &str,
        format: vk::Format,
        data: &[T],
    ) -> Result<TexelBuffer, VulkanError> {
        let usage = vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER
            | vk::BufferUsageFlags::TRANSFER_DST
            | vk::BufferUsageFlags::TRANSFER_SRC;
        let mut view = self.memory.texel_buffer(name, data.len() as u64, format, usage, MemoryUse::Device)?;
        self.fill(name, &mut view.buffer, bytemuck::cast_slice(data))?;
        Ok(view)
    }

    /// Makes a storage buffer with the contents `bytes`.
    pub(crate) fn storage(&mut self, name: &str, bytes: &[u8]) -> Result<Buffer, VulkanError> {
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::TRANSFER_DST
            | vk::BufferUsageFlags::TRANSFER_SRC;
        let size = bytes.len() as u64;
        let mut buffer = self.memory.storage_buffer(name, size, usage, MemoryUse::Device)?;
        self.fill(name, &mut buffer, bytes)?;
        Ok(buffer)
    }
}

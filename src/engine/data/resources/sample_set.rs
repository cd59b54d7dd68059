//! Sample offsets on the device, and the descriptor sets of the passes that read them.

use crate::engine::data::FrameUniform;
use crate::engine::data::upload::Upload;
use crate::vulkan::{Buffer, DescriptorSets, Memory, MemoryUse, Recorder, TexelBuffer, VulkanError};
use ash::vk;

/// Sample offsets from the pixel's centre, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offsets<'a> {
    /// Offsets of a cell's samples.
    pub all: &'a [[f32; 2]],
    /// Number of samples of a cell.
    pub count: u32,
}

/// Sample offsets, and the descriptor sets that contain them.
pub struct SampleSet {
    pub(crate) uniform: Buffer,
    pub(crate) offsets: TexelBuffer,
    pub(crate) upload: Upload,
    count: u32,
    /// Descriptor sets of the passes.
    pub(crate) sets: DescriptorSets,
}

impl SampleSet {
    /// Allocates a list of offsets and its uniform block, for sets that show nothing yet.
    pub(crate) fn new(
        memory: &Memory,
        sets: DescriptorSets,
        Offsets { all, count }: &Offsets<'_>,
    ) -> Result<Self, VulkanError> {
        let offsets = memory.texel_buffer(
            "offsets of sub-samples",
            all.len() as u64,
            vk::Format::R32G32_SFLOAT,
            vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER
                | vk::BufferUsageFlags::UNIFORM_BUFFER
                | vk::BufferUsageFlags::TRANSFER_DST,
            MemoryUse::Device,
        )?;
        let upload = Upload::new(memory, "location upload", &offsets.buffer, bytemuck::cast_slice(all))?;
        Ok(Self {
            uniform: memory.buffer(
                "frame uniform",
                size_of::<FrameUniform>().next_multiple_of(16) as u64,
                vk::BufferUsageFlags::UNIFORM_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
                MemoryUse::Device,
            )?,
            offsets,
            upload,
            count: *count,
            sets,
        })
    }

    /// Has passes that `recorder` records from now on use these offsets, and the memory that the sets show.
    pub fn show(&self, recorder: &Recorder<'_>) {
        recorder.show(&self.sets);
    }

    /// Number of sample offsets of a cell.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.count
    }
}

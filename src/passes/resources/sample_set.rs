//! Sub-sample locations on the device, and the descriptor set of the passes that read them.

use crate::passes::pool::DescriptorPool;
use crate::passes::upload::Upload;
use crate::passes::{FrameLayout, FrameUniform};
use crate::vulkan::{Buffer, BufferView, Memory, MemoryUse, VulkanError};
use ash::vk;

/// Sub-sample locations relative to the pixel's centre, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Locations<'a> {
    /// Those of a cell, and then those of a first run of few samples where there is one.
    pub all: &'a [[f32; 2]],
    /// Samples of a cell.
    pub count: u32,
}

/// Sub-sample locations and the descriptor set that reads them.
pub struct SampleSet {
    pub(super) uniform: Buffer,
    pub(super) locations: BufferView,
    pub(super) upload: Upload,
    count: u32,
    set: vk::DescriptorSet,
}

impl SampleSet {
    /// Allocates a list of locations, its uniform block and its set, which is not written yet.
    pub(super) fn new(
        layout: &FrameLayout,
        memory: &Memory,
        pool: &DescriptorPool,
        Locations { all, count }: &Locations<'_>,
    ) -> Result<Self, VulkanError> {
        let locations = memory.texel_buffer(
            "sub-sample locations",
            all.len() as u64,
            vk::Format::R32G32_SFLOAT,
            vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
            MemoryUse::Device,
        )?;
        let bytes = bytemuck::cast_slice(all);
        let upload = Upload::new(memory, "location upload", &locations.buffer, bytes)?;
        Ok(Self {
            uniform: memory.buffer(
                "frame uniform",
                size_of::<FrameUniform>().next_multiple_of(16) as u64,
                vk::BufferUsageFlags::UNIFORM_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
                MemoryUse::Device,
            )?,
            locations,
            upload,
            count: *count,
            set: pool.allocate(layout.frame_set)?,
        })
    }

    /// Number of locations.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.count
    }

    /// The descriptor set.
    pub(crate) fn descriptor(&self) -> vk::DescriptorSet {
        self.set
    }
}

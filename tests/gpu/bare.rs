//! Memory for passes that are run on their own, without a scene.

use ash::vk;
use gpc::render::Headless;
use gpc::testing::{
    BoundDescriptor, Buffer, FrameLayout, Memory, MemoryUse, Offsets, ResourceRequest, ResourceSizes, Resources,
    ShownIds, frame_layout, memory,
};
use std::sync::Arc;

/// Resources of given sizes.
pub struct Bare {
    pub memory: Memory,
    pub layout: Arc<FrameLayout>,
    pub resources: Resources,
}

impl Bare {
    pub fn new(gpu: &Headless, sizes: ResourceSizes, samples: u32) -> Self {
        Self::with(gpu, sizes, samples, &[])
    }

    /// Resources whose sets also show `others`, which outlive them.
    pub fn with(gpu: &Headless, sizes: ResourceSizes, samples: u32, others: &[BoundDescriptor]) -> Self {
        // SAFETY: passes are run with the sizes of these resources, and tests wait for their commands.
        let (layout, memory) = unsafe { (frame_layout(gpu.gpu()).unwrap(), memory(gpu.gpu(), None)) };
        let offsets = vec![[0.0; 2]; samples as usize];
        let request = ResourceRequest {
            sizes,
            others,
            ids: ShownIds::Unread,
            offsets: &[Offsets { all: &offsets, count: samples }],
            scratch: None,
        };
        let resources = Resources::new(&layout, &memory, &request).unwrap();
        Self { memory, layout, resources }
    }

    /// A buffer in host memory to which another one may be copied.
    pub fn like(&self, buffer: &Buffer) -> Buffer {
        let usage = vk::BufferUsageFlags::TRANSFER_DST;
        self.memory.buffer("kept", buffer.size(), usage, MemoryUse::Readback).unwrap()
    }
}

pub fn copy(gpu: &Headless, commands: vk::CommandBuffer, from: &Buffer, to: &Buffer) {
    let size = from.size().min(to.size());
    let all = [vk::BufferCopy::default().size(size)];
    // SAFETY: the commands are being recorded; both buffers were created for copies and outlive them.
    unsafe {
        gpu.gpu().device().cmd_copy_buffer(commands, from.handle(), to.handle(), &all);
    }
}

//! Memory for passes that are run on their own, without a scene.

use ash::vk;
use gpc::render::Headless;
use gpc::testing::{
    Buffer, Content, FrameLayout, Memory, MemoryUse, Offsets, RasterTargets, ResourceSizes, Resources, frame_layout,
    memory,
};
use std::sync::Arc;

/// Scene that these passes do not read.
pub struct Unread;

impl Content for Unread {
    fn triangle_slots(&self) -> u32 {
        1
    }

    fn is_instanced(&self) -> bool {
        false
    }

    fn has_mask(&self) -> bool {
        false
    }

    fn has_blend(&self) -> bool {
        false
    }

    fn has_high_frequency(&self) -> bool {
        true
    }

    fn is_tinted(&self) -> bool {
        false
    }

    fn bin_count(&self) -> u32 {
        1
    }
}

/// Resources of given sizes.
pub struct Bare {
    pub memory: Memory,
    pub layout: Arc<FrameLayout>,
    pub resources: Resources,
    /// Images that descriptors refer to but no pass reads.
    _targets: RasterTargets,
}

impl Bare {
    pub fn new(gpu: &Headless, sizes: ResourceSizes, samples: u32) -> Self {
        // SAFETY: passes are run with the sizes of these resources, and tests wait for their commands.
        let (layout, memory) = unsafe { (frame_layout(gpu.gpu()).unwrap(), memory(gpu.gpu(), None)) };
        let targets = RasterTargets::new(&memory, 8, 4, vk::SampleCountFlags::TYPE_1, false).unwrap();
        let offsets = vec![[0.0; 2]; samples as usize];
        let resources = Resources::new(
            &layout,
            &memory,
            &Unread,
            &[],
            &targets.views(),
            sizes,
            &[Offsets { all: &offsets, count: samples }],
        )
        .unwrap();
        Self { memory, layout, resources, _targets: targets }
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

//! An image with two layers, and a secondary command buffer.

use super::world::SIZE;
use ash::vk;
use gpc::testing::Buffer;
use gpc::vulkan::Gpu;
use std::sync::Arc;

/// Image of colours with two layers, each with a view.
pub struct Layers {
    gpu: Arc<Gpu>,
    pub raw: vk::Image,
    pub views: [vk::ImageView; 2],
    memory: vk::DeviceMemory,
}

const LAYOUT: vk::ImageLayout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;

fn range(base_array_layer: u32, layer_count: u32) -> vk::ImageSubresourceRange {
    vk::ImageSubresourceRange {
        aspect_mask: vk::ImageAspectFlags::COLOR,
        base_mip_level: 0,
        level_count: 1,
        base_array_layer,
        layer_count,
    }
}

impl Layers {
    pub fn new(gpu: &Arc<Gpu>) -> Self {
        let device = gpu.device();
        let format = vk::Format::R32G32B32A32_SFLOAT;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width: SIZE[0], height: SIZE[1], depth: 1 })
            .mip_levels(1)
            .array_layers(2)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(
                vk::ImageUsageFlags::SAMPLED
                    | vk::ImageUsageFlags::COLOR_ATTACHMENT
                    | vk::ImageUsageFlags::TRANSFER_SRC
                    | vk::ImageUsageFlags::TRANSFER_DST,
            );
        // SAFETY: plain creations on a live device; the memory has a type that the image takes, and is bound once.
        unsafe {
            let raw = device.create_image(&info, None).unwrap();
            let needs = device.get_image_memory_requirements(raw);
            let info = vk::MemoryAllocateInfo::default()
                .allocation_size(needs.size)
                .memory_type_index(needs.memory_type_bits.trailing_zeros());
            let memory = device.allocate_memory(&info, None).unwrap();
            device.bind_image_memory(raw, memory, 0).unwrap();
            let view = |layer| {
                let info = vk::ImageViewCreateInfo::default()
                    .image(raw)
                    .view_type(vk::ImageViewType::TYPE_2D)
                    .format(format)
                    .subresource_range(range(layer, 1));
                device.create_image_view(&info, None).unwrap()
            };
            Self { gpu: gpu.clone(), raw, views: [0, 1].map(view), memory }
        }
    }

    /// Records the filling of both layers, which are then in the layout `TRANSFER_DST_OPTIMAL`.
    pub fn fill(&self, commands: vk::CommandBuffer, color: [f32; 4]) {
        self.change(commands, vk::ImageLayout::UNDEFINED, LAYOUT);
        let color = vk::ClearColorValue { float32: color };
        // SAFETY: the commands are waited for; the image is in the layout named.
        unsafe { self.gpu.device().cmd_clear_color_image(commands, self.raw, LAYOUT, &color, &[range(0, 2)]) };
        self.change(commands, LAYOUT, LAYOUT);
    }

    /// Records the copy of a layer, which is in the layout `TRANSFER_DST_OPTIMAL`.
    pub fn read(&self, commands: vk::CommandBuffer, base_array_layer: u32, to: &Buffer) {
        let from = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        let region = [vk::BufferImageCopy::default()
            .image_subresource(vk::ImageSubresourceLayers {
                aspect_mask: vk::ImageAspectFlags::COLOR,
                mip_level: 0,
                base_array_layer,
                layer_count: 1,
            })
            .image_extent(vk::Extent3D { width: SIZE[0], height: SIZE[1], depth: 1 })];
        self.change(commands, LAYOUT, from);
        // SAFETY: the commands are waited for; the image is in the layout named.
        unsafe { self.gpu.device().cmd_copy_image_to_buffer(commands, self.raw, from, to.handle(), &region) };
        self.change(commands, from, LAYOUT);
    }

    fn change(&self, commands: vk::CommandBuffer, from: vk::ImageLayout, to: vk::ImageLayout) {
        let all = vk::PipelineStageFlags2::ALL_COMMANDS;
        let barriers = [vk::ImageMemoryBarrier2::default()
            .image(self.raw)
            .old_layout(from)
            .new_layout(to)
            .src_stage_mask(all)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(all)
            .dst_access_mask(vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE)
            .subresource_range(range(0, 2))];
        let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
        // SAFETY: the commands are waited for; the image is in the layout named.
        unsafe { self.gpu.device().cmd_pipeline_barrier2(commands, &info) };
    }
}

impl Drop for Layers {
    fn drop(&mut self) {
        let device = self.gpu.device();
        // SAFETY: all commands have run.
        unsafe {
            for view in self.views {
                device.destroy_image_view(view, None);
            }
            device.destroy_image(self.raw, None);
            device.free_memory(self.memory, None);
        }
    }
}

/// A secondary command buffer, freed when it is dropped.
pub struct Secondary {
    gpu: Arc<Gpu>,
    pool: vk::CommandPool,
}

impl Drop for Secondary {
    fn drop(&mut self) {
        // SAFETY: the commands have run.
        unsafe { self.gpu.device().destroy_command_pool(self.pool, None) };
    }
}

/// Records commands into a secondary buffer, and their execution into a primary one.
pub fn with_secondary(
    gpu: &Arc<Gpu>,
    commands: vk::CommandBuffer,
    record: impl FnOnce(vk::CommandBuffer),
) -> Secondary {
    let device = gpu.device();
    // SAFETY: plain use of a live device; the primary commands are being recorded.
    unsafe {
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(gpu.queue_family());
        let pool = device.create_command_pool(&info, None).unwrap();
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(pool)
            .level(vk::CommandBufferLevel::SECONDARY)
            .command_buffer_count(1);
        let secondary = device.allocate_command_buffers(&info).unwrap()[0];
        let inherited = vk::CommandBufferInheritanceInfo::default();
        let info = vk::CommandBufferBeginInfo::default().inheritance_info(&inherited);
        device.begin_command_buffer(secondary, &info).unwrap();
        record(secondary);
        device.end_command_buffer(secondary).unwrap();
        device.cmd_execute_commands(commands, &[secondary]);
        Secondary { gpu: gpu.clone(), pool }
    }
}

//! Commands of a test's own.

use ash::vk;
use gpc::vulkan::Gpu;
use std::sync::Arc;

/// Records commands, submits them and waits for them.
pub fn submit(gpu: &Arc<Gpu>, record: impl FnOnce(vk::CommandBuffer)) {
    let device = gpu.device();
    // SAFETY: the commands are waited for before their pool goes.
    unsafe {
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(gpu.queue_family());
        let pool = device.create_command_pool(&info, None).unwrap();
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(pool)
            .command_buffer_count(1);
        let commands = device.allocate_command_buffers(&info).unwrap();
        let info = vk::CommandBufferBeginInfo::default();
        device.begin_command_buffer(commands[0], &info).unwrap();
        record(commands[0]);
        let to_host = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::HOST)
            .dst_access_mask(vk::AccessFlags2::HOST_READ)];
        let info = vk::DependencyInfo::default().memory_barriers(&to_host);
        device.cmd_pipeline_barrier2(commands[0], &info);
        device.end_command_buffer(commands[0]).unwrap();
        let submits = [vk::SubmitInfo::default().command_buffers(&commands)];
        let queue = device.get_device_queue(gpu.queue_family(), 0);
        device
            .queue_submit(queue, &submits, vk::Fence::null())
            .unwrap();
        device.queue_wait_idle(queue).unwrap();
        device.destroy_command_pool(pool, None);
    }
}

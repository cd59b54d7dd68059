//! Commands of a test.

use ash::vk;
use gpc::vulkan::Gpu;
use std::sync::Arc;

/// Records commands and submits them; `meanwhile` is called before waiting for them.
pub fn submit_and(gpu: &Arc<Gpu>, record: impl FnOnce(vk::CommandBuffer), meanwhile: impl FnOnce()) {
    let device = gpu.device();
    with_commands(gpu, |commands| {
        record(commands);
        let to_host = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::HOST)
            .dst_access_mask(vk::AccessFlags2::HOST_READ)];
        let info = vk::DependencyInfo::default().memory_barriers(&to_host);
        let all = [commands];
        let submits = [vk::SubmitInfo::default().command_buffers(&all)];
        // SAFETY: the commands are being recorded, and are waited for before their pool is destroyed.
        unsafe {
            device.cmd_pipeline_barrier2(commands, &info);
            device.end_command_buffer(commands).unwrap();
            let queue = device.get_device_queue(gpu.queue_family(), 0);
            device.queue_submit(queue, &submits, vk::Fence::null()).unwrap();
            meanwhile();
            device.queue_wait_idle(queue).unwrap();
        }
    });
}

/// Records commands, submits them and waits for them.
pub fn submit(gpu: &Arc<Gpu>, record: impl FnOnce(vk::CommandBuffer)) {
    submit_and(gpu, record, || ());
}

/// Records commands that are never submitted.
pub fn discard(gpu: &Arc<Gpu>, record: impl FnOnce(vk::CommandBuffer)) {
    with_commands(gpu, |commands| {
        record(commands);
        // SAFETY: the commands are being recorded.
        unsafe { gpu.device().end_command_buffer(commands) }.unwrap();
    });
}

/// Calls `lend` with a command buffer that is being recorded, and frees it afterwards.
fn with_commands(gpu: &Arc<Gpu>, lend: impl FnOnce(vk::CommandBuffer)) {
    let device = gpu.device();
    // SAFETY: callers that submit the commands wait for them.
    unsafe {
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(gpu.queue_family());
        let pool = device.create_command_pool(&info, None).unwrap();
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        let commands = device.allocate_command_buffers(&info).unwrap();
        let info = vk::CommandBufferBeginInfo::default();
        device.begin_command_buffer(commands[0], &info).unwrap();
        lend(commands[0]);
        device.destroy_command_pool(pool, None);
    }
}

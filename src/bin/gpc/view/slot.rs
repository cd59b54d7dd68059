//! Command buffers that alternate, so that one is recorded while the other is executed.

use super::device::Device;
use super::layer::Job;
use super::picture::Picture;
use ash::vk;
use gpc::vulkan::VulkanError;
use std::rc::Rc;
use std::sync::Arc;

/// Largest number of command buffers in flight.
pub const SLOTS: usize = 2;

/// A command buffer, and the objects that its commands use until they have run.
pub struct Slot {
    device: Arc<Device>,
    pool: vk::CommandPool,
    commands: vk::CommandBuffer,
    done: vk::Fence,
    /// Semaphore that is signalled when the window's image may be drawn to.
    pub free: vk::Semaphore,
    is_busy: bool,
    /// Work on pictures that the commands contain.
    pub jobs: Vec<Job>,
    /// Replaced pictures that the commands use.
    pub kept: Vec<Rc<Vec<Picture>>>,
    /// Textures of the panel to free once these commands have run.
    pub textures: Vec<egui::TextureId>,
}

impl Slot {
    pub fn new(device: &Arc<Device>) -> Result<Self, VulkanError> {
        let mut slot = Self {
            device: device.clone(),
            pool: vk::CommandPool::null(),
            commands: vk::CommandBuffer::null(),
            done: vk::Fence::null(),
            free: vk::Semaphore::null(),
            is_busy: false,
            jobs: Vec::new(),
            kept: Vec::new(),
            textures: Vec::new(),
        };
        let handle = &device.handle;
        // SAFETY: plain creations on a live device; `Drop` destroys what was made before a failure.
        unsafe {
            let info = vk::CommandPoolCreateInfo::default()
                .queue_family_index(device.queue_family)
                .flags(vk::CommandPoolCreateFlags::TRANSIENT);
            slot.pool = handle.create_command_pool(&info, None).map_err(VulkanError::of("vkCreateCommandPool"))?;
            let info = vk::CommandBufferAllocateInfo::default().command_pool(slot.pool).command_buffer_count(1);
            let commands =
                handle.allocate_command_buffers(&info).map_err(VulkanError::of("vkAllocateCommandBuffers"))?;
            slot.commands = commands.first().copied().unwrap_or_default();
            slot.done =
                handle.create_fence(&vk::FenceCreateInfo::default(), None).map_err(VulkanError::of("vkCreateFence"))?;
            slot.free = handle
                .create_semaphore(&vk::SemaphoreCreateInfo::default(), None)
                .map_err(VulkanError::of("vkCreateSemaphore"))?;
        }
        Ok(slot)
    }

    /// Whether commands were submitted and are not known to be finished.
    pub fn is_busy(&self) -> bool {
        self.is_busy
    }

    /// Returns true once when the submitted commands have run.
    pub fn poll(&mut self) -> Result<bool, VulkanError> {
        if !self.is_busy {
            return Ok(false);
        }
        // SAFETY: the fence belongs to the last submission.
        let is_done =
            unsafe { self.device.handle.get_fence_status(self.done) }.map_err(VulkanError::of("vkGetFenceStatus"))?;
        self.is_busy = !is_done;
        Ok(is_done)
    }

    /// Begins recording.
    pub fn begin(&mut self) -> Result<vk::CommandBuffer, VulkanError> {
        // SAFETY: the last submission has been executed.
        unsafe {
            self.device
                .handle
                .reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty())
                .map_err(VulkanError::of("vkResetCommandPool"))?;
            let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
            self.device
                .handle
                .begin_command_buffer(self.commands, &begin)
                .map_err(VulkanError::of("vkBeginCommandBuffer"))?;
        }
        Ok(self.commands)
    }

    /// Submits the recorded commands. The commands draw to the window's image once `free` is signalled, and signal
    /// `drawn` when they are done.
    pub fn submit(&mut self, drawn: vk::Semaphore) -> Result<(), VulkanError> {
        let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(self.commands)];
        // Rendering need not wait for the window's image, which is first used by copies.
        let waits =
            [vk::SemaphoreSubmitInfo::default().semaphore(self.free).stage_mask(vk::PipelineStageFlags2::ALL_TRANSFER)];
        let signals =
            [vk::SemaphoreSubmitInfo::default().semaphore(drawn).stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)];
        let submits = [vk::SubmitInfo2::default()
            .command_buffer_infos(&commands)
            .wait_semaphore_infos(&waits)
            .signal_semaphore_infos(&signals)];
        // SAFETY: the caller recorded the commands and keeps the objects that they use in this slot; the fence is not
        // in use.
        unsafe {
            self.device.handle.end_command_buffer(self.commands).map_err(VulkanError::of("vkEndCommandBuffer"))?;
            self.device.handle.reset_fences(&[self.done]).map_err(VulkanError::of("vkResetFences"))?;
            self.device
                .handle
                .queue_submit2(*self.device.queue(), &submits, self.done)
                .map_err(VulkanError::of("vkQueueSubmit2"))?;
        }
        self.is_busy = true;
        Ok(())
    }
}

impl Drop for Slot {
    fn drop(&mut self) {
        self.device.wait();
        // SAFETY: the commands are not being executed.
        unsafe {
            self.device.handle.destroy_semaphore(self.free, None);
            self.device.handle.destroy_fence(self.done, None);
            self.device.handle.destroy_command_pool(self.pool, None);
        }
    }
}

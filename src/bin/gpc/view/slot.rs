//! Command buffers that take turns, so that one is recorded while another is executed.

use super::device::Device;
use super::layer::Job;
use super::picture::Picture;
use super::source::Stage;
use ash::vk;
use gpc::vulkan::VulkanError;
use std::rc::Rc;
use std::sync::Arc;

/// Largest number of frames in flight.
pub const SLOTS: usize = 2;

/// Replaced object that commands may still use.
pub enum Kept {
    Stage(#[expect(dead_code, reason = "kept until it is dropped")] Box<Stage>),
    Pictures(#[expect(dead_code, reason = "kept until it is dropped")] Vec<Picture>),
}

/// A command buffer, and what its commands use until they are done.
pub struct Slot {
    device: Arc<Device>,
    pool: vk::CommandPool,
    commands: vk::CommandBuffer,
    done: vk::Fence,
    /// Signalled when the window's image is free to be drawn.
    pub free: vk::Semaphore,
    is_busy: bool,
    /// Work of the layers.
    pub jobs: Vec<Job>,
    /// Replaced objects that the commands use.
    pub kept: Vec<Rc<Kept>>,
    /// Textures of the panel that these commands are the last to use.
    pub textures: Vec<egui::TextureId>,
    /// Whether they put the scene on the device.
    pub uploads: bool,
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
            uploads: false,
        };
        let handle = &device.handle;
        // SAFETY: plain creations on a live device; what was made before a failure is destroyed by `Drop`.
        unsafe {
            let info = vk::CommandPoolCreateInfo::default()
                .queue_family_index(device.queue_family)
                .flags(vk::CommandPoolCreateFlags::TRANSIENT);
            slot.pool = handle
                .create_command_pool(&info, None)
                .map_err(VulkanError::of("vkCreateCommandPool"))?;
            let info = vk::CommandBufferAllocateInfo::default()
                .command_pool(slot.pool)
                .command_buffer_count(1);
            let commands = handle
                .allocate_command_buffers(&info)
                .map_err(VulkanError::of("vkAllocateCommandBuffers"))?;
            slot.commands = commands.first().copied().unwrap_or_default();
            slot.done = handle
                .create_fence(&vk::FenceCreateInfo::default(), None)
                .map_err(VulkanError::of("vkCreateFence"))?;
            slot.free = handle
                .create_semaphore(&vk::SemaphoreCreateInfo::default(), None)
                .map_err(VulkanError::of("vkCreateSemaphore"))?;
        }
        Ok(slot)
    }

    /// Whether commands are still to be executed.
    pub fn is_busy(&self) -> bool {
        self.is_busy
    }

    /// Whether commands that were submitted have been done since the last call.
    pub fn poll(&mut self) -> Result<bool, VulkanError> {
        if !self.is_busy {
            return Ok(false);
        }
        // SAFETY: the fence was handed to the last submission.
        let is_done = unsafe { self.device.handle.get_fence_status(self.done) }
            .map_err(VulkanError::of("vkGetFenceStatus"))?;
        self.is_busy = !is_done;
        Ok(is_done)
    }

    /// Begins recording.
    pub fn begin(&mut self) -> Result<vk::CommandBuffer, VulkanError> {
        // SAFETY: the last submission is done.
        unsafe {
            self.device
                .handle
                .reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty())
                .map_err(VulkanError::of("vkResetCommandPool"))?;
            let begin = vk::CommandBufferBeginInfo::default()
                .flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
            self.device
                .handle
                .begin_command_buffer(self.commands, &begin)
                .map_err(VulkanError::of("vkBeginCommandBuffer"))?;
        }
        Ok(self.commands)
    }

    /// Submits what was recorded: it draws the window's image once that is free, and signals when it is drawn.
    pub fn submit(&mut self, drawn: vk::Semaphore) -> Result<(), VulkanError> {
        let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(self.commands)];
        // The window's image is first copied to; rendering before that needs not wait.
        let waits = [vk::SemaphoreSubmitInfo::default()
            .semaphore(self.free)
            .stage_mask(vk::PipelineStageFlags2::ALL_TRANSFER)];
        let signals = [vk::SemaphoreSubmitInfo::default()
            .semaphore(drawn)
            .stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)];
        let submits = [vk::SubmitInfo2::default()
            .command_buffer_infos(&commands)
            .wait_semaphore_infos(&waits)
            .signal_semaphore_infos(&signals)];
        // SAFETY: the commands were recorded by the caller, who keeps what they use in this slot; the fence is not in use.
        unsafe {
            self.device
                .handle
                .end_command_buffer(self.commands)
                .map_err(VulkanError::of("vkEndCommandBuffer"))?;
            self.device
                .handle
                .reset_fences(&[self.done])
                .map_err(VulkanError::of("vkResetFences"))?;
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
        // SAFETY: nothing is executed any more.
        unsafe {
            self.device.handle.destroy_semaphore(self.free, None);
            self.device.handle.destroy_fence(self.done, None);
            self.device.handle.destroy_command_pool(self.pool, None);
        }
    }
}

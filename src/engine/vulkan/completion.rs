//! Check of whether the device has executed the last recording.

use super::{Gpu, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Event that tells whether the device has executed a recording. The device resets the event where the commands begin,
/// and sets it where they end. An event suits because the CPU may query it at any time, unlike memory that the device
/// writes.
pub(crate) struct Completion {
    gpu: Arc<Gpu>,
    event: vk::Event,
    is_recorded: bool,
}

impl Completion {
    /// Makes the event. Nothing has been recorded yet.
    ///
    /// # Errors
    /// [`VulkanError::Call`] if the event can't be made.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        // SAFETY: plain creation on a live device.
        let event = unsafe { gpu.device.create_event(&vk::EventCreateInfo::default(), None) }
            .map_err(VulkanError::of("vkCreateEvent"))?;
        Ok(Self { gpu: gpu.clone(), event, is_recorded: false })
    }

    /// Begins a recording. The commands of the previous recording have run, or will never be executed.
    ///
    /// Returns whether the previous commands have run.
    pub fn begin(&mut self, recorder: &Recorder<'_>) -> bool {
        let was_done = self.check().is_ok();
        self.is_recorded = true;
        // SAFETY: by the recorder's contract, no commands that use the event are pending, and the new ones are outside
        // of a render pass; synchronization2 is enabled.
        unsafe {
            // An error can be ignored: the device resets the event too.
            let _ = self.gpu.device.reset_event(self.event);
            self.gpu.device.cmd_reset_event2(recorder.raw(), self.event, vk::PipelineStageFlags2::ALL_COMMANDS);
        }
        was_done
    }

    /// Ends a recording. The CPU may read its results once the commands have run.
    pub fn end(&self, recorder: &Recorder<'_>) {
        let all = vk::PipelineStageFlags2::ALL_COMMANDS;
        let to_cpu = [vk::MemoryBarrier2::default()
            .src_stage_mask(all)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::HOST)
            .dst_access_mask(vk::AccessFlags2::HOST_READ)];
        let visible = vk::DependencyInfo::default().memory_barriers(&to_cpu);
        let after = [vk::MemoryBarrier2::default().src_stage_mask(all).dst_stage_mask(all)];
        let set = vk::DependencyInfo::default().memory_barriers(&after);
        let raw = recorder.raw();
        // SAFETY: the recorder's contract; synchronization2 is enabled.
        unsafe {
            self.gpu.device.cmd_pipeline_barrier2(raw, &visible);
            self.gpu.device.cmd_set_event2(raw, self.event, &set);
        }
    }

    /// Checks that the device has executed the last recording, without waiting.
    ///
    /// # Errors
    /// [`VulkanError::NotRecorded`] if nothing was recorded, [`VulkanError::NotDone`] if the commands have not run, or
    /// [`VulkanError::DeviceLost`].
    pub fn check(&self) -> Result<(), VulkanError> {
        if !self.is_recorded {
            return Err(VulkanError::NotRecorded);
        }
        // SAFETY: the event belongs to the device, and may be queried at any time.
        match unsafe { self.gpu.device.get_event_status(self.event) } {
            Ok(true) => Ok(()),
            Ok(false) => Err(VulkanError::NotDone),
            Err(error) => Err(VulkanError::of("vkGetEventStatus")(error)),
        }
    }
}

impl Drop for Completion {
    fn drop(&mut self) {
        // SAFETY: owners drop the event only after the commands that use it have run.
        unsafe { self.gpu.device.destroy_event(self.event, None) };
    }
}

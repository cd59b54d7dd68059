//! Presentation of images in a separate thread: drivers may wait there until an image is drawn or the window is visible.

use super::device::Device;
use super::requests::Requests;
use super::swapchain::Acquired;
use ash::vk;
use gpc::vulkan::VulkanError;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

/// Thread that presents one image at a time, until this is dropped.
pub struct Presenter {
    images: Requests<Acquired>,
    /// For each image, whether the swapchain has to be made anew because it no longer fits the window.
    outcomes: Receiver<Result<bool, VulkanError>>,
    is_busy: bool,
}

impl Presenter {
    pub fn new(device: &Arc<Device>) -> Self {
        let (outcome, outcomes) = channel();
        let device = device.clone();
        let images = Requests::new(move |image| {
            // Sending fails only while this is dropped, when nobody asks any more.
            let _ = outcome.send(present(&device, &image));
        });
        Self { images, outcomes, is_busy: false }
    }

    /// Whether an image is being presented. Until then the swapchain must not be used.
    pub fn is_busy(&self) -> bool {
        self.is_busy
    }

    /// Presents an image once it is drawn. The commands that draw it have been submitted.
    pub fn show(&mut self, image: Acquired) {
        self.images.send(image);
        self.is_busy = true;
    }

    /// Whether the swapchain has to be made anew after the last image was presented; `None` until that is known, and after it was
    /// returned.
    pub fn poll(&mut self) -> Option<Result<bool, VulkanError>> {
        let outcome = self.outcomes.try_recv().ok()?;
        self.is_busy = false;
        Some(outcome)
    }

    /// Waits until no image is being presented. The device must have finished the commands that draw it.
    pub fn wait(&mut self) -> Option<Result<bool, VulkanError>> {
        let outcome = self.is_busy.then(|| self.outcomes.recv().ok()).flatten()?;
        self.is_busy = false;
        Some(outcome)
    }
}

/// Presents an image. Returns whether the swapchain has to be made anew.
fn present(device: &Device, image: &Acquired) -> Result<bool, VulkanError> {
    let (waits, swapchains, indices) = ([image.drawn], [image.swapchain], [image.index]);
    let info = vk::PresentInfoKHR::default().wait_semaphores(&waits).swapchains(&swapchains).image_indices(&indices);
    let queue = device.queue();
    // SAFETY: the image was acquired, and submitted commands signal its semaphore. Nobody else uses the queue now, nor
    // the swapchain while the presenter is busy.
    match unsafe { device.swapchains.queue_present(*queue, &info) } {
        Ok(false) if !image.stale => Ok(false),
        Ok(_) | Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => Ok(true),
        Err(result) => Err(VulkanError::of("vkQueuePresentKHR")(result)),
    }
}

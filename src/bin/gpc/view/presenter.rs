//! Images are shown in the window by a thread of their own: drivers may wait there until an image is drawn, or until the
//! window is to be seen, and the window's thread waits for nothing.

use super::device::Device;
use super::swapchain::Acquired;
use ash::vk;
use gpc::vulkan::VulkanError;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

/// Shows one image at a time, and ends when it is dropped.
pub struct Presenter {
    /// `None` only while dropping.
    images: Option<Sender<Acquired>>,
    outcomes: Receiver<Result<Fit, VulkanError>>,
    is_busy: bool,
    thread: Option<JoinHandle<()>>,
}

/// Whether the window's images are still like the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    Fits,
    /// The images have to be made anew.
    Stale,
}

impl Presenter {
    pub fn new(device: &Arc<Device>) -> Self {
        let (images, received) = channel::<Acquired>();
        let (outcome, outcomes) = channel();
        let device = device.clone();
        let thread = std::thread::spawn(move || {
            for image in received {
                // The other end goes after this thread.
                let _ = outcome.send(present(&device, &image));
            }
        });
        Self {
            images: Some(images),
            outcomes,
            is_busy: false,
            thread: Some(thread),
        }
    }

    /// Whether an image is being shown. Until it is, the swapchain may not be used.
    pub fn is_busy(&self) -> bool {
        self.is_busy
    }

    /// Shows an image once it is drawn. What draws it was submitted.
    pub fn show(&mut self, image: Acquired) {
        if let Some(images) = &self.images {
            self.is_busy = images.send(image).is_ok();
        }
    }

    /// Result of presenting the last image; `None` until there is one, and when asked again.
    pub fn poll(&mut self) -> Option<Result<Fit, VulkanError>> {
        let outcome = self.outcomes.try_recv().ok()?;
        self.is_busy = false;
        Some(outcome)
    }

    /// Waits until no image is being shown; the device has done what draws it.
    pub fn wait(&mut self) -> Option<Result<Fit, VulkanError>> {
        let outcome = self.is_busy.then(|| self.outcomes.recv().ok()).flatten()?;
        self.is_busy = false;
        Some(outcome)
    }
}

fn present(device: &Device, image: &Acquired) -> Result<Fit, VulkanError> {
    let (waits, swapchains, indices) = ([image.drawn], [image.swapchain], [image.index]);
    let info = vk::PresentInfoKHR::default()
        .wait_semaphores(&waits)
        .swapchains(&swapchains)
        .image_indices(&indices);
    let queue = device.queue();
    // SAFETY: the image was acquired and its semaphore is signalled by what was submitted; nobody else uses the queue, nor
    // the swapchain as long as the presenter is busy.
    match unsafe { device.swapchains.queue_present(*queue, &info) } {
        Ok(false) if !image.stale => Ok(Fit::Fits),
        Ok(_) | Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => Ok(Fit::Stale),
        Err(result) => Err(VulkanError::of("vkQueuePresentKHR")(result)),
    }
}

impl Drop for Presenter {
    fn drop(&mut self) {
        self.images = None;
        if let Some(thread) = self.thread.take() {
            // A panic has been reported by the thread itself.
            let _ = thread.join();
        }
    }
}

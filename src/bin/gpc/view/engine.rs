//! The renderer on the viewer's device.

use super::device::Device;
use gpc::render::{Headless, Renderer};
use gpc::vulkan::VulkanError;
use std::sync::Arc;

/// Renderer and its device. Everything that the renderer prepares holds an [`Arc`] of the engine.
pub struct Engine {
    /// Renderer; the first field, so that it is dropped before the device.
    pub renderer: Renderer,
    pub device: Arc<Device>,
}

impl Engine {
    /// Makes a renderer on a device.
    pub fn new(device: Arc<Device>) -> Result<Self, VulkanError> {
        // SAFETY: the handles belong together, the features are enabled, and the device is kept until the renderer and
        // everything that it prepared is gone.
        let renderer = unsafe { Renderer::new(device.host()) }?;
        Ok(Self { renderer, device })
    }

    /// Makes a renderer that submits to the window's queue and waits, for another thread than the window's. Its owner
    /// drops it before the engine.
    pub fn headless(&self) -> Result<Headless, VulkanError> {
        // SAFETY: the queue is that of the renderer's device, and is locked wherever it is used.
        unsafe { Headless::with_queue(self.renderer.clone(), self.device.queue.clone()) }
    }
}

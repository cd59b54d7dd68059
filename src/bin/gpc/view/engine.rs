//! The renderer in the viewer's device.

use super::device::Device;
use gpc::render::Renderer;
use gpc::vulkan::VulkanError;
use std::sync::Arc;

/// The renderer, and the device that it works in. All that it prepares is kept beside an [`Arc`] of this.
pub struct Engine {
    /// First, since it goes before the device.
    pub renderer: Renderer,
    pub device: Arc<Device>,
}

impl Engine {
    /// A renderer in a device.
    pub fn new(device: Arc<Device>) -> Result<Self, VulkanError> {
        // SAFETY: the handles belong together, the features are enabled, and the device is kept until the renderer and
        // all that it prepared is gone.
        let renderer = unsafe { Renderer::new(device.host()) }?;
        Ok(Self { renderer, device })
    }
}

//! Lost devices: how often the viewer may open another one.

use crate::cli::exit;
use ash::vk;
use gpc::vulkan::VulkanError;
use std::time::{Duration, Instant};

/// Number of devices that may be lost within [`WHILE`]; after one more, the viewer gives up.
const MOST: usize = 3;
const WHILE: Duration = Duration::from_secs(60);

/// Times at which devices were lost.
#[derive(Debug, Default)]
pub struct Losses(Vec<Instant>);

impl Losses {
    /// Records the loss of a device. Returns whether to open another one.
    pub fn book(&mut self, now: Instant) -> bool {
        self.0.retain(|then| now.duration_since(*then) < WHILE);
        self.0.push(now);
        self.0.len() <= MOST
    }
}

/// Whether an error is a lost device, or the loss of the window's surface that comes with it.
pub fn is_lost(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        matches!(
            exit::vulkan(cause),
            Some(VulkanError::DeviceLost | VulkanError::Call { result: vk::Result::ERROR_SURFACE_LOST_KHR, .. })
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::render::{EngineError, RenderError};

    #[test]
    fn devices_are_lost_only_so_often() {
        let start = Instant::now();
        let after = |seconds| start + Duration::from_secs(seconds);
        let mut losses = Losses::default();
        assert!(losses.book(start) && losses.book(after(1)) && losses.book(after(2)));
        assert!(!losses.book(after(3)));
        assert!(losses.book(after(70)));
    }

    #[test]
    fn other_errors_are_no_loss() {
        assert!(is_lost(&VulkanError::DeviceLost.into()));
        let rendering = RenderError::Engine(EngineError::Vulkan(VulkanError::DeviceLost));
        assert!(is_lost(&anyhow::Error::from(rendering).context("drawing")));
        assert!(!is_lost(&anyhow::anyhow!("the device was lost")));
        assert!(!is_lost(&VulkanError::NoValidation.into()));
        let call = |result| is_lost(&VulkanError::of("vkQueuePresentKHR")(result).into());
        assert!(call(vk::Result::ERROR_SURFACE_LOST_KHR));
        assert!(!call(vk::Result::ERROR_FORMAT_NOT_SUPPORTED));
    }
}

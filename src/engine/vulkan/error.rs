//! What can go wrong with a device.

use super::Missing;
use ash::vk;

/// An error of the Vulkan layer.
#[derive(Debug, thiserror::Error)]
pub enum VulkanError {
    /// There is no Vulkan loader.
    #[error("no Vulkan loader: {0}. {help}", help = super::MISSING_DRIVER_HELP)]
    NoLoader(String),
    /// There is no device that fits.
    #[error("no suitable Vulkan device{}: {found}. {help}", asked.as_ref().map(|name| format!(" named \"{name}\"")).unwrap_or_default(), help = super::MISSING_DRIVER_HELP)]
    NoDevice {
        /// The name asked for, if one was.
        asked: Option<String>,
        /// Each device found and what it lacks.
        found: String,
    },
    /// The device lacks something.
    #[error("device \"{device}\" lacks {}", .missing.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))]
    Missing {
        /// The device's name.
        device: String,
        /// All that it lacks.
        missing: Vec<Missing>,
    },
    /// The queue family is none of the device's, or can't do what commands ask of it.
    #[error(
        "queue family {found} of device \"{device}\" has no graphics and compute; {}",
        match possible { Some(family) => format!("family {family} has"), None => "none has".to_owned() }
    )]
    QueueFamily {
        /// The device's name.
        device: String,
        /// The family asked for.
        found: u32,
        /// The first family that will do.
        possible: Option<u32>,
    },
    /// A function is absent that an extension has of which the host said that it is enabled.
    #[error("Host::{member} is true and there is no {function}: {remedy}")]
    NotEnabled {
        /// The member of [`Host`](super::Host).
        member: &'static str,
        /// The function.
        function: &'static str,
        /// What makes it there.
        remedy: &'static str,
    },
    /// A function of Vulkan 1.3 is absent.
    #[error(
        "there is no {0}: create the instance for Vulkan 1.3 (apiVersion), with a loader and a driver that have it"
    )]
    NoFunction(&'static str),
    /// The device was lost.
    #[error("the device was lost; its driver may have reset it")]
    DeviceLost,
    /// Memory ran out.
    #[error(
        "out of memory: {what} of {bytes} bytes could not be allocated; ask for a smaller image, fewer samples or another bound on memory"
    )]
    OutOfMemory {
        /// What the memory was for.
        what: String,
        /// Its size.
        bytes: u64,
    },
    /// A buffer is larger than the device can address.
    #[error("{what} needs {needed} {unit} and the device addresses at most {limit} in one buffer")]
    TooLarge {
        /// What the buffer was for.
        what: String,
        /// How much was asked for.
        needed: u64,
        /// Bytes or elements.
        unit: &'static str,
        /// The device's limit.
        limit: u64,
    },
    /// The driver runs workgroups in subgroups that kernels were not made for.
    #[error(
        "the driver runs workgroups of {lanes} invocations in several subgroups, and can't be asked for others; another driver of the device may have VkPhysicalDeviceVulkan13Properties::requiredSubgroupSizeStages with compute shaders"
    )]
    Subgroups {
        /// Invocations of a subgroup that kernels were made for.
        lanes: u32,
    },
    /// It was asked what a recording did before there was one.
    #[error("nothing was recorded yet; record and submit it, and wait for its commands")]
    NotRecorded,
    /// It was asked what a recording did before the device had done it.
    #[error(
        "the commands of the last recording are not done: they were not submitted, or still run; wait for them, by a fence or a timeline semaphore"
    )]
    NotDone,
    /// The validation layer was asked for and is not installed.
    #[error(
        "the validation layer VK_LAYER_KHRONOS_validation is not installed (Debian: vulkan-validationlayers)"
    )]
    NoValidation,
    /// Any other error of Vulkan.
    #[error("{call} failed: {result}")]
    Call {
        /// What was tried.
        call: &'static str,
        /// Vulkan's answer.
        result: vk::Result,
    },
}

impl VulkanError {
    /// Whether the device is lost or its memory exhausted, so that trying again as it is makes no sense.
    #[must_use]
    pub fn is_device_failure(&self) -> bool {
        matches!(self, Self::DeviceLost | Self::OutOfMemory { .. })
    }

    /// Refuses to need more of something than the device can address.
    ///
    /// # Errors
    /// [`VulkanError::TooLarge`] if `needed` passes `limit`.
    pub(crate) fn check_limit(
        what: &str,
        needed: u64,
        unit: &'static str,
        limit: u64,
    ) -> Result<(), Self> {
        if needed > limit {
            return Err(Self::TooLarge {
                what: what.to_owned(),
                needed,
                unit,
                limit,
            });
        }
        Ok(())
    }

    /// Turns a result of `call` into an error: a lost device and exhausted memory are told apart from all else.
    pub fn of(call: &'static str) -> impl FnOnce(vk::Result) -> Self {
        move |result| match result {
            vk::Result::ERROR_DEVICE_LOST => Self::DeviceLost,
            vk::Result::ERROR_OUT_OF_DEVICE_MEMORY | vk::Result::ERROR_OUT_OF_HOST_MEMORY => {
                Self::OutOfMemory {
                    what: call.to_owned(),
                    bytes: 0,
                }
            }
            result => Self::Call { call, result },
        }
    }
}

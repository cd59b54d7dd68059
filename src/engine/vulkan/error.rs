//! Errors of Vulkan and its devices.

use super::Missing;
use ash::vk;

/// Error of the Vulkan layer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VulkanError {
    /// Vulkan loader that can't be loaded; holds the reason.
    #[error("no Vulkan loader: {0}. {help}", help = super::MISSING_DRIVER_HELP)]
    NoLoader(String),
    /// No suitable device.
    #[error("no suitable Vulkan device{}: {found}. {help}", asked.as_ref().map(|name| format!(" named \"{name}\"")).unwrap_or_default(), help = super::MISSING_DRIVER_HELP)]
    NoDevice {
        /// Part of a device's name that was asked for.
        asked: Option<String>,
        /// List of the devices that were found, with the requirements that each lacks.
        found: String,
    },
    /// Device that lacks requirements.
    #[error("device \"{device}\" lacks {}", .missing.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))]
    Missing {
        /// Name of the device.
        device: String,
        /// Everything that the device lacks.
        missing: Vec<Missing>,
    },
    /// Queue family that does not exist, or lacks graphics or compute.
    #[error(
        "queue family {found} of device \"{device}\" has no graphics and compute; {}",
        match possible { Some(family) => format!("family {family} has"), None => "none has".to_owned() }
    )]
    QueueFamily {
        /// Name of the device.
        device: String,
        /// Index of the family that was given.
        found: u32,
        /// Index of the first suitable family.
        possible: Option<u32>,
    },
    /// Missing function of an extension that is enabled according to the host.
    #[error("Host::{member} is true and there is no {function}: {remedy}")]
    NotEnabled {
        /// Name of the member of [`Host`](super::Host) that says so.
        member: &'static str,
        /// Name of the missing function.
        function: &'static str,
        /// Advice for getting the function.
        remedy: &'static str,
    },
    /// Name of a missing function of Vulkan 1.3.
    #[error(
        "there is no {0}: create the instance for Vulkan 1.3 (apiVersion), with a loader and a driver that have it"
    )]
    NoFunction(&'static str),
    /// Lost device.
    #[error("the device was lost; its driver may have reset it")]
    DeviceLost,
    /// Device memory that could not be allocated.
    #[error(
        "out of memory: {}; ask for a smaller image, fewer samples or another bound on memory",
        refused(what, *bytes)
    )]
    OutOfMemory {
        /// Purpose of the memory, or name of the function that failed.
        what: String,
        /// Size of the memory in bytes; 0 if it is unknown.
        bytes: u64,
    },
    /// Buffer that is larger than the device can address.
    #[error("{what} needs {needed} {unit} and the device addresses at most {limit} in one buffer")]
    TooLarge {
        /// Purpose of the buffer.
        what: String,
        /// Size that was needed.
        needed: u64,
        /// Unit of the sizes: bytes or elements.
        unit: &'static str,
        /// Limit of the device.
        limit: u64,
    },
    /// Query about a recording before the first one was made.
    #[error("nothing was recorded yet; record and submit it, and wait for its commands")]
    NotRecorded,
    /// Query about a recording before the device has executed it.
    #[error(
        "the commands of the last recording are not done: they were not submitted, or still run; wait for them, by a fence or a timeline semaphore"
    )]
    NotDone,
    /// Validation layer that was asked for and is not installed.
    #[error("the validation layer VK_LAYER_KHRONOS_validation is not installed (Debian: vulkan-validationlayers)")]
    NoValidation,
    /// Pipeline that the driver refused.
    #[error(
        "{call} failed: {result}; was the device created with all features that are required? They are those of vulkan::Requirements::features13"
    )]
    Pipeline {
        /// Name of the function that failed.
        call: &'static str,
        /// Result of the function.
        result: vk::Result,
    },
    /// Any other error of Vulkan.
    #[error("{call} failed: {result}")]
    Call {
        /// Name of the function that failed.
        call: &'static str,
        /// Result of the function.
        result: vk::Result,
    },
}

/// Memory that was refused, for a message.
fn refused(what: &str, bytes: u64) -> String {
    match bytes {
        0 => format!("{what} failed"),
        _ => format!("{what} of {bytes} bytes could not be allocated"),
    }
}

impl VulkanError {
    /// Whether the device is lost or out of memory, so that trying again is useless.
    #[must_use]
    pub fn is_device_failure(&self) -> bool {
        matches!(self, Self::DeviceLost | Self::OutOfMemory { .. })
    }

    /// Checks that `needed` does not exceed the device's limit `limit`.
    ///
    /// # Errors
    /// [`VulkanError::TooLarge`] if `needed` is above `limit`.
    pub(crate) fn check_limit(what: &str, needed: u64, unit: &'static str, limit: u64) -> Result<(), Self> {
        if needed > limit {
            return Err(Self::TooLarge { what: what.to_owned(), needed, unit, limit });
        }
        Ok(())
    }

    /// Converts a result of `call` to an error; a lost device and a lack of memory get their own variants.
    pub fn of(call: &'static str) -> impl FnOnce(vk::Result) -> Self {
        move |result| match result {
            vk::Result::ERROR_DEVICE_LOST => Self::DeviceLost,
            vk::Result::ERROR_OUT_OF_DEVICE_MEMORY | vk::Result::ERROR_OUT_OF_HOST_MEMORY => {
                Self::OutOfMemory { what: call.to_owned(), bytes: 0 }
            }
            result => Self::Call { call, result },
        }
    }

    /// Converts a result of `call`, which makes pipelines, to an error.
    pub(crate) fn of_pipeline(call: &'static str) -> impl FnOnce(vk::Result) -> Self {
        move |result| match Self::of(call)(result) {
            Self::Call { call, result } => Self::Pipeline { call, result },
            other => other,
        }
    }
}

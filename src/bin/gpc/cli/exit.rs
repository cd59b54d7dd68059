//! Exit codes.

use gpc::render::{EngineError, RenderError};
use gpc::scene::SceneError;
use gpc::vulkan::VulkanError;

const FAILURE: u8 = 1;
const USAGE: u8 = 2;
const DEVICE_FAILURE: u8 = 4;

/// No device is suitable, or there is no display.
pub const NO_DEVICE: u8 = 3;
/// The difference of two images is above its bound.
pub const OVER_BOUND: u8 = 5;

/// A request that the command can't fulfil: wrong usage.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Usage(pub String);

/// Returns a usage error with this message.
macro_rules! usage {
    ($($text:tt)*) => {
        return Err($crate::cli::exit::Usage(format!($($text)*)).into())
    };
}
pub(crate) use usage;

/// The exit code for an error.
pub fn code(error: &anyhow::Error) -> u8 {
    error
        .chain()
        .find_map(|cause| {
            #[cfg(feature = "view")]
            if cause.is::<crate::view::NoDisplay>() {
                return Some(NO_DEVICE);
            }
            if cause.is::<Usage>() {
                Some(USAGE)
            } else if let Some(error) = vulkan(cause) {
                Some(of_vulkan(error))
            } else if let Some(error) = cause.downcast_ref::<RenderError>() {
                Some(of_rendering(error.is_usage(), error.is_device_failure()))
            } else if let Some(error) = cause.downcast_ref::<EngineError>() {
                Some(of_rendering(error.is_usage(), error.is_device_failure()))
            } else {
                cause.downcast_ref::<SceneError>().map(of_scene)
            }
        })
        .unwrap_or(FAILURE)
}

/// The Vulkan error that a cause is, or that it holds.
pub fn vulkan<'a>(cause: &'a (dyn std::error::Error + 'static)) -> Option<&'a VulkanError> {
    let engine = match cause.downcast_ref() {
        Some(RenderError::Engine(error)) => Some(error),
        _ => cause.downcast_ref(),
    };
    match engine {
        Some(EngineError::Vulkan(error)) => Some(error),
        _ => cause.downcast_ref(),
    }
}

fn of_vulkan(error: &VulkanError) -> u8 {
    match error {
        VulkanError::NoLoader(_) | VulkanError::NoDevice { .. } | VulkanError::Missing { .. } => NO_DEVICE,
        error => of_rendering(false, error.is_device_failure()),
    }
}

fn of_rendering(is_usage: bool, is_device_failure: bool) -> u8 {
    match (is_usage, is_device_failure) {
        (true, _) => USAGE,
        (_, true) => DEVICE_FAILURE,
        _ => FAILURE,
    }
}

fn of_scene(error: &SceneError) -> u8 {
    match error {
        SceneError::NoSuchScene { .. } | SceneError::NoSuchAnimation { .. } | SceneError::NoSuchVariant { .. } => USAGE,
        _ => FAILURE,
    }
}

/// An error's message with its causes and the option that it is about. Causes that the error quotes itself are left
/// out.
pub fn message(error: &anyhow::Error) -> String {
    let mut message = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        if !message.contains(&cause) {
            message = format!("{message}: {cause}");
        }
    }
    if error.chain().any(is_of_memory) {
        message += "; --max-memory BYTES is the bound";
    }
    message
}

/// Whether an error is a lack of device memory, which `--max-memory` may have caused.
fn is_of_memory(cause: &(dyn std::error::Error + 'static)) -> bool {
    match cause.downcast_ref() {
        Some(RenderError::Engine(EngineError::Memory { .. } | EngineError::Unfinished { .. })) => true,
        _ => matches!(vulkan(cause), Some(VulkanError::OutOfMemory { .. })),
    }
}

/// Whether an error means that the reader of standard output, such as `head`, has closed it.
pub fn is_closed_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        cause.downcast_ref::<std::io::Error>().is_some_and(|error| error.kind() == std::io::ErrorKind::BrokenPipe)
    })
}

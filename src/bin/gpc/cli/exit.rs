//! Exit codes.

use super::view;
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
            if view::is_no_display(cause) {
                Some(NO_DEVICE)
            } else if cause.is::<Usage>() {
                Some(USAGE)
            } else if let Some(error) = cause.downcast_ref::<RenderError>() {
                Some(of_render(error))
            } else if let Some(error) = cause.downcast_ref::<EngineError>() {
                Some(of_engine(error))
            } else if let Some(error) = cause.downcast_ref::<VulkanError>() {
                Some(of_vulkan(error))
            } else {
                cause.downcast_ref::<SceneError>().map(of_scene)
            }
        })
        .unwrap_or(FAILURE)
}

fn of_render(error: &RenderError) -> u8 {
    match error {
        RenderError::Engine(error) => of_engine(error),
        error if error.is_usage() => USAGE,
        _ => FAILURE,
    }
}

fn of_engine(error: &EngineError) -> u8 {
    match error {
        EngineError::Vulkan(error) => of_vulkan(error),
        error if error.is_usage() => USAGE,
        error if error.is_device_failure() => DEVICE_FAILURE,
        _ => FAILURE,
    }
}

fn of_vulkan(error: &VulkanError) -> u8 {
    match error {
        VulkanError::NoLoader(_) | VulkanError::NoDevice { .. } | VulkanError::Missing { .. } => NO_DEVICE,
        error if error.is_device_failure() => DEVICE_FAILURE,
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
    let is_full = |error: &VulkanError| matches!(error, VulkanError::OutOfMemory { .. });
    match cause.downcast_ref::<RenderError>() {
        Some(RenderError::Engine(EngineError::Memory { .. } | EngineError::Unfinished { .. })) => true,
        Some(RenderError::Engine(EngineError::Vulkan(error))) => is_full(error),
        Some(_) => false,
        None => cause.downcast_ref::<VulkanError>().is_some_and(is_full),
    }
}

/// Whether an error means that the reader of standard output, such as `head`, has closed it.
pub fn is_closed_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        cause.downcast_ref::<std::io::Error>().is_some_and(|error| error.kind() == std::io::ErrorKind::BrokenPipe)
    })
}

//! Answers of functions, and messages.

use crate::engine::sampler::RenderError;
use crate::host::HostError;
use crate::vulkan::{Missing, VulkanError};
use ash::vk;
use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What a function answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum GpcResult {
    /// It did what was asked.
    Success = 0,
    /// A pointer is NULL or a handle VK_NULL_HANDLE.
    Null = 1,
    /// The member `size` of a struct is not the size that the library knows: it was not set, or header and library are of
    /// different versions.
    StructSize = 2,
    /// A value is none of those possible, or contradicts another.
    Value = 3,
    /// A recording has more draws, triangles, vertices or indices than its frame was created for.
    Capacity = 4,
    /// The device, its instance or its loader lacks something that is needed.
    Unsupported = 5,
    /// Memory ran out, or GpcOptions.max_memory allows too little.
    OutOfMemory = 6,
    /// The device was lost.
    DeviceLost = 7,
    /// The driver refused something else.
    Vulkan = 8,
    /// A defect of the library. What took part in the call is to be destroyed and not used otherwise.
    Panic = 9,
    /// The commands of the last recording are not done, or there was none.
    NotReady = 10,
}

/// Why a function did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub(super) enum Error {
    #[error("{0} is NULL")]
    Null(&'static str),
    #[error(
        "{name}.size is {found} and this library's {name} has {expected} bytes: set it to sizeof({name}), and compile with the header of this library"
    )]
    StructSize {
        name: &'static str,
        found: u32,
        expected: usize,
    },
    #[error("{name} is {found}; it can be {possible}")]
    Value {
        name: &'static str,
        found: u32,
        possible: String,
    },
    #[error(
        "there is no {0}: create the instance for Vulkan 1.3 (VkApplicationInfo.apiVersion of GPC_VULKAN_API_VERSION), with a loader and a driver that have it"
    )]
    Function(&'static str),
    #[error(
        "GpcDevice.conditional_rendering is VK_TRUE and there is no {0}: create the device with VK_EXT_conditional_rendering and its feature conditionalRendering"
    )]
    ConditionalRendering(&'static str),
    #[error(
        "features->sType is {0}; it can be VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES ({expected})",
        expected = vk::StructureType::PHYSICAL_DEVICE_VULKAN_1_3_FEATURES.as_raw()
    )]
    StructureType(i32),
    #[error("the device lacks {}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))]
    Missing(Vec<Missing>),
    #[error("{}", in_c(.0))]
    Host(#[from] HostError),
    #[error("a defect of the library: {0}")]
    Panic(String),
}

/// What the error says, with C's names for what C wrote.
fn in_c(error: &HostError) -> String {
    match error {
        HostError::NoDepth => {
            "thin triangles are found by depth: lend GpcImages.depth, the depth image, or set GpcOptions.thin to VK_FALSE".to_owned()
        }
        HostError::NoCoordinates => {
            "there are alpha maps and no texture coordinates: lend GpcGeometry.coordinates".to_owned()
        }
        HostError::BlendedCentres => {
            "GpcGeometry.blended with GpcOptions.shade_all: centres are shaded by the nearest surface alone; draw the colours yourself".to_owned()
        }
        HostError::NotBlended { draw } => {
            format!("draw {draw} is blended; create the frame with GpcGeometry.blended")
        }
        HostError::AlphaMap { draw, map, maps } => {
            let asked = u32::from(*map) + 1;
            format!("GpcDraw.alpha_map of draw {draw} is {asked}; it can be 0 to {maps}")
        }
        HostError::FlatProjection => {
            "GpcScenery.projection has a scale of 0 along y: it is projection[1][1], in columns".to_owned()
        }
        HostError::IndexType { found } => format!(
            "GpcGeometry.index_type is {}; it can be VK_INDEX_TYPE_UINT16 (0) or VK_INDEX_TYPE_UINT32 (1)",
            found.as_raw()
        ),
        other => other.to_string(),
    }
}

impl From<VulkanError> for Error {
    fn from(error: VulkanError) -> Self {
        Self::Host(error.into())
    }
}

impl Error {
    fn result(&self) -> GpcResult {
        match self {
            Self::Null(_) => GpcResult::Null,
            Self::StructSize { .. } => GpcResult::StructSize,
            Self::Value { .. } => GpcResult::Value,
            Self::StructureType(_) => GpcResult::Value,
            Self::Function(_) | Self::ConditionalRendering(_) | Self::Missing(_) => {
                GpcResult::Unsupported
            }
            Self::Panic(_) => GpcResult::Panic,
            Self::Host(error) => match error {
                HostError::NullHandle(_) => GpcResult::Null,
                HostError::Capacity { .. }
                | HostError::Indices { .. }
                | HostError::Vertices { .. } => GpcResult::Capacity,
                HostError::Render(RenderError::Vulkan(error)) => match error {
                    VulkanError::Missing { .. } => GpcResult::Unsupported,
                    VulkanError::QueueFamily { .. } => GpcResult::Value,
                    VulkanError::OutOfMemory { .. } => GpcResult::OutOfMemory,
                    VulkanError::DeviceLost => GpcResult::DeviceLost,
                    VulkanError::TooLarge { .. } => GpcResult::Value,
                    VulkanError::NotRecorded | VulkanError::NotDone => GpcResult::NotReady,
                    _ => GpcResult::Vulkan,
                },
                HostError::Render(RenderError::Memory { .. }) => GpcResult::OutOfMemory,
                _ => GpcResult::Value,
            },
        }
    }
}

thread_local! {
    static LAST: RefCell<CString> = RefCell::default();
}

/// What the last call of the calling thread that failed has to say: UTF-8, in English, for a log. Never NULL; empty where
/// none has failed.
///
/// Threads: any. The text is the thread's own.
/// Lifetime: until the thread's next call of this library that fails, or its end.
#[unsafe(no_mangle)]
pub extern "C" fn gpc_last_error() -> *const c_char {
    let text = LAST.try_with(|last| last.borrow().as_ptr());
    text.unwrap_or(c"".as_ptr())
}

/// Runs the body of a function of the API: panics end here, and errors leave their message.
pub(super) fn answer(body: impl FnOnce() -> Result<(), Error>) -> GpcResult {
    // Whatever a panic leaves half made is not to be used again, as the documentation of the result says.
    let done = catch_unwind(AssertUnwindSafe(body));
    let Err(error) = done.unwrap_or_else(|payload| Err(Error::Panic(said(payload.as_ref()))))
    else {
        return GpcResult::Success;
    };
    let text = error.to_string().replace('\0', " ");
    // A thread that is ending has no place for messages any more.
    let _ = LAST.try_with(|last| *last.borrow_mut() = CString::new(text).unwrap_or_default());
    error.result()
}

fn said(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("a panic").to_owned()
}

/// The calling thread's message.
#[cfg(test)]
pub(super) fn last_error() -> String {
    // SAFETY: the text lives until this thread's next failure.
    let text = unsafe { std::ffi::CStr::from_ptr(gpc_last_error()) };
    text.to_string_lossy().into_owned()
}

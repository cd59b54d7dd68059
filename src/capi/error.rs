//! Answers of functions, and messages.

use crate::engine::sampler::RenderError;
use crate::host::HostError;
use crate::vulkan::{Missing, VulkanError};
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
        "vkGetInstanceProcAddr finds no {0}: create the instance for Vulkan 1.3, with a loader and a driver that have it"
    )]
    Function(&'static str),
    #[error("the device lacks {}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))]
    Missing(Vec<Missing>),
    #[error(transparent)]
    Host(#[from] HostError),
    #[error("a defect of the library: {0}")]
    Panic(String),
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
            Self::Function(_) | Self::Missing(_) => GpcResult::Unsupported,
            Self::Panic(_) => GpcResult::Panic,
            Self::Host(error) => match error {
                HostError::NullHandle(_) => GpcResult::Null,
                HostError::Capacity { .. }
                | HostError::Indices { .. }
                | HostError::Vertices { .. } => GpcResult::Capacity,
                HostError::Render(RenderError::Vulkan(error)) => match error {
                    VulkanError::Missing { .. } => GpcResult::Unsupported,
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

//! Results of functions, and error messages.

use super::dialect::C;
use super::version::GPC_ABI_VERSION;
use crate::engine::sampler::EngineError;
use crate::host::{HostError, ShaderError};
use crate::vulkan::{Missing, VulkanError};
use ash::vk;
use std::any::Any;
use std::cell::RefCell;
use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Result of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum GpcResult {
    /// Success.
    Success = 0,
    /// Pointer that is NULL, or handle that is VK_NULL_HANDLE.
    Null = 1,
    /// Size or stride that the struct has in no version of the header up to the library's. Either the member was not
    /// set, or the application was compiled with the header of a later version.
    StructSize = 2,
    /// Value that is not possible, or that contradicts another one.
    Value = 3,
    /// Recording with more draws, triangles, vertices, indices or locations than its frame or list was created for, or draw
    /// whose vertices lie outside of its mesh.
    Capacity = 4,
    /// Device, instance or loader that lacks a requirement.
    Unsupported = 5,
    /// Memory that ran out, or a GpcOptions.max_memory that allows too little.
    OutOfMemory = 6,
    /// Lost device.
    DeviceLost = 7,
    /// Any other refusal by the driver.
    Vulkan = 8,
    /// Defect of the library. The objects that took part in the call must be destroyed and not used otherwise.
    Panic = 9,
    /// Query about a recording whose commands are not done, or before the first recording.
    NotReady = 10,
    /// Member `type` with the value of another struct, or member `next` that points to a struct that the library does
    /// not know.
    StructType = 11,
    /// Shader that was compiled without gpc_visibility.glsl, or with a version of it that the library does not support.
    ShaderVersion = 12,
}

/// Reason for which a function failed.
#[derive(Debug, thiserror::Error)]
pub(super) enum Error {
    #[error("{0} is NULL")]
    Null(&'static str),
    #[error("{} is {found}; {}", given.named(name), given.expectation(name, *found, *expected))]
    StructSize { given: GivenSize, name: &'static str, found: usize, expected: usize },
    #[error("{name}.type is {found}; it can be {expected}, as the struct's gpc_init function sets it")]
    StructType { name: &'static str, found: u32, expected: u32 },
    #[error(
        "{name}.next leads to a struct of type {found}, by which this library, version {}, does not extend a {name}",
        env!("CARGO_PKG_VERSION")
    )]
    Next { name: &'static str, found: u32 },
    #[error("{name} is {found}; it can be {possible}")]
    Value { name: &'static str, found: u32, possible: String },
    #[error(
        "there is no {0}: create the instance for Vulkan 1.3 (VkApplicationInfo.apiVersion of GPC_VULKAN_API_VERSION), with a loader and a driver that have it"
    )]
    Function(&'static str),
    #[error(
        "features->sType is {0}; it can be VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES ({expected})",
        expected = vk::StructureType::PHYSICAL_DEVICE_VULKAN_1_3_FEATURES.as_raw()
    )]
    FeaturesType(i32),
    #[error("the device lacks {}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))]
    Missing(Vec<Missing>),
    #[error(transparent)]
    Shader(#[from] ShaderError),
    #[error("the size of a shader is {0} bytes; it can be a multiple of 4")]
    ShaderSize(usize),
    #[error("{}", .0.message(C::GEOMETRY))]
    Host(#[from] HostError),
    #[error("a defect of the library: {0}")]
    Panic(String),
}

/// Where a program gave the size of a struct.
#[derive(Clone, Copy, Debug)]
pub(super) enum GivenSize {
    /// In the struct's first member, which its `gpc_init` function sets.
    Member,
    /// In an argument of a function.
    Argument,
    /// In the stride of an array with this name.
    Stride(&'static str),
}

impl GivenSize {
    /// What held the size, of a struct called `name`.
    fn named(self, name: &str) -> String {
        match self {
            Self::Member => format!("{name}.size"),
            Self::Argument => format!("the size of a {name}"),
            Self::Stride(stride) => stride.to_owned(),
        }
    }

    /// Message about a size that the struct does not have, with the possible sizes.
    fn expectation(self, name: &str, found: usize, expected: usize) -> String {
        // A struct that nothing has filled may hold any size.
        let may_be_unfilled = matches!(self, Self::Member);
        if found > expected {
            let version = env!("CARGO_PKG_VERSION");
            let unfilled =
                if may_be_unfilled { "either the struct's gpc_init function was not called, or " } else { "" };
            format!(
                "a {name} of this library, version {version}, binary interface {GPC_ABI_VERSION}, has {expected} bytes: {unfilled}the program was compiled with the header of a later version; then link the library of that version"
            )
        } else {
            let by = if may_be_unfilled { ", as the struct's gpc_init function sets it" } else { "" };
            format!("it can be sizeof({name}), which is {expected}{by}")
        }
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
            Self::StructType { .. } | Self::Next { .. } => GpcResult::StructType,
            Self::Value { .. } => GpcResult::Value,
            Self::FeaturesType(_) => GpcResult::Value,
            Self::Function(_) | Self::Missing(_) => GpcResult::Unsupported,
            Self::ShaderSize(_) | Self::Shader(ShaderError::NotSpirv(_)) => GpcResult::Value,
            Self::Shader(_) => GpcResult::ShaderVersion,
            Self::Panic(_) => GpcResult::Panic,
            Self::Host(error) => Self::of_host(error),
        }
    }

    fn of_host(error: &HostError) -> GpcResult {
        match error {
            HostError::At { error, .. } => Self::of_host(error),
            HostError::Null(_) | HostError::NullImage { .. } | HostError::NoCoordinates => GpcResult::Null,
            HostError::Capacity { .. }
            | HostError::Indices { .. }
            | HostError::Corners { .. }
            | HostError::Vertices { .. } => GpcResult::Capacity,
            HostError::Engine(EngineError::Vulkan(error)) => match error {
                VulkanError::Missing { .. } | VulkanError::NoFunction(_) | VulkanError::NotEnabled { .. } => {
                    GpcResult::Unsupported
                }
                VulkanError::QueueFamily { .. } => GpcResult::Value,
                VulkanError::OutOfMemory { .. } => GpcResult::OutOfMemory,
                VulkanError::DeviceLost => GpcResult::DeviceLost,
                VulkanError::TooLarge { .. } => GpcResult::Value,
                VulkanError::NotRecorded | VulkanError::NotDone => GpcResult::NotReady,
                _ => GpcResult::Vulkan,
            },
            HostError::Engine(EngineError::Memory { .. }) => GpcResult::OutOfMemory,
            _ => GpcResult::Value,
        }
    }
}

/// Message of a thread. It has a fixed place, so that a pointer to it stays valid when a later call fails.
struct Message([u8; Self::BYTES]);

impl Message {
    /// Longest message, with the zero at its end.
    const BYTES: usize = 4096;

    /// Stores a text, cut at the end of a character if it is too long.
    fn set(&mut self, text: &str) {
        let fits = |end: &usize| text.is_char_boundary(*end);
        let end = (0..=text.len().min(Self::BYTES - 1)).rev().find(fits).unwrap_or(0);
        let bytes = &text.as_bytes()[..end];
        self.0[..end].copy_from_slice(bytes);
        // A zero within the text would hide the rest of it.
        self.0[..end].iter_mut().filter(|byte| **byte == 0).for_each(|byte| *byte = b' ');
        self.0[end] = 0;
    }
}

thread_local! {
    static LAST: RefCell<Message> = const { RefCell::new(Message([0; Message::BYTES])) };
}

/// Message of the calling thread's last call that failed: UTF-8, in English, for logs. Never NULL; empty if no call has
/// failed. The pointer is the same in all calls of a thread, so printf("%u %s", gpc_frame_record(...), gpc_last_error())
/// prints the message of that call, whichever argument is computed first.
///
/// Threads: any. Each thread has its own message.
/// Lifetime: the text is that of the thread's last failure; the pointer is valid until the thread ends.
#[unsafe(no_mangle)]
pub extern "C" fn gpc_last_error() -> *const c_char {
    LAST.with(|last| last.as_ptr().cast_const().cast())
}

/// Runs the body of a function of the API. Panics end here, and the message of an error is stored for gpc_last_error.
pub(super) fn answer(body: impl FnOnce() -> Result<(), Error>) -> GpcResult {
    // After a panic, the objects that took part must not be used, as the documentation of the result says.
    let done = catch_unwind(AssertUnwindSafe(body));
    let Err(error) = done.unwrap_or_else(|payload| Err(Error::Panic(said(payload.as_ref())))) else {
        return GpcResult::Success;
    };
    let text = error.to_string();
    LAST.with_borrow_mut(|last| last.set(&text));
    error.result()
}

fn said(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("a panic").to_owned()
}

/// Message of the calling thread.
#[cfg(test)]
pub(super) fn last_error() -> String {
    // SAFETY: the text lives until this thread's next failure.
    let text = unsafe { std::ffi::CStr::from_ptr(gpc_last_error()) };
    text.to_string_lossy().into_owned()
}

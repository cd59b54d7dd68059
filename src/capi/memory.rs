//! Device memory from the application's functions.

use super::input::{Element, shown};
use crate::vulkan::{AllocateMemory, HostMemory, MemoryRequest, MemoryUse};
use ash::vk;
use std::ffi::{CString, c_char, c_void};
use std::ptr::NonNull;

/// Kind of memory.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcMemoryUse {
    /// Device memory.
    Device = 0,
    /// Memory that the CPU writes and the device reads: mapped, with VK_MEMORY_PROPERTY_HOST_COHERENT_BIT.
    Upload = 1,
    /// Memory that the device writes and the CPU reads: mapped, with VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, and
    /// preferably VK_MEMORY_PROPERTY_HOST_CACHED_BIT.
    Readback = 2,
}

/// Memory that a buffer or an image of the library needs.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcMemoryRequest {
    /// The library's sizeof(GpcMemoryRequest).
    pub size: u32,
    /// GPC_STRUCT_TYPE_MEMORY_REQUEST.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Purpose of the memory, for logs: UTF-8, alive until the function returns.
    pub name: *const c_char,
    /// Size, alignment and permitted memory types.
    pub requirements: vk::MemoryRequirements,
    /// Kind of memory: a GpcMemoryUse.
    pub usage: u32,
    /// VK_TRUE for a buffer, VK_FALSE for an image with optimal tiling: see
    /// VkPhysicalDeviceLimits.bufferImageGranularity.
    pub linear: vk::Bool32,
}

/// Memory that the application allocated.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcMemory {
    /// Handle of the memory object.
    pub memory: vk::DeviceMemory,
    /// Offset in the memory object in bytes: a multiple of the requested alignment.
    pub offset: u64,
    /// Address at which the offset is mapped; NULL for device memory that is not mapped, or not coherent.
    pub mapped: *mut c_void,
    /// Any pointer of the application; the library does not use it.
    pub user: *mut c_void,
}

/// Function of the application that allocates memory of the lent device. The memory has the requested size and
/// alignment and one of the requested types, and nobody else uses it until it is freed. VK_FALSE if memory ran out. The
/// function must not throw or jump out, and must not use the library.
///
/// Threads: those that create antialiasers, frames and lists; several at the same time if the application creates
/// several at the same time.
pub type GpcAllocate = Option<
    unsafe extern "C" fn(user: *mut c_void, request: *const GpcMemoryRequest, memory: *mut GpcMemory) -> vk::Bool32,
>;

/// Function of the application that frees memory from GpcAllocate. No command uses the memory any more. The function
/// must not throw or jump out, and must not use the library.
///
/// Threads: as GpcAllocate, and those that destroy objects.
pub type GpcFree = Option<unsafe extern "C" fn(user: *mut c_void, memory: *const GpcMemory)>;

/// Allocation functions of an application.
pub(super) struct Functions {
    pub allocate: unsafe extern "C" fn(*mut c_void, *const GpcMemoryRequest, *mut GpcMemory) -> vk::Bool32,
    pub free: unsafe extern "C" fn(*mut c_void, *const GpcMemory),
    pub user: *mut c_void,
}

// SAFETY: the header says that any thread that uses the library may call the functions with `user`.
unsafe impl Send for Functions {}
// SAFETY: as above.
unsafe impl Sync for Functions {}

// SAFETY: the header requires of the application's functions what the trait requires.
unsafe impl AllocateMemory for Functions {
    fn allocate(&self, request: &MemoryRequest<'_>) -> Option<HostMemory> {
        let name = CString::new(request.name).unwrap_or_default();
        let usage = match request.usage {
            MemoryUse::Device => GpcMemoryUse::Device,
            MemoryUse::Upload => GpcMemoryUse::Upload,
            MemoryUse::Readback => GpcMemoryUse::Readback,
        };
        let request = shown(GpcMemoryRequest {
            name: name.as_ptr(),
            requirements: request.requirements,
            usage: usage as u32,
            linear: u32::from(request.linear),
            ..GpcMemoryRequest::defaults()
        });
        let mut memory = GpcMemory {
            memory: vk::DeviceMemory::null(),
            offset: 0,
            mapped: std::ptr::null_mut(),
            user: std::ptr::null_mut(),
        };
        // SAFETY: the application's function, called as documented.
        let made = unsafe { (self.allocate)(self.user, &raw const request, &raw mut memory) };
        (made != vk::FALSE && memory.memory != vk::DeviceMemory::null()).then_some(HostMemory {
            memory: memory.memory,
            offset: memory.offset,
            mapped: NonNull::new(memory.mapped.cast()),
            user: memory.user,
        })
    }

    fn free(&self, memory: HostMemory) {
        let memory = GpcMemory {
            memory: memory.memory,
            offset: memory.offset,
            mapped: memory.mapped.map_or(std::ptr::null_mut(), |at| at.as_ptr().cast()),
            user: memory.user,
        };
        // SAFETY: as above.
        unsafe { (self.free)(self.user, &raw const memory) };
    }
}

//! Where device memory comes from.

use super::MemoryUse;
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{AllocationCreateDesc, AllocationScheme, Allocator};
use std::ffi::c_void;
use std::ptr::NonNull;
use std::sync::{Arc, Mutex, PoisonError};

/// An allocator that several parts of a program share.
pub type SharedAllocator = Arc<Mutex<Allocator>>;

/// Where the memory of buffers and images comes from.
#[derive(Clone, Default)]
#[non_exhaustive]
pub enum MemorySource {
    /// An allocator of the library's own.
    #[default]
    Own,
    /// The host's `gpu-allocator`.
    Shared(SharedAllocator),
    /// The host's own functions.
    Host(Arc<dyn AllocateMemory>),
}

/// Memory that a buffer or an image needs.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct MemoryRequest<'a> {
    /// What it is for, for a log.
    pub name: &'a str,
    /// Its size, alignment and possible types.
    pub requirements: vk::MemoryRequirements,
    /// Where it lies. Other than [`MemoryUse::Device`] is mapped and `HOST_COHERENT`.
    pub usage: MemoryUse,
    /// Whether it is a buffer's, and else an image's of optimal tiling: see `bufferImageGranularity`.
    pub linear: bool,
}

/// Memory that a host allocated.
#[derive(Clone, Copy, Debug)]
pub struct HostMemory {
    /// The memory.
    pub memory: vk::DeviceMemory,
    /// Where in it, in bytes: a multiple of the alignment asked for.
    pub offset: u64,
    /// Where that offset is mapped, of memory that is mapped and `HOST_COHERENT`.
    pub mapped: Option<NonNull<u8>>,
    /// The host's own.
    pub user: *mut c_void,
}

// SAFETY: pointers that are used by whoever has the memory alone, and, `user`, by the host's functions, which any thread may call.
unsafe impl Send for HostMemory {}
// SAFETY: as above.
unsafe impl Sync for HostMemory {}

/// A host's functions for device memory, called by any thread that prepares or drops what is made by the library.
///
/// # Safety
/// What is allocated is of the device lent, of one of the types asked for, as large and aligned as was asked for, used by nobody else
/// until it is freed, and mapped where it says so.
pub unsafe trait AllocateMemory: Send + Sync {
    /// Allocates; `None` where memory ran out.
    fn allocate(&self, request: &MemoryRequest<'_>) -> Option<HostMemory>;

    /// Frees what [`Self::allocate`] gave. No command uses it any more.
    fn free(&self, memory: HostMemory);
}

/// The same of a device in use.
pub(super) enum Source {
    Allocator(SharedAllocator),
    Host(Arc<dyn AllocateMemory>),
}

/// Memory of one buffer or image.
pub(super) enum Allocation {
    Allocator(gpu_allocator::vulkan::Allocation),
    /// With its bytes.
    Host(HostMemory, usize),
}

impl Source {
    pub fn allocate(&self, request: &MemoryRequest<'_>) -> Option<Allocation> {
        match self {
            Self::Allocator(shared) => {
                let made = locked(shared, |allocator| {
                    allocator.allocate(&AllocationCreateDesc {
                        name: request.name,
                        requirements: request.requirements,
                        location: match request.usage {
                            MemoryUse::Device => MemoryLocation::GpuOnly,
                            MemoryUse::Upload => MemoryLocation::CpuToGpu,
                            MemoryUse::Readback => MemoryLocation::GpuToCpu,
                        },
                        linear: request.linear,
                        allocation_scheme: AllocationScheme::GpuAllocatorManaged,
                    })
                });
                made.ok().map(Allocation::Allocator)
            }
            Self::Host(host) => {
                let made = host.allocate(request)?;
                Some(Allocation::Host(made, request.requirements.size as usize))
            }
        }
    }

    pub fn free(&self, allocation: Allocation) {
        match (self, allocation) {
            (Self::Allocator(shared), Allocation::Allocator(made)) => {
                let _ = locked(shared, |allocator| allocator.free(made));
            }
            (Self::Host(host), Allocation::Host(made, _)) => host.free(made),
            // A device has one source from its first allocation to its last.
            _ => {}
        }
    }
}

/// A poisoned lock is taken over, as an allocation that panicked left nothing half made.
fn locked<R>(shared: &SharedAllocator, f: impl FnOnce(&mut Allocator) -> R) -> R {
    f(&mut shared.lock().unwrap_or_else(PoisonError::into_inner))
}

impl Allocation {
    pub fn memory(&self) -> vk::DeviceMemory {
        match self {
            // SAFETY: the memory is used for what it was allocated for, until it is freed.
            Self::Allocator(made) => unsafe { made.memory() },
            Self::Host(made, _) => made.memory,
        }
    }

    pub fn offset(&self) -> u64 {
        match self {
            Self::Allocator(made) => made.offset(),
            Self::Host(made, _) => made.offset,
        }
    }

    /// The mapped bytes, where host and device see what the other writes without flushing. Memory to upload from and to read
    /// back from always is so; that of the device may be mapped and not so.
    pub fn bytes(&self) -> Option<&[u8]> {
        match self {
            Self::Allocator(made) => coherent(made)?.mapped_slice(),
            Self::Host(made, bytes) => {
                let mapped = made.mapped?;
                // SAFETY: the host mapped as many bytes as were asked for, which nobody else uses.
                Some(unsafe { std::slice::from_raw_parts(mapped.as_ptr(), *bytes) })
            }
        }
    }

    /// The same, to be written.
    pub fn bytes_mut(&mut self) -> Option<&mut [u8]> {
        match self {
            Self::Allocator(made) => {
                coherent(made)?;
                made.mapped_slice_mut()
            }
            Self::Host(made, bytes) => {
                let mapped = made.mapped?;
                // SAFETY: as above; the allocation is borrowed for as long.
                Some(unsafe { std::slice::from_raw_parts_mut(mapped.as_ptr(), *bytes) })
            }
        }
    }
}

/// The allocation, if it is coherent.
fn coherent(
    allocation: &gpu_allocator::vulkan::Allocation,
) -> Option<&gpu_allocator::vulkan::Allocation> {
    let flags = allocation.memory_properties();
    flags
        .contains(vk::MemoryPropertyFlags::HOST_COHERENT)
        .then_some(allocation)
}

//! Sources of device memory: an allocator of the library, a shared allocator, or functions of the host.

use super::MemoryUse;
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{AllocationCreateDesc, AllocationScheme, Allocator};
use std::ffi::c_void;
use std::ptr::NonNull;
use std::sync::{Arc, Mutex, PoisonError};

/// Allocator of device memory that several parts of a program share.
pub type SharedAllocator = Arc<Mutex<Allocator>>;

/// Source of the memory for buffers and images.
#[derive(Clone, Default)]
#[non_exhaustive]
pub enum MemorySource {
    /// A separate allocator of the library.
    #[default]
    Own,
    /// A `gpu-allocator` of the host.
    Shared(SharedAllocator),
    /// Functions of the host.
    Host(Arc<dyn AllocateMemory>),
}

/// Memory that a buffer or an image needs.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct MemoryRequest<'a> {
    /// Purpose of the memory, for logs.
    pub name: &'a str,
    /// Size, alignment and permitted memory types.
    pub requirements: vk::MemoryRequirements,
    /// Kind of memory. All kinds except [`MemoryUse::Device`] must be mapped and `HOST_COHERENT`.
    pub usage: MemoryUse,
    /// Whether the memory is for a buffer; otherwise it is for an image with optimal tiling. Allocators need this to
    /// respect the limit `bufferImageGranularity`.
    pub linear: bool,
}

/// Memory that a host allocated.
#[derive(Clone, Copy, Debug)]
pub struct HostMemory {
    /// Handle of the memory object.
    pub memory: vk::DeviceMemory,
    /// Offset in the memory object in bytes, a multiple of the requested alignment.
    pub offset: u64,
    /// Address at which the offset is mapped, if the memory is mapped and `HOST_COHERENT`.
    pub mapped: Option<NonNull<u8>>,
    /// Any pointer of the host; the library does not use it.
    pub user: *mut c_void,
}

// SAFETY: only the owner of the memory uses `mapped`, and only the host's functions use `user`; any thread may call
// them.
unsafe impl Send for HostMemory {}
// SAFETY: as above.
unsafe impl Sync for HostMemory {}

/// Functions of a host that allocate and free device memory. Any thread that prepares or drops objects of the library
/// may call them.
///
/// # Safety
/// Allocated memory belongs to the device of the [`Host`](super::Host), has one of the permitted types and at least
/// the requested size and alignment. Nobody else uses it until it is freed. If `mapped` is set, the whole size is
/// mapped there.
pub unsafe trait AllocateMemory: Send + Sync {
    /// Allocates memory; `None` if no memory is left.
    fn allocate(&self, request: &MemoryRequest<'_>) -> Option<HostMemory>;

    /// Frees memory that [`Self::allocate`] returned. No command uses it any more.
    fn free(&self, memory: HostMemory);
}

/// Source of the memory of a device in use.
pub(super) enum Source {
    Allocator(SharedAllocator),
    Host(Arc<dyn AllocateMemory>),
}

/// Memory of one buffer or image.
pub(super) enum Allocation {
    Allocator(gpu_allocator::vulkan::Allocation),
    /// Memory of the host, and its size in bytes.
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
            // A device keeps one source from its first allocation to its last.
            _ => {}
        }
    }
}

/// Calls `f` with the allocator. Poisoning of the lock is ignored: an allocation that panics leaves nothing half made.
fn locked<R>(shared: &SharedAllocator, f: impl FnOnce(&mut Allocator) -> R) -> R {
    f(&mut shared.lock().unwrap_or_else(PoisonError::into_inner))
}

impl Allocation {
    pub fn memory(&self) -> vk::DeviceMemory {
        match self {
            // SAFETY: the memory is used only for its purpose, and only until it is freed.
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

    /// Mapped bytes, if host and device see each other's writes without flushing. This is always so for upload and
    /// readback memory; device memory may be mapped and yet need flushing.
    pub fn bytes(&self) -> Option<&[u8]> {
        match self {
            Self::Allocator(made) => coherent(made)?.mapped_slice(),
            Self::Host(made, bytes) => {
                let mapped = made.mapped?;
                // SAFETY: the host mapped the requested size, and nobody else uses the memory.
                Some(unsafe { std::slice::from_raw_parts(mapped.as_ptr(), *bytes) })
            }
        }
    }

    /// Mapped bytes for writing, under the same conditions as [`Self::bytes`].
    pub fn bytes_mut(&mut self) -> Option<&mut [u8]> {
        match self {
            Self::Allocator(made) => {
                coherent(made)?;
                made.mapped_slice_mut()
            }
            Self::Host(made, bytes) => {
                let mapped = made.mapped?;
                // SAFETY: as above; the allocation is mutably borrowed as long as the slice.
                Some(unsafe { std::slice::from_raw_parts_mut(mapped.as_ptr(), *bytes) })
            }
        }
    }
}

/// The allocation, if its memory is coherent.
fn coherent(allocation: &gpu_allocator::vulkan::Allocation) -> Option<&gpu_allocator::vulkan::Allocation> {
    let flags = allocation.memory_properties();
    flags.contains(vk::MemoryPropertyFlags::HOST_COHERENT).then_some(allocation)
}

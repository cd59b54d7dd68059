//! Buffers, texel views and images that free themselves.

use super::allocation::{Allocation, MemoryRequest};
use super::{Gpu, VulkanError};
use ash::vk;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Where memory lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemoryUse {
    /// On the device.
    Device,
    /// Written by the host, read by the device.
    Upload,
    /// Written by the device, read by the host.
    Readback,
}

/// Counts the bytes of what is made through it, until that is dropped, and refuses to pass a bound.
///
/// Sizes, formats and usage are trusted to be such as the device takes, and buffers and images to be dropped, read and written
/// by the CPU while no commands use them alone. So none is made outside of the crate; see `crate::testing`.
#[derive(Clone)]
pub struct Memory {
    gpu: Arc<Gpu>,
    account: Arc<Account>,
}

struct Account {
    used: AtomicU64,
    limit: u64,
}

/// Memory of one buffer or image, freed and taken off the account when it is dropped.
struct Block {
    gpu: Arc<Gpu>,
    account: Arc<Account>,
    bytes: u64,
    allocation: Option<Allocation>,
}

impl Drop for Block {
    fn drop(&mut self) {
        if let Some(allocation) = self.allocation.take() {
            self.gpu.free(allocation);
        }
        self.account.used.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}

impl Memory {
    /// An account of at most `limit` bytes.
    #[must_use]
    pub(crate) fn new(gpu: Arc<Gpu>, limit: Option<u64>) -> Self {
        Self {
            gpu,
            account: Arc::new(Account {
                used: AtomicU64::new(0),
                limit: limit.unwrap_or(u64::MAX),
            }),
        }
    }

    /// The device.
    #[must_use]
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Bytes allocated through this account and not yet freed.
    #[must_use]
    pub fn used(&self) -> u64 {
        self.account.used.load(Ordering::Relaxed)
    }

    fn allocate(
        &self,
        name: &str,
        requirements: vk::MemoryRequirements,
        usage: MemoryUse,
        linear: bool,
    ) -> Result<Block, VulkanError> {
        let refuse = || VulkanError::OutOfMemory {
            what: name.to_owned(),
            bytes: requirements.size,
        };
        let Account { used, limit } = &*self.account;
        used.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |used| {
            used.checked_add(requirements.size)
                .filter(|sum| sum <= limit)
        })
        .map_err(|_| refuse())?;
        let mut block = Block {
            gpu: self.gpu.clone(),
            account: self.account.clone(),
            bytes: requirements.size,
            allocation: None,
        };
        let allocation = self.gpu.allocate(&MemoryRequest {
            name,
            requirements,
            usage,
            linear,
        });
        block.allocation = Some(allocation.ok_or_else(refuse)?);
        Ok(block)
    }

    /// Makes a buffer of at least `size` bytes, and at least 16.
    ///
    /// # Errors
    /// [`VulkanError::OutOfMemory`] past the account's bound or the device's memory.
    pub fn buffer(
        &self,
        name: &str,
        size: u64,
        usage: vk::BufferUsageFlags,
        location: MemoryUse,
    ) -> Result<Buffer, VulkanError> {
        let size = size.max(16);
        let info = vk::BufferCreateInfo::default().size(size).usage(usage);
        // SAFETY: the device is alive as long as the Gpu; on failure below nothing but the handle is leaked to `Drop`.
        let raw = unsafe { self.gpu.device.create_buffer(&info, None) }
            .map_err(VulkanError::of("vkCreateBuffer"))?;
        self.gpu.name(raw, name);
        let mut buffer = Buffer {
            gpu: self.gpu.clone(),
            raw,
            block: None,
            size,
        };
        // SAFETY: the buffer was just made from this device.
        let requirements = unsafe { self.gpu.device.get_buffer_memory_requirements(raw) };
        let block = self.allocate(name, requirements, location, true)?;
        if let Some(allocation) = &block.allocation {
            // SAFETY: the memory is unused, of a type the buffer takes, and bound once.
            unsafe {
                self.gpu
                    .device
                    .bind_buffer_memory(raw, allocation.memory(), allocation.offset())
            }
            .map_err(VulkanError::of("vkBindBufferMemory"))?;
        }
        buffer.block = Some(block);
        Ok(buffer)
    }

    /// A buffer that shaders read and write as a whole.
    ///
    /// # Errors
    /// [`VulkanError::TooLarge`] past the device's `maxStorageBufferRange`, else as [`Memory::buffer`].
    pub(crate) fn storage_buffer(
        &self,
        name: &str,
        size: u64,
        usage: vk::BufferUsageFlags,
        location: MemoryUse,
    ) -> Result<Buffer, VulkanError> {
        let limit = self.gpu.limits().max_storage_bytes;
        VulkanError::check_limit(name, size, "bytes", limit)?;
        self.buffer(name, size, usage, location)
    }

    /// A buffer that holds `bytes`, to be copied from by the device.
    ///
    /// # Errors
    /// As [`Memory::buffer`]; also if the driver does not map the buffer.
    pub fn upload(&self, name: &str, bytes: &[u8]) -> Result<Buffer, VulkanError> {
        self.filled(name, bytes, vk::BufferUsageFlags::TRANSFER_SRC)
    }

    /// A buffer of the host's that holds `bytes`.
    ///
    /// # Errors
    /// As [`Memory::upload`].
    pub(crate) fn filled(
        &self,
        name: &str,
        bytes: &[u8],
        usage: vk::BufferUsageFlags,
    ) -> Result<Buffer, VulkanError> {
        let size = bytes.len() as u64;
        let mut buffer = self.buffer(name, size, usage, MemoryUse::Upload)?;
        let unmapped = VulkanError::Call {
            call: "mapping an upload",
            result: vk::Result::ERROR_MEMORY_MAP_FAILED,
        };
        let mapped = buffer.bytes_mut().get_mut(..bytes.len()).ok_or(unmapped)?;
        mapped.copy_from_slice(bytes);
        Ok(buffer)
    }

    /// A buffer of `elements` texels of `format` and its view.
    ///
    /// # Errors
    /// [`VulkanError::TooLarge`] past the device's `maxTexelBufferElements`, else as [`Memory::buffer`].
    pub fn texel_buffer(
        &self,
        name: &str,
        elements: u64,
        format: vk::Format,
        usage: vk::BufferUsageFlags,
        location: MemoryUse,
    ) -> Result<BufferView, VulkanError> {
        let limit = self.gpu.limits().max_texel_elements;
        VulkanError::check_limit(name, elements, "elements", limit)?;
        let bytes = match format {
            vk::Format::R32G32B32A32_SFLOAT | vk::Format::R32G32B32A32_UINT => 16,
            vk::Format::R32G32_SFLOAT | vk::Format::R32G32_UINT => 8,
            _ => 4,
        };
        let buffer = self.buffer(name, elements.max(1) * bytes, usage, location)?;
        let info = vk::BufferViewCreateInfo::default()
            .buffer(buffer.raw)
            .format(format)
            .range(elements.max(1) * bytes);
        // SAFETY: the buffer is bound to memory and was created for texel access.
        let view = unsafe { self.gpu.device.create_buffer_view(&info, None) }
            .map_err(VulkanError::of("vkCreateBufferView"))?;
        Ok(BufferView { buffer, view })
    }

    /// An image with one view of all its levels and layers; a cube where it may be one.
    ///
    /// # Errors
    /// As [`Memory::buffer`].
    pub fn image(
        &self,
        name: &str,
        info: &vk::ImageCreateInfo<'_>,
        aspect: vk::ImageAspectFlags,
    ) -> Result<Image, VulkanError> {
        // SAFETY: `info` is valid for the device, whose limits callers have checked.
        let raw = unsafe { self.gpu.device.create_image(info, None) }
            .map_err(VulkanError::of("vkCreateImage"))?;
        self.gpu.name(raw, name);
        let mut image = Image {
            gpu: self.gpu.clone(),
            raw,
            view: vk::ImageView::null(),
            _block: None,
            extent: vk::Extent2D {
                width: info.extent.width,
                height: info.extent.height,
            },
            levels: info.mip_levels,
            layers: info.array_layers,
            aspect,
        };
        // SAFETY: the image was just made from this device.
        let requirements = unsafe { self.gpu.device.get_image_memory_requirements(raw) };
        let block = self.allocate(name, requirements, MemoryUse::Device, false)?;
        if let Some(allocation) = &block.allocation {
            // SAFETY: the memory is unused, of a type the image takes, and bound once.
            unsafe {
                self.gpu
                    .device
                    .bind_image_memory(raw, allocation.memory(), allocation.offset())
            }
            .map_err(VulkanError::of("vkBindImageMemory"))?;
        }
        image._block = Some(block);
        let cube = vk::ImageCreateFlags::CUBE_COMPATIBLE;
        let view_type = if info.flags.contains(cube) {
            vk::ImageViewType::CUBE
        } else {
            vk::ImageViewType::TYPE_2D
        };
        let view = vk::ImageViewCreateInfo::default()
            .image(raw)
            .view_type(view_type)
            .format(info.format)
            .subresource_range(image.range());
        // SAFETY: the image is bound and the format is its own.
        image.view = unsafe { self.gpu.device.create_image_view(&view, None) }
            .map_err(VulkanError::of("vkCreateImageView"))?;
        Ok(image)
    }
}

/// A buffer and its memory.
pub struct Buffer {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::Buffer,
    /// Freed after the handle is destroyed.
    block: Option<Block>,
    size: u64,
}

impl Buffer {
    /// The handle.
    #[must_use]
    pub fn handle(&self) -> vk::Buffer {
        self.raw
    }

    /// Size in bytes.
    #[must_use]
    pub fn size(&self) -> u64 {
        self.size
    }

    /// The mapped bytes; empty for device memory that the host can't see, or not without flushing it.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        self.block
            .as_ref()
            .and_then(|block| block.allocation.as_ref()?.bytes())
            .and_then(|all| all.get(..self.size as usize))
            .unwrap_or(&[])
    }

    /// The first `count` values of a read-back.
    ///
    /// # Errors
    /// [`VulkanError::Call`] if the driver did not map the buffer, or it holds fewer.
    pub fn read<T: bytemuck::AnyBitPattern>(&self, count: usize) -> Result<&[T], VulkanError> {
        self.bytes()
            .get(..count * size_of::<T>())
            .and_then(|bytes| bytemuck::try_cast_slice(bytes).ok())
            .ok_or(VulkanError::Call {
                call: "mapping a read-back",
                result: vk::Result::ERROR_MEMORY_MAP_FAILED,
            })
    }

    /// The mapped bytes, to be written before the device reads them; empty as [`Buffer::bytes`].
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        let size = self.size as usize;
        self.block
            .as_mut()
            .and_then(|block| block.allocation.as_mut()?.bytes_mut())
            .and_then(|all| all.get_mut(..size))
            .unwrap_or(&mut [])
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: owners drop a buffer only after the frames that use it are done.
        unsafe { self.gpu.device.destroy_buffer(self.raw, None) };
    }
}

/// A buffer seen as texels.
pub struct BufferView {
    /// The buffer.
    pub buffer: Buffer,
    pub(crate) view: vk::BufferView,
}

impl Drop for BufferView {
    fn drop(&mut self) {
        // SAFETY: as for the buffer, which outlives its view here.
        unsafe { self.buffer.gpu.device.destroy_buffer_view(self.view, None) };
    }
}

/// Texels of a buffer that belongs to someone else.
pub(crate) struct TexelView {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::BufferView,
}

impl TexelView {
    /// # Safety
    /// The buffer is alive, of the device, made for uniform texel access, and outlives the view.
    pub unsafe fn new(
        gpu: &Arc<Gpu>,
        buffer: vk::Buffer,
        format: vk::Format,
        offset: u64,
        bytes: u64,
    ) -> Result<Self, VulkanError> {
        let info = vk::BufferViewCreateInfo::default()
            .buffer(buffer)
            .format(format)
            .offset(offset)
            .range(bytes);
        // SAFETY: passed on to the caller.
        let raw = unsafe { gpu.device.create_buffer_view(&info, None) }
            .map_err(VulkanError::of("vkCreateBufferView"))?;
        Ok(Self {
            gpu: gpu.clone(),
            raw,
        })
    }
}

impl Drop for TexelView {
    fn drop(&mut self) {
        // SAFETY: owners drop a view only after the frames that use it are done.
        unsafe { self.gpu.device.destroy_buffer_view(self.raw, None) };
    }
}

/// An image, its view and its memory.
pub struct Image {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::Image,
    pub(crate) view: vk::ImageView,
    /// Freed after the handles are destroyed.
    _block: Option<Block>,
    /// Width and height of level 0.
    pub extent: vk::Extent2D,
    /// Number of mipmap levels.
    pub levels: u32,
    layers: u32,
    aspect: vk::ImageAspectFlags,
}

impl Image {
    /// The handle.
    #[must_use]
    pub fn handle(&self) -> vk::Image {
        self.raw
    }

    /// The view of all of it.
    #[must_use]
    pub fn view(&self) -> vk::ImageView {
        self.view
    }

    /// All of the image.
    pub fn range(&self) -> vk::ImageSubresourceRange {
        vk::ImageSubresourceRange {
            aspect_mask: self.aspect,
            base_mip_level: 0,
            level_count: self.levels,
            base_array_layer: 0,
            layer_count: self.layers,
        }
    }
}

impl Drop for Image {
    fn drop(&mut self) {
        // SAFETY: owners drop an image only after the frames that use it are done.
        unsafe {
            self.gpu.device.destroy_image_view(self.view, None);
            self.gpu.device.destroy_image(self.raw, None);
        }
    }
}

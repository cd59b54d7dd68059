//! Buffers, texel views and images that free themselves.

use super::allocation::{Allocation, MemoryRequest};
use super::{Gpu, Texels, VulkanError};
use ash::vk;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Kind of memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemoryUse {
    /// Device memory.
    Device,
    /// Memory that the host writes and the device reads.
    Upload,
    /// Memory that the device writes and the host reads.
    Readback,
}

/// Allocator that counts the bytes of everything made through it, and refuses to exceed a limit.
///
/// The functions trust that sizes, formats and usage are valid for the device, and that buffers and images are dropped,
/// read and written by the CPU only while no commands use them. Therefore no `Memory` can be made outside of the crate;
/// see `crate::testing`.
#[derive(Clone)]
pub struct Memory {
    gpu: Arc<Gpu>,
    account: Arc<Account>,
}

struct Account {
    used: AtomicU64,
    limit: u64,
}

/// Memory of a buffer or image. When this is dropped, the memory is freed and no longer counted.
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
    /// Allocator of at most `limit` bytes.
    #[must_use]
    pub(crate) fn new(gpu: Arc<Gpu>, limit: Option<u64>) -> Self {
        Self { gpu, account: Arc::new(Account { used: AtomicU64::new(0), limit: limit.unwrap_or(u64::MAX) }) }
    }

    /// Device of the memory.
    #[must_use]
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Number of bytes that are allocated at present.
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
        let refuse = || VulkanError::OutOfMemory { what: name.to_owned(), bytes: requirements.size };
        let Account { used, limit } = &*self.account;
        used.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |used| {
            used.checked_add(requirements.size).filter(|sum| sum <= limit)
        })
        .map_err(|_| refuse())?;
        let mut block =
            Block { gpu: self.gpu.clone(), account: self.account.clone(), bytes: requirements.size, allocation: None };
        let allocation = self.gpu.allocate(&MemoryRequest { name, requirements, usage, linear });
        block.allocation = Some(allocation.ok_or_else(refuse)?);
        Ok(block)
    }

    /// Makes a buffer of at least `size` bytes, and at least 16.
    ///
    /// # Errors
    /// [`VulkanError::OutOfMemory`] if the limit or the device's memory is exceeded.
    pub fn buffer(
        &self,
        name: &str,
        size: u64,
        usage: vk::BufferUsageFlags,
        location: MemoryUse,
    ) -> Result<Buffer, VulkanError> {
        let size = size.max(16);
        let info = vk::BufferCreateInfo::default().size(size).usage(usage);
        // SAFETY: the device is alive as long as the Gpu. After a failure below, `Drop` destroys the handle.
        let raw = unsafe { self.gpu.device.create_buffer(&info, None) }.map_err(VulkanError::of("vkCreateBuffer"))?;
        self.gpu.name(raw, name);
        let mut buffer = Buffer { gpu: self.gpu.clone(), raw, block: None, size };
        // SAFETY: the buffer was just made from this device.
        let requirements = unsafe { self.gpu.device.get_buffer_memory_requirements(raw) };
        let block = self.allocate(name, requirements, location, true)?;
        if let Some(allocation) = &block.allocation {
            // SAFETY: the memory is unused, of a type the buffer takes, and bound once.
            unsafe { self.gpu.device.bind_buffer_memory(raw, allocation.memory(), allocation.offset()) }
                .map_err(VulkanError::of("vkBindBufferMemory"))?;
        }
        buffer.block = Some(block);
        Ok(buffer)
    }

    /// Makes a buffer that shaders access as a whole.
    ///
    /// # Errors
    /// [`VulkanError::TooLarge`] above the device's `maxStorageBufferRange`, otherwise as [`Memory::buffer`].
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

    /// Makes a buffer with the contents `bytes`, as a source of copies.
    ///
    /// # Errors
    /// As [`Memory::buffer`]; also if the driver does not map the buffer.
    pub fn upload(&self, name: &str, bytes: &[u8]) -> Result<Buffer, VulkanError> {
        self.filled(name, bytes, vk::BufferUsageFlags::TRANSFER_SRC)
    }

    /// Makes a buffer in host memory with the contents `bytes`.
    ///
    /// # Errors
    /// As [`Memory::upload`].
    pub(crate) fn filled(&self, name: &str, bytes: &[u8], usage: vk::BufferUsageFlags) -> Result<Buffer, VulkanError> {
        let size = bytes.len() as u64;
        let mut buffer = self.buffer(name, size, usage, MemoryUse::Upload)?;
        let unmapped = VulkanError::Call { call: "mapping an upload", result: vk::Result::ERROR_MEMORY_MAP_FAILED };
        let mapped = buffer.bytes_mut().get_mut(..bytes.len()).ok_or(unmapped)?;
        mapped.copy_from_slice(bytes);
        Ok(buffer)
    }

    /// Makes a buffer of `elements` texels of `format`, and its view.
    ///
    /// # Errors
    /// [`VulkanError::TooLarge`] above the device's `maxTexelBufferElements`, otherwise as [`Memory::buffer`].
    pub fn texel_buffer(
        &self,
        name: &str,
        elements: u64,
        format: vk::Format,
        usage: vk::BufferUsageFlags,
        location: MemoryUse,
    ) -> Result<TexelBuffer, VulkanError> {
        let limit = self.gpu.limits().max_texel_elements;
        VulkanError::check_limit(name, elements, "elements", limit)?;
        let bytes = match format {
            vk::Format::R32G32B32A32_SFLOAT | vk::Format::R32G32B32A32_UINT => 16,
            vk::Format::R32G32_SFLOAT | vk::Format::R32G32_UINT => 8,
            _ => 4,
        };
        let buffer = self.buffer(name, elements.max(1) * bytes, usage, location)?;
        let info = vk::BufferViewCreateInfo::default().buffer(buffer.raw).format(format).range(elements.max(1) * bytes);
        // SAFETY: the buffer is bound to memory and was created for texel access.
        let view = unsafe { self.gpu.device.create_buffer_view(&info, None) }
            .map_err(VulkanError::of("vkCreateBufferView"))?;
        Ok(TexelBuffer { buffer, view })
    }

    /// Makes an image with a view of all its levels and layers; the view is a cube if the image is cube-compatible.
    ///
    /// # Errors
    /// As [`Memory::buffer`].
    pub fn image(
        &self,
        name: &str,
        info: &vk::ImageCreateInfo<'_>,
        aspect: vk::ImageAspectFlags,
    ) -> Result<Image, VulkanError> {
        // SAFETY: `info` is valid for the device; callers have checked its limits.
        let raw = unsafe { self.gpu.device.create_image(info, None) }.map_err(VulkanError::of("vkCreateImage"))?;
        self.gpu.name(raw, name);
        let mut image = Image {
            gpu: self.gpu.clone(),
            raw,
            view: vk::ImageView::null(),
            _block: None,
            extent: vk::Extent2D { width: info.extent.width, height: info.extent.height },
            levels: info.mip_levels,
            layers: info.array_layers,
            aspect,
        };
        // SAFETY: the image was just made from this device.
        let requirements = unsafe { self.gpu.device.get_image_memory_requirements(raw) };
        let block = self.allocate(name, requirements, MemoryUse::Device, false)?;
        if let Some(allocation) = &block.allocation {
            // SAFETY: the memory is unused, of a type the image takes, and bound once.
            unsafe { self.gpu.device.bind_image_memory(raw, allocation.memory(), allocation.offset()) }
                .map_err(VulkanError::of("vkBindImageMemory"))?;
        }
        image._block = Some(block);
        let cube = vk::ImageCreateFlags::CUBE_COMPATIBLE;
        let view_type = if info.flags.contains(cube) { vk::ImageViewType::CUBE } else { vk::ImageViewType::TYPE_2D };
        let view = vk::ImageViewCreateInfo::default()
            .image(raw)
            .view_type(view_type)
            .format(info.format)
            .subresource_range(image.range());
        // SAFETY: the image is bound and the format is its own.
        image.view =
            unsafe { self.gpu.device.create_image_view(&view, None) }.map_err(VulkanError::of("vkCreateImageView"))?;
        Ok(image)
    }
}

/// A buffer and its memory.
pub struct Buffer {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::Buffer,
    /// Memory of the buffer, freed after the handle is destroyed.
    block: Option<Block>,
    size: u64,
}

impl Buffer {
    /// Handle of the buffer.
    #[must_use]
    pub fn handle(&self) -> vk::Buffer {
        self.raw
    }

    /// Size in bytes.
    #[must_use]
    pub fn size(&self) -> u64 {
        self.size
    }

    /// Mapped bytes; empty for device memory that the host can't access, or only with flushing.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        self.block
            .as_ref()
            .and_then(|block| block.allocation.as_ref()?.bytes())
            .and_then(|all| all.get(..self.size as usize))
            .unwrap_or(&[])
    }

    /// First `count` values of a read-back.
    ///
    /// # Errors
    /// [`VulkanError::Call`] if the driver did not map the buffer, or it holds fewer values.
    pub fn read<T: bytemuck::AnyBitPattern>(&self, count: usize) -> Result<&[T], VulkanError> {
        self.bytes()
            .get(..count * size_of::<T>())
            .and_then(|bytes| bytemuck::try_cast_slice(bytes).ok())
            .ok_or(VulkanError::Call { call: "mapping a read-back", result: vk::Result::ERROR_MEMORY_MAP_FAILED })
    }

    /// Mapped bytes, to be written before the device reads them; empty in the same cases as [`Buffer::bytes`].
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
        // SAFETY: owners drop a buffer only after the frames that use it have run.
        unsafe { self.gpu.device.destroy_buffer(self.raw, None) };
    }
}

/// A buffer with a view of its texels.
pub struct TexelBuffer {
    /// The viewed buffer.
    pub buffer: Buffer,
    pub(crate) view: vk::BufferView,
}

impl TexelBuffer {
    /// The view, for a descriptor.
    pub(crate) fn texels(&self) -> Texels {
        Texels { view: self.view, buffer: self.buffer.raw }
    }
}

impl Drop for TexelBuffer {
    fn drop(&mut self) {
        // SAFETY: as for the buffer, which outlives its view here.
        unsafe { self.buffer.gpu.device.destroy_buffer_view(self.view, None) };
    }
}

/// View of the texels of a buffer with another owner.
pub(crate) struct TexelView {
    gpu: Arc<Gpu>,
    texels: Texels,
}

impl TexelView {
    /// The view, for a descriptor.
    pub fn texels(&self) -> Texels {
        self.texels
    }

    /// Makes a view of `buffer`.
    ///
    /// # Safety
    /// The buffer is alive, belongs to the device, was created for uniform texel access, and outlives the view.
    pub unsafe fn new(
        gpu: &Arc<Gpu>,
        buffer: vk::Buffer,
        format: vk::Format,
        offset: u64,
        bytes: u64,
    ) -> Result<Self, VulkanError> {
        let info = vk::BufferViewCreateInfo::default().buffer(buffer).format(format).offset(offset).range(bytes);
        // SAFETY: guaranteed by the caller.
        let view =
            unsafe { gpu.device.create_buffer_view(&info, None) }.map_err(VulkanError::of("vkCreateBufferView"))?;
        Ok(Self { gpu: gpu.clone(), texels: Texels { view, buffer } })
    }
}

impl Drop for TexelView {
    fn drop(&mut self) {
        // SAFETY: owners drop a view only after the frames that use it have run.
        unsafe { self.gpu.device.destroy_buffer_view(self.texels.view, None) };
    }
}

/// Description of an image of two dimensions that has one level, one layer and one sample.
pub(crate) fn flat_image(
    format: vk::Format,
    [width, height]: [u32; 2],
    usage: vk::ImageUsageFlags,
) -> vk::ImageCreateInfo<'static> {
    vk::ImageCreateInfo::default()
        .image_type(vk::ImageType::TYPE_2D)
        .format(format)
        .extent(vk::Extent3D { width, height, depth: 1 })
        .mip_levels(1)
        .array_layers(1)
        .samples(vk::SampleCountFlags::TYPE_1)
        .usage(usage)
}

/// An image, its view and its memory.
pub struct Image {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::Image,
    pub(crate) view: vk::ImageView,
    /// Memory of the image, freed after the handles are destroyed.
    _block: Option<Block>,
    /// Width and height of level 0.
    pub extent: vk::Extent2D,
    /// Number of mipmap levels.
    pub levels: u32,
    /// Number of layers; a cube has six.
    pub(super) layers: u32,
    aspect: vk::ImageAspectFlags,
}

impl Image {
    /// Handle of the image.
    #[must_use]
    pub fn handle(&self) -> vk::Image {
        self.raw
    }

    /// View of all levels and layers.
    #[must_use]
    pub fn view(&self) -> vk::ImageView {
        self.view
    }

    /// Subresource range of all levels and layers.
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
        // SAFETY: owners drop an image only after the frames that use it have run.
        unsafe {
            self.gpu.device.destroy_image_view(self.view, None);
            self.gpu.device.destroy_image(self.raw, None);
        }
    }
}

//! Images that the renderer writes and that are copied to the window's images.

use super::device::Device;
use super::worker::Pixels;
use anyhow::anyhow;
use ash::vk;
use gpc::render::{ImageState, Target};
use gpc::vulkan::VulkanError;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};
use std::sync::{Arc, PoisonError};

/// Subresource range of an image with one level and one layer.
pub const COLOR: vk::ImageSubresourceRange = vk::ImageSubresourceRange {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    base_mip_level: 0,
    level_count: 1,
    base_array_layer: 0,
    layer_count: 1,
};

/// Subresource layers for copies of an image with one level and one layer.
pub const LAYERS: vk::ImageSubresourceLayers = vk::ImageSubresourceLayers {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    mip_level: 0,
    base_array_layer: 0,
    layer_count: 1,
};

/// State of an image as the source of copies.
pub const SOURCE: ImageState = ImageState {
    layout: vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
    stage: vk::PipelineStageFlags2::ALL_TRANSFER,
    access: vk::AccessFlags2::TRANSFER_READ,
};

/// State of an image as the destination of copies.
pub const DESTINATION: ImageState = ImageState {
    layout: vk::ImageLayout::TRANSFER_DST_OPTIMAL,
    stage: vk::PipelineStageFlags2::ALL_TRANSFER,
    access: vk::AccessFlags2::TRANSFER_WRITE,
};

/// State of an image whose contents are discarded, although copies from it may still be running.
pub const UNUSED: ImageState = ImageState {
    layout: vk::ImageLayout::UNDEFINED,
    stage: vk::PipelineStageFlags2::ALL_TRANSFER,
    access: vk::AccessFlags2::NONE,
};

/// An image of sRGB codes with premultiplied alpha. Once written, it is in the state [`SOURCE`] between recordings.
pub struct Picture {
    device: Arc<Device>,
    image: vk::Image,
    memory: Option<Allocation>,
    size: [u32; 2],
    is_written: bool,
    /// Memory with the host's pixels, until they are copied.
    staging: Option<Staging>,
}

/// Memory that the host writes and the device copies from.
struct Staging {
    device: Arc<Device>,
    buffer: vk::Buffer,
    memory: Option<Allocation>,
}

impl Picture {
    /// Makes a picture of `size` = [width, height] in pixels.
    pub fn new(device: &Arc<Device>, size: [u32; 2]) -> anyhow::Result<Self> {
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(vk::Format::R8G8B8A8_UNORM)
            .extent(vk::Extent3D { width: size[0], height: size[1], depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC);
        // SAFETY: a plain creation on a live device.
        let image = unsafe { device.handle.create_image(&info, None) }.map_err(VulkanError::of("vkCreateImage"))?;
        let mut picture = Self { device: device.clone(), image, memory: None, size, is_written: false, staging: None };
        // SAFETY: the image was made from this device.
        let requirements = unsafe { device.handle.get_image_memory_requirements(image) };
        let memory = allocate(device, requirements, MemoryLocation::GpuOnly)?;
        // SAFETY: the memory belongs to the image alone, and is freed after it.
        unsafe {
            device
                .handle
                .bind_image_memory(image, memory.memory(), memory.offset())
                .map_err(VulkanError::of("vkBindImageMemory"))?;
        }
        picture.memory = Some(memory);
        Ok(picture)
    }

    /// Makes a picture of these codes, which it holds once [`Self::record_pixels`] has been executed.
    pub fn from_pixels(device: &Arc<Device>, pixels: &Pixels) -> anyhow::Result<Self> {
        let mut picture = Self::new(device, pixels.size)?;
        picture.staging = Some(Staging::new(device, pixels.codes.as_flattened())?);
        Ok(picture)
    }

    /// Records the copy of the host's pixels to the image, if they have not been copied.
    ///
    /// # Safety
    /// `commands` is being recorded for the device outside of a render pass; the picture outlives their execution.
    pub unsafe fn record_pixels(&mut self, commands: vk::CommandBuffer) {
        let Some(staging) = self.staging.as_ref().filter(|_| !self.is_written) else {
            return;
        };
        self.is_written = true;
        let copy = [vk::BufferImageCopy::default().image_subresource(LAYERS).image_extent(vk::Extent3D {
            width: self.size[0],
            height: self.size[1],
            depth: 1,
        })];
        // SAFETY: guaranteed by the caller; the buffer has a code for each pixel, and what the host wrote before the
        // submission is visible to it.
        unsafe {
            change(&self.device, commands, self.image, UNUSED, DESTINATION);
            self.device.handle.cmd_copy_buffer_to_image(
                commands,
                staging.buffer,
                self.image,
                DESTINATION.layout,
                &copy,
            );
            change(&self.device, commands, self.image, DESTINATION, SOURCE);
        }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The image.
    pub fn image(&self) -> vk::Image {
        self.image
    }

    /// Whether the image holds a picture.
    pub fn is_written(&self) -> bool {
        self.is_written
    }

    /// Target for a renderer that overwrites the whole picture.
    pub fn target(&mut self) -> Target {
        self.is_written = true;
        Target::Image { image: self.image, before: UNUSED, after: SOURCE }
    }

    /// Records a copy of all of another picture to this one, from the row `first_row` on.
    ///
    /// # Safety
    /// `commands` is being recorded for the device outside of a render pass; both pictures outlive their execution,
    /// and the rows lie in this picture.
    pub unsafe fn record_rows(&mut self, commands: vk::CommandBuffer, from: &Self, first_row: u32) {
        let before = if self.is_written { SOURCE } else { UNUSED };
        self.is_written = true;
        let copy = [vk::ImageCopy::default()
            .src_subresource(LAYERS)
            .dst_subresource(LAYERS)
            .dst_offset(vk::Offset3D { x: 0, y: first_row as i32, z: 0 })
            .extent(vk::Extent3D { width: from.size[0], height: from.size[1], depth: 1 })];
        // SAFETY: guaranteed by the caller.
        unsafe {
            change(&self.device, commands, self.image, before, DESTINATION);
            self.device.handle.cmd_copy_image(
                commands,
                from.image,
                SOURCE.layout,
                self.image,
                DESTINATION.layout,
                &copy,
            );
            change(&self.device, commands, self.image, DESTINATION, SOURCE);
        }
    }
}

impl Staging {
    fn new(device: &Arc<Device>, bytes: &[u8]) -> anyhow::Result<Self> {
        let info = vk::BufferCreateInfo::default().size(bytes.len() as u64).usage(vk::BufferUsageFlags::TRANSFER_SRC);
        // SAFETY: a plain creation on a live device.
        let buffer = unsafe { device.handle.create_buffer(&info, None) }.map_err(VulkanError::of("vkCreateBuffer"))?;
        let mut staging = Self { device: device.clone(), buffer, memory: None };
        // SAFETY: the buffer was made from this device.
        let requirements = unsafe { device.handle.get_buffer_memory_requirements(buffer) };
        let memory = allocate(device, requirements, MemoryLocation::CpuToGpu)?;
        let memory = staging.memory.insert(memory);
        // SAFETY: the memory belongs to the buffer alone, and is freed after it.
        unsafe {
            device
                .handle
                .bind_buffer_memory(buffer, memory.memory(), memory.offset())
                .map_err(VulkanError::of("vkBindBufferMemory"))?;
        }
        let mapped = memory.mapped_slice_mut();
        mapped
            .and_then(|mapped| mapped.get_mut(..bytes.len()))
            .ok_or_else(|| anyhow!("the memory of pixels is not mapped"))?
            .copy_from_slice(bytes);
        Ok(staging)
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        // SAFETY: commands that use the buffer have run; whoever recorded them kept it until then.
        unsafe { self.device.handle.destroy_buffer(self.buffer, None) };
        free(&self.device, self.memory.take());
    }
}

/// Allocates memory from the shared allocator.
fn allocate(
    device: &Device,
    requirements: vk::MemoryRequirements,
    location: MemoryLocation,
) -> anyhow::Result<Allocation> {
    let allocation = device
        .allocator()?
        .lock()
        .map_err(|_| anyhow!("the allocator's lock is poisoned"))?
        .allocate(&AllocationCreateDesc {
            name: "picture",
            requirements,
            location,
            linear: location == MemoryLocation::CpuToGpu,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        })
        .map_err(|_| VulkanError::OutOfMemory { what: "a picture".to_owned(), bytes: requirements.size })?;
    Ok(allocation)
}

fn free(device: &Device, memory: Option<Allocation>) {
    if let (Some(memory), Ok(allocator)) = (memory, device.allocator()) {
        let mut allocator = allocator.lock().unwrap_or_else(PoisonError::into_inner);
        // Freeing fails only for memory of another allocator.
        let _ = allocator.free(memory);
    }
}

/// Records the transition of an image from one state to another.
///
/// # Safety
/// `commands` is being recorded for the device outside of a render pass; the image outlives their execution and is in
/// the first state, unless that is undefined.
pub unsafe fn change(device: &Device, commands: vk::CommandBuffer, image: vk::Image, from: ImageState, to: ImageState) {
    let barriers = [vk::ImageMemoryBarrier2::default()
        .src_stage_mask(from.stage)
        .src_access_mask(from.access)
        .dst_stage_mask(to.stage)
        .dst_access_mask(to.access)
        .old_layout(from.layout)
        .new_layout(to.layout)
        .image(image)
        .subresource_range(COLOR)];
    let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
    // SAFETY: guaranteed by the caller.
    unsafe { device.handle.cmd_pipeline_barrier2(commands, &info) };
}

impl Drop for Picture {
    fn drop(&mut self) {
        // SAFETY: commands that use the image have run; whoever recorded them kept it until then.
        unsafe { self.device.handle.destroy_image(self.image, None) };
        free(&self.device, self.memory.take());
    }
}

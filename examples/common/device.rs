//! The Vulkan objects of any host: a device, memory that frees itself, and pictures.

use crate::Failure;
use ash::vk;
use gpc::vulkan::{Host, MemorySource, Requirements, SharedAllocator};
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc};
use std::ffi::CStr;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// A device with one queue.
pub struct Device {
    pub raw: ash::Device,
    pub queue: vk::Queue,
    pub pool: vk::CommandPool,
    pub instance: ash::Instance,
    pub physical: vk::PhysicalDevice,
    pub family: u32,
    /// Functions of conditional rendering, if the device supports it.
    pub conditional_rendering: Option<ash::ext::conditional_rendering::Device>,
    /// Allocator, shared with the library; `None` only in `Drop`, which frees its blocks before the device.
    allocator: Option<SharedAllocator>,
    /// Vulkan loader, whose library stays open until the end.
    #[allow(dead_code, reason = "only a window's surface reads it")]
    pub entry: ash::Entry,
}

impl Device {
    pub fn new() -> Result<Self, Failure> {
        Self::with_extensions(&[], &[])
    }

    /// A device, with extensions of the instance and its own.
    pub fn with_extensions(of_instance: &[&CStr], own: &[&CStr]) -> Result<Self, Failure> {
        let of_instance: Vec<_> = of_instance.iter().map(|name| name.as_ptr()).collect();
        let mut extensions: Vec<_> = own.iter().map(|name| name.as_ptr()).collect();
        // SAFETY: plain creations whose structures live until after the call. Handles that were made before a failure
        // leak, but the program ends then.
        unsafe {
            let entry = ash::Entry::load()?;
            let application = vk::ApplicationInfo::default().api_version(Requirements::API_VERSION);
            let info =
                vk::InstanceCreateInfo::default().application_info(&application).enabled_extension_names(&of_instance);
            let instance = entry.create_instance(&info, None)?;
            let (physical, family) = instance
                .enumerate_physical_devices()?
                .into_iter()
                .filter(|device| Requirements::missing(&instance, *device).is_empty())
                .find_map(|device| Some((device, Requirements::queue_family(&instance, device)?)))
                .ok_or("no suitable device")?;
            let mut features13 = Requirements::features13();
            // Conditional rendering skips rounds of superpixels that are not needed.
            let conditional_rendering = Requirements::has_conditional_rendering(&instance, physical);
            let mut conditional =
                vk::PhysicalDeviceConditionalRenderingFeaturesEXT::default().conditional_rendering(true);
            if conditional_rendering {
                extensions.push(ash::ext::conditional_rendering::NAME.as_ptr());
            }
            // A host's fragment shader needs the first feature for gl_PrimitiveID; the others are for draws from buffers.
            let features = vk::PhysicalDeviceFeatures::default()
                .geometry_shader(true)
                .multi_draw_indirect(true)
                .draw_indirect_first_instance(true);
            let priorities = [1.0];
            let queues =
                [vk::DeviceQueueCreateInfo::default().queue_family_index(family).queue_priorities(&priorities)];
            let mut info = vk::DeviceCreateInfo::default()
                .queue_create_infos(&queues)
                .enabled_features(&features)
                .enabled_extension_names(&extensions)
                .push_next(&mut features13);
            if conditional_rendering {
                info = info.push_next(&mut conditional);
            }
            let raw = instance.create_device(physical, &info, None)?;
            let info = vk::CommandPoolCreateInfo::default()
                .queue_family_index(family)
                .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
            let allocator = Allocator::new(&AllocatorCreateDesc {
                instance: instance.clone(),
                device: raw.clone(),
                physical_device: physical,
                debug_settings: gpu_allocator::AllocatorDebugSettings::default(),
                buffer_device_address: false,
                allocation_sizes: gpu_allocator::AllocationSizes::default(),
            })?;
            let functions = ash::ext::conditional_rendering::Device::new(&instance, &raw);
            Ok(Self {
                queue: raw.get_device_queue(family, 0),
                pool: raw.create_command_pool(&info, None)?,
                allocator: Some(Arc::new(Mutex::new(allocator))),
                raw,
                instance,
                physical,
                family,
                conditional_rendering: conditional_rendering.then_some(functions),
                entry,
            })
        }
    }

    /// Handles that the library is lent.
    pub fn lent(&self) -> Host {
        let mut host = Host::new(self.instance.clone(), self.physical, self.raw.clone(), self.family);
        host.memory = self.allocator.clone().map_or(MemorySource::Own, MemorySource::Shared);
        host.conditional_rendering = self.conditional_rendering.is_some();
        host
    }

    fn allocate(
        &self,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
        linear: bool,
    ) -> Result<Allocation, Failure> {
        let allocator = self.allocator.as_ref().ok_or("no allocator")?;
        let mut allocator = allocator.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(allocator.allocate(&AllocationCreateDesc {
            name: "host",
            requirements,
            location,
            linear,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        })?)
    }

    fn free(&self, allocation: Option<Allocation>) {
        if let (Some(allocator), Some(allocation)) = (&self.allocator, allocation) {
            let mut allocator = allocator.lock().unwrap_or_else(PoisonError::into_inner);
            // Freeing fails only for an allocation of another allocator.
            let _ = allocator.free(allocation);
        }
    }

    /// A buffer that the host can write and read.
    pub fn buffer(&self, bytes: u64, usage: vk::BufferUsageFlags) -> Result<Buffer<'_>, Failure> {
        let info = vk::BufferCreateInfo::default().size(bytes).usage(usage);
        // SAFETY: plain creations on a live device; the memory is unused and bound once.
        unsafe {
            let raw = self.raw.create_buffer(&info, None)?;
            let needs = self.raw.get_buffer_memory_requirements(raw);
            let memory = self.allocate(needs, MemoryLocation::CpuToGpu, true)?;
            self.raw.bind_buffer_memory(raw, memory.memory(), memory.offset())?;
            Ok(Buffer { device: self, raw, bytes, memory: Some(memory) })
        }
    }

    /// A buffer that holds these values.
    pub fn filled<T: bytemuck::NoUninit>(&self, values: &[T]) -> Result<Buffer<'_>, Failure> {
        let bytes: &[u8] = bytemuck::cast_slice(values);
        let mut buffer = self.buffer(bytes.len() as u64, vk::BufferUsageFlags::STORAGE_BUFFER)?;
        buffer.bytes_mut()?[..bytes.len()].copy_from_slice(bytes);
        Ok(buffer)
    }

    /// An image with one view of all its levels.
    pub fn image(
        &self,
        format: vk::Format,
        [width, height]: [u32; 2],
        levels: u32,
        usage: vk::ImageUsageFlags,
        aspect: vk::ImageAspectFlags,
    ) -> Result<Texture<'_>, Failure> {
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(levels)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(usage);
        // SAFETY: as for buffers.
        unsafe {
            let raw = self.raw.create_image(&info, None)?;
            let needs = self.raw.get_image_memory_requirements(raw);
            let memory = self.allocate(needs, MemoryLocation::GpuOnly, false)?;
            self.raw.bind_image_memory(raw, memory.memory(), memory.offset())?;
            let info = vk::ImageViewCreateInfo::default()
                .image(raw)
                .view_type(vk::ImageViewType::TYPE_2D)
                .format(format)
                .subresource_range(vk::ImageSubresourceRange {
                    aspect_mask: aspect,
                    base_mip_level: 0,
                    level_count: levels,
                    base_array_layer: 0,
                    layer_count: 1,
                });
            Ok(Texture {
                device: self,
                raw,
                view: self.raw.create_image_view(&info, None)?,
                aspect,
                memory: Some(memory),
            })
        }
    }

    /// Records, submits and waits.
    pub fn run(&self, record: impl FnOnce(vk::CommandBuffer) -> Result<(), Failure>) -> Result<(), Failure> {
        // SAFETY: plain use of handles that live as long as `self`; the queue is used by this thread alone.
        unsafe {
            let info = vk::CommandBufferAllocateInfo::default().command_pool(self.pool).command_buffer_count(1);
            let buffers = self.raw.allocate_command_buffers(&info)?;
            self.raw.begin_command_buffer(buffers[0], &vk::CommandBufferBeginInfo::default())?;
            record(buffers[0])?;
            self.raw.end_command_buffer(buffers[0])?;
            let submitted = [vk::SubmitInfo::default().command_buffers(&buffers)];
            self.raw.queue_submit(self.queue, &submitted, vk::Fence::null())?;
            self.raw.queue_wait_idle(self.queue)?;
            self.raw.free_command_buffers(self.pool, &buffers);
        }
        Ok(())
    }

    /// Records a barrier that makes copies visible to the host.
    ///
    /// # Safety
    /// The command buffer is being recorded for the device, outside of a render pass.
    pub unsafe fn show_to_host(&self, commands: vk::CommandBuffer) {
        let barriers = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::COPY)
            .src_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::HOST)
            .dst_access_mask(vk::AccessFlags2::HOST_READ)];
        let info = vk::DependencyInfo::default().memory_barriers(&barriers);
        // SAFETY: guaranteed by the caller.
        unsafe { self.raw.cmd_pipeline_barrier2(commands, &info) };
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        self.allocator = None;
        // SAFETY: every submission was waited for, and everything made from the device is gone.
        unsafe {
            self.raw.destroy_command_pool(self.pool, None);
            self.raw.destroy_device(None);
            self.instance.destroy_instance(None);
        }
    }
}

/// A mapped buffer, freed when it is dropped.
pub struct Buffer<'a> {
    device: &'a Device,
    pub raw: vk::Buffer,
    pub bytes: u64,
    memory: Option<Allocation>,
}

impl Buffer<'_> {
    pub fn bytes_mut(&mut self) -> Result<&mut [u8], Failure> {
        let memory = self.memory.as_mut().and_then(Allocation::mapped_slice_mut);
        Ok(memory.ok_or("a buffer is not mapped")?)
    }

    pub fn read(&self) -> Result<&[u8], Failure> {
        let memory = self.memory.as_ref().and_then(Allocation::mapped_slice);
        Ok(memory.ok_or("a buffer is not mapped")?)
    }

    /// Contents as colours of four floats each.
    pub fn colors(&self) -> Result<&[[f32; 4]], Failure> {
        let bytes = &self.read()?[..self.bytes as usize];
        Ok(bytemuck::try_cast_slice(bytes).map_err(|error| error.to_string())?)
    }
}

impl Drop for Buffer<'_> {
    fn drop(&mut self) {
        // SAFETY: the commands that used the buffer were waited for.
        unsafe { self.device.raw.destroy_buffer(self.raw, None) };
        self.device.free(self.memory.take());
    }
}

/// An image and its view, freed when they are dropped.
pub struct Texture<'a> {
    device: &'a Device,
    pub raw: vk::Image,
    pub view: vk::ImageView,
    pub aspect: vk::ImageAspectFlags,
    memory: Option<Allocation>,
}

impl Drop for Texture<'_> {
    fn drop(&mut self) {
        // SAFETY: the commands that used the image were waited for.
        unsafe {
            self.device.raw.destroy_image_view(self.view, None);
            self.device.raw.destroy_image(self.raw, None);
        }
        self.device.free(self.memory.take());
    }
}

/// A picture in linear light.
pub struct Image {
    pub size: [u32; 2],
    pub colors: Vec<[f32; 3]>,
}

impl Image {
    /// A picture of this size, whose pixels are the means of `side` x `side` colours.
    pub fn means(colors: &[[f32; 4]], size: [u32; 2], side: u32) -> Self {
        let [width, height] = size.map(|pixels| pixels as usize);
        let side = side as usize;
        let mean = |x: usize, y: usize| {
            let mut sum = [0.0; 3];
            for line in 0..side {
                let first = ((y * side + line) * width + x) * side;
                for color in &colors[first..first + side] {
                    for (sum, channel) in sum.iter_mut().zip(color) {
                        *sum += channel;
                    }
                }
            }
            sum.map(|sum| sum / (side * side) as f32)
        };
        Self { size, colors: (0..width * height).map(|i| mean(i % width, i / width)).collect() }
    }

    fn codes(&self) -> impl Iterator<Item = f64> {
        self.colors.iter().flatten().map(|&linear| {
            let linear = f64::from(linear).clamp(0.0, 1.0);
            if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
        })
    }

    /// Root mean squared difference of sRGB-encoded values of 0 to 1.
    pub fn error(&self, truth: &Self) -> f64 {
        let pairs = self.codes().zip(truth.codes());
        let sum: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
        (sum / (3 * self.colors.len()) as f64).sqrt()
    }

    pub fn save(&self, path: &Path) -> Result<(), Failure> {
        let bytes: Vec<u8> = self.codes().map(|code| (255.0 * code).round() as u8).collect();
        let [width, height] = self.size;
        let file = std::io::BufWriter::new(std::fs::File::create(path)?);
        let mut encoder = png::Encoder::new(file, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.write_header()?.write_image_data(&bytes)?;
        Ok(())
    }
}

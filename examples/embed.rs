//! A host that renders into an image of its own, from a command buffer of its own.
//!
//! ```text
//! cargo run --release --example embed [SCENE [OUT.png]]
//! ```
//!
//! The host owns instance, device, queue, allocator, image and command buffer, as an engine or a viewer does, and
//! lends them to the renderer. The renderer states beforehand what it needs. It never submits or waits, and it does
//! not allocate while it records.

#[path = "common/arguments.rs"]
mod arguments;

use anyhow::{Context, anyhow, bail};
use ash::vk;
use gpc::camera::{Camera, Orbit};
use gpc::render::{Encoding, ImageState, Renderer, SceneRequest, Settings, Shadows, Target};
use gpc::scene::{PoseRequest, Scene};
use gpc::vulkan::{Host, MemorySource, Requirements, SharedAllocator};
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

const WIDTH: u32 = 640;
const HEIGHT: u32 = 360;

fn main() -> anyhow::Result<()> {
    let [scene, out] = arguments::paths("embed [SCENE [OUT.png]]");
    let scene = scene.unwrap_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/spheres.glb")));
    let out = out.unwrap_or_else(|| "embed.png".into());

    let app = App::new()?;
    let pixels = app.render(&Scene::load(&scene)?.scene)?;
    image::save_buffer(&out, &pixels, WIDTH, HEIGHT, image::ColorType::Rgba8)?;
    println!("{}", out.display());
    Ok(())
}

/// The Vulkan objects that any host has.
struct App {
    instance: ash::Instance,
    physical_device: vk::PhysicalDevice,
    device: ash::Device,
    queue_family: u32,
    conditional_rendering: bool,
    queue: vk::Queue,
    pool: vk::CommandPool,
    /// Allocator, shared with the renderer; `None` only in `Drop`, which frees its blocks before the device.
    allocator: Option<SharedAllocator>,
    /// Vulkan loader, whose library stays open until the end.
    _entry: ash::Entry,
}

impl App {
    /// Creates a device with the features that the renderer needs; a host would add its own.
    fn new() -> anyhow::Result<Self> {
        // SAFETY: plain creations whose structures live until after the call. Handles that were made before a failure
        // leak, but the program ends then.
        unsafe {
            let entry = ash::Entry::load().context("no Vulkan loader")?;
            let application = vk::ApplicationInfo::default().api_version(Requirements::API_VERSION);
            let info = vk::InstanceCreateInfo::default().application_info(&application);
            let instance = entry.create_instance(&info, None)?;

            // The list of everything that a device lacks is known before the device is created.
            let mut lacking = Vec::new();
            let mut chosen = None;
            for physical_device in instance.enumerate_physical_devices()? {
                let missing = Requirements::missing(&instance, physical_device);
                let queue_family = Requirements::queue_family(&instance, physical_device);
                match queue_family.filter(|_| missing.is_empty()) {
                    Some(queue_family) => {
                        chosen = chosen.or(Some((physical_device, queue_family)));
                    }
                    None => lacking.extend(missing.iter().map(ToString::to_string)),
                }
            }
            let Some((physical_device, queue_family)) = chosen else {
                bail!("no suitable device; missing: {}", lacking.join(", "));
            };

            let mut features = Requirements::features13();
            // Conditional rendering skips rounds of superpixels that are not needed.
            let conditional_rendering = Requirements::has_conditional_rendering(&instance, physical_device);
            let mut conditional =
                vk::PhysicalDeviceConditionalRenderingFeaturesEXT::default().conditional_rendering(true);
            let extensions = [ash::ext::conditional_rendering::NAME.as_ptr()];
            let priorities = [1.0];
            let queues =
                [vk::DeviceQueueCreateInfo::default().queue_family_index(queue_family).queue_priorities(&priorities)];
            let mut info = vk::DeviceCreateInfo::default().queue_create_infos(&queues).push_next(&mut features);
            if conditional_rendering {
                info = info.enabled_extension_names(&extensions).push_next(&mut conditional);
            }
            let device = instance.create_device(physical_device, &info, None)?;
            let info = vk::CommandPoolCreateInfo::default().queue_family_index(queue_family);
            let allocator = Allocator::new(&AllocatorCreateDesc {
                instance: instance.clone(),
                device: device.clone(),
                physical_device,
                debug_settings: gpu_allocator::AllocatorDebugSettings::default(),
                buffer_device_address: false,
                allocation_sizes: gpu_allocator::AllocationSizes::default(),
            })?;
            Ok(Self {
                queue: device.get_device_queue(queue_family, 0),
                pool: device.create_command_pool(&info, None)?,
                allocator: Some(Arc::new(Mutex::new(allocator))),
                instance,
                physical_device,
                device,
                queue_family,
                conditional_rendering,
                _entry: entry,
            })
        }
    }

    /// Renders a scene to rows of sRGB-encoded RGBA bytes.
    fn render(&self, scene: &Scene) -> anyhow::Result<Vec<u8>> {
        let mut host = Host::new(self.instance.clone(), self.physical_device, self.device.clone(), self.queue_family);
        host.memory = self.allocator.clone().map_or(MemorySource::Own, MemorySource::Shared);
        host.conditional_rendering = self.conditional_rendering;
        // SAFETY: the handles belong together, the features are enabled, and `self` outlives the renderer.
        let renderer = unsafe { Renderer::new(host) }?;

        // Everything that can fail happens here: memory, pipelines, limits.
        let pose = scene.pose(&PoseRequest::default())?;
        let settings = Settings::new(WIDTH, HEIGHT).background(Some([0.2, 0.3, 0.5])).shadows(Shadows::Exact);
        let (low, high) = pose.geometry.bounds().context("the scene has no triangles")?;
        let camera = match pose.cameras.first() {
            Some(camera) => Camera::from_scene(camera),
            None => Orbit::default().frame(low, high, f64::from(WIDTH) / f64::from(HEIGHT))?,
        };
        let request =
            SceneRequest::new(scene, &pose).shadowed(settings.scene.shadows).within(settings.scene.max_memory);
        let prepared = renderer.prepare_scene(request)?;
        let mut frame = renderer.prepare(&prepared, &settings, Some(Encoding::Rgba8))?;
        let target = OwnImage::new(self)?;

        self.submit(|commands| {
            // SAFETY: the commands are waited for below, before anything that they use is dropped, and the image has
            // the properties that the target states.
            unsafe {
                prepared.record_upload(commands);
                frame.record(
                    &camera,
                    commands,
                    &Target::Image {
                        image: target.image,
                        before: ImageState {
                            layout: vk::ImageLayout::UNDEFINED,
                            stage: vk::PipelineStageFlags2::NONE,
                            access: vk::AccessFlags2::NONE,
                        },
                        // The state for the host's next use: here a copy; a viewer would sample or present the image.
                        after: ImageState {
                            layout: vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
                            stage: vk::PipelineStageFlags2::COPY,
                            access: vk::AccessFlags2::TRANSFER_READ,
                        },
                    },
                );
                target.record_read_back(self, commands);
            }
        })?;

        // The commands have run: statistics can be read, and `frame` may be recorded again.
        let statistics = frame.statistics()?;
        println!("{} superpixels, {:.1} ms on the GPU", statistics.superpixels, statistics.gpu_ms());
        target.into_pixels()
    }

    /// Records, submits and waits. A host with a frame loop would have a prepared `Frame` for each frame in flight.
    fn submit(&self, record: impl FnOnce(vk::CommandBuffer)) -> anyhow::Result<()> {
        // SAFETY: plain use of handles that live as long as `self`; the queue is used by this thread alone.
        unsafe {
            let info = vk::CommandBufferAllocateInfo::default().command_pool(self.pool).command_buffer_count(1);
            let buffers = self.device.allocate_command_buffers(&info)?;
            let commands = *buffers.first().context("no command buffer")?;
            let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
            self.device.begin_command_buffer(commands, &begin)?;
            record(commands);
            self.device.end_command_buffer(commands)?;
            let submitted = [vk::SubmitInfo::default().command_buffers(&buffers)];
            self.device.queue_submit(self.queue, &submitted, vk::Fence::null())?;
            self.device.queue_wait_idle(self.queue)?;
            self.device.free_command_buffers(self.pool, &buffers);
        }
        Ok(())
    }
}

impl Drop for App {
    fn drop(&mut self) {
        self.allocator = None;
        // SAFETY: every submission was waited for, and everything made from the device is gone.
        unsafe {
            self.device.destroy_command_pool(self.pool, None);
            self.device.destroy_device(None);
            self.instance.destroy_instance(None);
        }
    }
}

/// The host's image, and a buffer for reading it back.
struct OwnImage<'a> {
    app: &'a App,
    image: vk::Image,
    buffer: vk::Buffer,
    memory: Vec<Allocation>,
}

impl<'a> OwnImage<'a> {
    fn new(app: &'a App) -> anyhow::Result<Self> {
        // SAFETY: plain creations on a live device; each handle is bound once to memory of its own.
        unsafe {
            let info = vk::ImageCreateInfo::default()
                .image_type(vk::ImageType::TYPE_2D)
                .format(vk::Format::R8G8B8A8_UNORM)
                .extent(vk::Extent3D { width: WIDTH, height: HEIGHT, depth: 1 })
                .mip_levels(1)
                .array_layers(1)
                .samples(vk::SampleCountFlags::TYPE_1)
                .tiling(vk::ImageTiling::OPTIMAL)
                // The renderer copies to the image, and needs no usage but TRANSFER_DST.
                .usage(vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC);
            let image = app.device.create_image(&info, None)?;
            let info = vk::BufferCreateInfo::default()
                .size(u64::from(WIDTH * HEIGHT * 4))
                .usage(vk::BufferUsageFlags::TRANSFER_DST);
            let buffer = app.device.create_buffer(&info, None)?;
            let mut own = Self { app, image, buffer, memory: Vec::new() };
            let needs = app.device.get_image_memory_requirements(image);
            let (memory, offset) = own.allocate(needs, MemoryLocation::GpuOnly)?;
            app.device.bind_image_memory(image, memory, offset)?;
            let needs = app.device.get_buffer_memory_requirements(buffer);
            let (memory, offset) = own.allocate(needs, MemoryLocation::GpuToCpu)?;
            app.device.bind_buffer_memory(buffer, memory, offset)?;
            Ok(own)
        }
    }

    fn allocate(
        &mut self,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
    ) -> anyhow::Result<(vk::DeviceMemory, u64)> {
        let shared = self.app.allocator.as_ref().context("no allocator")?;
        let allocation = shared.lock().map_err(|_| anyhow!("the allocator's lock is poisoned"))?.allocate(
            &AllocationCreateDesc {
                name: "host",
                requirements,
                location,
                linear: location == MemoryLocation::GpuToCpu,
                allocation_scheme: AllocationScheme::GpuAllocatorManaged,
            },
        )?;
        // SAFETY: the memory is bound and freed through this allocation alone.
        let placed = (unsafe { allocation.memory() }, allocation.offset());
        self.memory.push(allocation);
        Ok(placed)
    }

    /// Copies the image, which is in `TRANSFER_SRC_OPTIMAL`, into the buffer.
    ///
    /// # Safety
    /// `commands` is being recorded for the app's device.
    unsafe fn record_read_back(&self, app: &App, commands: vk::CommandBuffer) {
        let region = vk::BufferImageCopy::default()
            .image_subresource(vk::ImageSubresourceLayers {
                aspect_mask: vk::ImageAspectFlags::COLOR,
                mip_level: 0,
                base_array_layer: 0,
                layer_count: 1,
            })
            .image_extent(vk::Extent3D { width: WIDTH, height: HEIGHT, depth: 1 });
        let barriers = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::COPY)
            .src_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::HOST)
            .dst_access_mask(vk::AccessFlags2::HOST_READ)];
        let to_host = vk::DependencyInfo::default().memory_barriers(&barriers);
        // SAFETY: guaranteed by the caller; image and buffer have the same size.
        unsafe {
            app.device.cmd_copy_image_to_buffer(
                commands,
                self.image,
                vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
                self.buffer,
                &[region],
            );
            app.device.cmd_pipeline_barrier2(commands, &to_host);
        }
    }

    /// Bytes of the image, once the commands have run.
    fn into_pixels(self) -> anyhow::Result<Vec<u8>> {
        self.memory
            .last()
            .and_then(Allocation::mapped_slice)
            .and_then(|bytes| bytes.get(..(WIDTH * HEIGHT * 4) as usize))
            .map(<[u8]>::to_vec)
            .context("the read-back memory is not mapped")
    }
}

impl Drop for OwnImage<'_> {
    fn drop(&mut self) {
        // SAFETY: the commands that used the handles were waited for.
        unsafe {
            self.app.device.destroy_image(self.image, None);
            self.app.device.destroy_buffer(self.buffer, None);
        }
        if let Some(shared) = &self.app.allocator {
            let mut allocator = shared.lock().unwrap_or_else(PoisonError::into_inner);
            for allocation in self.memory.drain(..) {
                // Freeing fails only for an allocation of another allocator.
                let _ = allocator.free(allocation);
            }
        }
    }
}

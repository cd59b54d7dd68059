//! Renderer that submits its commands and waits for them, for images without a window.

use super::renderer::{PreparedScene, Renderer, SceneRequest};
use super::{EngineError, Method, Pixel, RenderError, SceneFrame, Settings, Shadows, Statistics, Target};
use crate::camera::Camera;
use crate::render::data::GpuScene;
use crate::vulkan::{Buffer, Gpu, Instance, InstanceOptions, Limits, Memory, MemoryUse, SharedQueue, VulkanError};
use ash::vk;
use std::sync::{Arc, Mutex, PoisonError};

/// Options for opening a device.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct HeadlessOptions {
    /// Part of the device's name; `None`, the default, for the best device.
    pub device: Option<String>,
    /// Whether to run under the validation layer; by default not.
    pub validation: bool,
}

impl HeadlessOptions {
    /// Sets the part of the device's name; `None` chooses the best device.
    #[must_use]
    pub fn device(mut self, name: Option<String>) -> Self {
        self.device = name;
        self
    }

    /// Sets whether to run under the validation layer.
    #[must_use]
    pub fn validation(mut self, validation: bool) -> Self {
        self.validation = validation;
        self
    }
}

/// A rendered image and its statistics.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendered<P = [f32; 4]> {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Colours, rows from the top: usually in linear light with premultiplied alpha; see [`Pixel`].
    pub colors: Vec<P>,
    /// Attributes of each pixel, rows from the top; empty unless the settings ask for them.
    pub attributes: Vec<PixelAttributes>,
    /// Statistics of the frame.
    pub statistics: Statistics,
}

/// Renderer that submits its commands and waits for them: in a device that it opens ([`Self::new`]), or in the device of
/// a host ([`Self::with_queue`]).
pub struct Headless {
    pub(super) renderer: Renderer,
    gpu: Arc<Gpu>,
    queue: SharedQueue,
    pool: vk::CommandPool,
    commands: vk::CommandBuffer,
    fence: vk::Fence,
    /// Whether commands were submitted and are not known to have run.
    is_pending: bool,
    output: Option<ReadBack>,
    is_unwanted: Option<Box<dyn Fn() -> bool + Send + Sync>>,
}

/// Memory from which the host reads a frame's colours and attributes.
struct ReadBack {
    colors: Buffer,
    attributes: Option<Buffer>,
    memory: Memory,
}

fn pixel_count(settings: &Settings) -> u64 {
    settings.output_size().map(u64::from).into_iter().product()
}

impl ReadBack {
    const ATTRIBUTE_BYTES: u64 = size_of::<PixelAttributes>() as u64;

    /// Bytes of the memory for an image of pixels of a type.
    fn bytes<P>(settings: &Settings) -> u64 {
        let attributes = if settings.attributes { Self::ATTRIBUTE_BYTES } else { 0 };
        pixel_count(settings) * (size_of::<P>() as u64 + attributes)
    }

    /// Memory for a frame's image of pixels of a type: `known` if it is large enough, otherwise new.
    fn for_frame<P>(gpu: &Arc<Gpu>, frame: &SceneFrame, known: Option<Self>) -> Result<Self, RenderError> {
        let settings = frame.settings();
        let pixels = pixel_count(settings);
        let needs =
            [pixels * size_of::<P>() as u64, if settings.attributes { pixels * Self::ATTRIBUTE_BYTES } else { 0 }];
        let has_room = |known: &Self| {
            let attributes = known.attributes.as_ref().map_or(0, Buffer::size);
            let bounded = settings.scene.max_memory.is_some();
            known.colors.size() >= needs[0]
                && attributes >= needs[1]
                && !(bounded && known.colors.size() + attributes > Self::bytes::<P>(settings).max(32))
        };
        if let Some(known) = known.filter(has_room) {
            return Ok(known);
        }
        let memory = Memory::new(gpu.clone(), None);
        let make = |name, bytes| memory.buffer(name, bytes, vk::BufferUsageFlags::TRANSFER_DST, MemoryUse::Readback);
        Ok(Self {
            colors: make("colour read-back", needs[0])?,
            attributes: (needs[1] > 0).then(|| make("attribute read-back", needs[1])).transpose()?,
            memory,
        })
    }
}

/// Attributes of a pixel besides its colour. Depth, ID and normal are those at the pixel's centre. The layout is that
/// of `shaders/attributes.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PixelAttributes {
    /// Distance from the eye along the view direction, in world units; 0 for background.
    pub depth: f32,
    /// ID of the nearest opaque or MASK triangle: its index plus 1; 0 for background.
    pub id: u32,
    /// Number of samples of which the pixel's colour is the mean.
    pub samples: u32,
    /// 1 for superpixels, otherwise 0.
    pub superpixel: u32,
    /// Unit normal in world space; 0 for background.
    pub normal: [f32; 3],
    /// Unused, 0.
    pub padding: u32,
}

impl Headless {
    /// Opens a device and makes a renderer on it.
    ///
    /// # Errors
    /// [`VulkanError`] if there is no suitable device; the message lists what each lacks.
    pub fn new(options: &HeadlessOptions) -> Result<Self, VulkanError> {
        // SAFETY: `lower` changes nothing.
        unsafe { Self::within(options, |_| ()) }
    }

    /// Opens a device as [`Headless::new`] does, with limits that `lower` reduces, so that tests can simulate weaker
    /// devices.
    ///
    /// # Errors
    /// As [`Headless::new`].
    ///
    /// # Safety
    /// `lower` raises no limit and adds no feature.
    #[doc(hidden)]
    pub unsafe fn within(options: &HeadlessOptions, lower: impl FnOnce(&mut Limits)) -> Result<Self, VulkanError> {
        let instance = Instance::new(InstanceOptions { validation: options.validation })?;
        // SAFETY: guaranteed by the caller.
        let gpu = unsafe { instance.create_gpu_within(options.device.as_deref(), lower) }?;
        // SAFETY: the device was created with one queue of this family.
        let queue = unsafe { gpu.device.get_device_queue(gpu.queue_family, 0) };
        // SAFETY: the queue belongs to the renderer's device, and nobody else has it.
        unsafe { Self::with_queue(Renderer::in_gpu(gpu)?, Arc::new(Mutex::new(queue))) }
    }

    /// Renders in the device of a renderer, which may be a host's. Scenes that the renderer has prepared can be shown once
    /// they are uploaded, and scenes that [`Self::upload`] has uploaded can be shown by the renderer's frames.
    ///
    /// The queue is locked while commands are handed to the driver, not while the device executes them. So the host can
    /// submit in between from another thread, and waits at most for the commands of one submission. [`Self::stop_when`]
    /// says how long these are.
    ///
    /// # Errors
    /// [`VulkanError::Call`] if the driver refuses a command pool or a fence.
    ///
    /// # Safety
    /// - The queue belongs to the renderer's device and queue family.
    /// - Nobody uses the queue without holding its lock.
    /// - A host's device satisfies what [`Renderer::new`] requires as long as this object and everything that it
    ///   prepares exist.
    pub unsafe fn with_queue(renderer: Renderer, queue: SharedQueue) -> Result<Self, VulkanError> {
        let gpu = renderer.gpu().clone();
        let mut headless = Self {
            renderer,
            gpu: gpu.clone(),
            queue,
            pool: vk::CommandPool::null(),
            commands: vk::CommandBuffer::null(),
            fence: vk::Fence::null(),
            is_pending: false,
            output: None,
            is_unwanted: None,
        };
        // SAFETY: plain creations on a live device; `Drop` destroys handles that were made before a failure.
        unsafe {
            let info = vk::CommandPoolCreateInfo::default()
                .queue_family_index(gpu.queue_family)
                .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
            headless.pool =
                gpu.device.create_command_pool(&info, None).map_err(VulkanError::of("vkCreateCommandPool"))?;
            let info = vk::CommandBufferAllocateInfo::default().command_pool(headless.pool).command_buffer_count(1);
            let buffers =
                gpu.device.allocate_command_buffers(&info).map_err(VulkanError::of("vkAllocateCommandBuffers"))?;
            headless.commands = buffers.first().copied().unwrap_or_default();
            headless.fence = gpu
                .device
                .create_fence(&vk::FenceCreateInfo::default(), None)
                .map_err(VulkanError::of("vkCreateFence"))?;
        }
        Ok(headless)
    }

    /// Device of the renderer.
    #[must_use]
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Sets a function that is asked before each submission whether the result is no longer wanted. If the function
    /// returns true, the call ends with [`RenderError::Stopped`]. The function may change its answer at any time, from
    /// another thread.
    ///
    /// Once the function is set, superpixels at locations are sampled in shorter runs, of at most 2^20 samples a submission.
    /// Other submissions sample up to 2^18 locations once each, search up to 2^20 cells of an image for superpixels,
    /// upload a scene, or render a frame. Settings with a region make frames short.
    pub fn stop_when(&mut self, is_unwanted: impl Fn() -> bool + Send + Sync + 'static) {
        self.is_unwanted = Some(Box::new(is_unwanted));
    }

    /// Whether a function of [`Self::stop_when`] is set.
    pub(super) fn may_stop(&self) -> bool {
        self.is_unwanted.is_some()
    }

    /// Messages of the validation layer so far; empty without it, and in a host's device.
    #[must_use]
    pub fn validation_messages(&self) -> Vec<String> {
        self.gpu.instance().map(|instance| instance.validation_messages()).unwrap_or_default()
    }

    /// Uploads a scene, prepared as by [`Renderer::prepare_scene`].
    ///
    /// # Errors
    /// As [`Renderer::prepare_scene`]; [`RenderError::Stopped`] as [`Self::stop_when`] describes.
    pub fn upload(&mut self, request: SceneRequest<'_>) -> Result<PreparedScene, RenderError> {
        let mut prepared = self.renderer.prepare_shown(request)?;
        self.put(&mut prepared)?;
        // The memory of the first upload is free for the second one.
        if request.shadows != Shadows::None {
            self.renderer.prepare_casters(&mut prepared, request)?;
            self.put(&mut prepared)?;
        }
        Ok(prepared)
    }

    fn put(&mut self, prepared: &mut PreparedScene) -> Result<(), RenderError> {
        // SAFETY: the commands are submitted and waited for while the scene is alive.
        self.submit(|commands| unsafe { prepared.record_upload(commands) })?;
        // SAFETY: the commands have run.
        unsafe { prepared.discard_uploads() };
        Ok(())
    }

    /// Makes pipelines and memory for frames of a scene.
    ///
    /// # Errors
    /// [`RenderError::OtherDevice`] for a scene of another device, [`RenderError::NotUploaded`] for a scene that was
    /// not uploaded by [`Self::upload`]; otherwise if the settings are impossible or memory runs out.
    pub fn prepare(&self, scene: &PreparedScene, settings: &Settings) -> Result<SceneFrame, RenderError> {
        self.prepare_pixels::<[f32; 4]>(scene, settings)
    }

    /// As [`Self::prepare`], for [`Self::render_pixels`] with pixels of this type.
    ///
    /// # Errors
    /// As [`Self::prepare`].
    pub fn prepare_pixels<P: Pixel>(
        &self,
        scene: &PreparedScene,
        settings: &Settings,
    ) -> Result<SceneFrame, RenderError> {
        let reserved = ReadBack::bytes::<P>(settings);
        self.check(&scene.gpu_scene)?;
        if P::ENCODING.is_some() && matches!(settings.method, Method::Accumulate { .. }) {
            return Err(RenderError::AccumulatedPixels);
        }
        let capacity = self.renderer.first_capacity().without_unlisted_tiles();
        self.renderer.prepare_with(scene, settings, P::ENCODING, capacity, reserved)
    }

    /// Renders a frame and waits for it. If the frame's lists outgrow their memory, the frame is prepared again with
    /// more memory, so that the image does not depend on the first estimate.
    ///
    /// # Errors
    /// [`RenderError::OtherDevice`] for a frame of another device, [`RenderError::OtherPixels`] for a frame that was prepared
    /// for another type of pixel; otherwise if the device is lost, or the lists do not fit even into the largest memory.
    pub fn render(&mut self, frame: &mut SceneFrame, camera: &Camera) -> Result<Rendered, RenderError> {
        self.render_pixels(frame, camera)
    }

    /// As [`Self::render`], with pixels of the type for which [`Self::prepare_pixels`] has prepared the frame. An image of
    /// `[u8; 4]` is encoded on the device, and a quarter of the bytes is read back.
    ///
    /// # Errors
    /// As [`Self::render`].
    pub fn render_pixels<P: Pixel>(
        &mut self,
        frame: &mut SceneFrame,
        camera: &Camera,
    ) -> Result<Rendered<P>, RenderError> {
        match &frame.settings().method {
            Method::Accumulate { samples, pattern } => {
                let offsets = pattern.offsets(*samples).map_err(EngineError::from)?;
                let samples = frame.settings().pixel_filter.samples(&offsets);
                self.mean(frame, camera, &samples, || {})
            }
            _ => self.render_one(frame, camera),
        }
    }

    /// Renders one frame, with more memory if its lists outgrow what it has.
    pub(super) fn render_one<P: Pixel>(
        &mut self,
        frame: &mut SceneFrame,
        camera: &Camera,
    ) -> Result<Rendered<P>, RenderError> {
        loop {
            let rendered = self.render_once(frame, camera);
            if !matches!(rendered, Ok(_) | Err(RenderError::Engine(EngineError::Unfinished { .. }))) {
                return rendered;
            }
            let shortfall = frame.shortfall()?;
            match rendered {
                Ok(image) => {
                    // The image is complete: in tiles whose list of candidates outgrew its memory, every triangle was
                    // tried, which is slow.
                    if shortfall.rooms > 1 && frame.lists_can_grow() {
                        let larger = frame.capacity().with_lists(shortfall.rooms);
                        match self.renderer.prepare_like(frame, larger) {
                            Ok(larger) => *frame = larger,
                            Err(error) => {
                                log::warn!("the frame stays slow, with short lists: {error}");
                            }
                        }
                    }
                    return Ok(image);
                }
                Err(unfinished) => {
                    let Some(more) = frame.capacity().next(&shortfall) else {
                        return Err(unfinished);
                    };
                    log::debug!("the frame lacked room and is made again: {shortfall:?}");
                    *frame = self.renderer.prepare_like(frame, more)?;
                }
            }
        }
    }

    /// Checks that a scene can be shown by this device.
    pub(super) fn check(&self, scene: &GpuScene) -> Result<(), RenderError> {
        self.renderer.check(scene)?;
        if !scene.is_uploaded() {
            return Err(RenderError::NotUploaded);
        }
        Ok(())
    }

    pub(super) fn render_once<P: Pixel>(
        &mut self,
        frame: &mut SceneFrame,
        camera: &Camera,
    ) -> Result<Rendered<P>, RenderError> {
        self.check(frame.scene())?;
        if frame.encoding() != P::ENCODING {
            return Err(RenderError::OtherPixels { prepared: frame.encoding(), read: P::ENCODING });
        }
        let size = frame.settings().output_size();
        let output = ReadBack::for_frame::<P>(&self.gpu, frame, self.output.take())?;
        let target = Target::Buffer {
            colors: output.colors.handle(),
            attributes: output.attributes.as_ref().map(Buffer::handle),
        };
        // Each region is submitted separately, because systems stop a device that works on one submission for too
        // long.
        let submitted = (0..frame.regions()).try_for_each(|region| {
            // SAFETY: the previous submission has run; frame and target outlive this one, which is waited for.
            self.submit(|commands| unsafe {
                frame.record_regions(camera, commands, &target, region..region + 1);
            })
        });
        let rendered = submitted.and_then(|()| {
            let mut statistics = frame.statistics()?;
            statistics.memory_bytes += output.memory.used();
            let pixels = pixel_count(frame.settings()) as usize;
            let attributes = match &output.attributes {
                Some(attributes) if frame.settings().attributes => attributes.read(pixels)?,
                _ => &[],
            };
            Ok(Rendered {
                size,
                colors: output.colors.read(pixels)?.to_vec(),
                attributes: attributes.to_vec(),
                statistics,
            })
        });
        self.output = Some(output);
        rendered
    }

    /// Records commands, submits them and waits for them.
    pub(super) fn submit(&mut self, record: impl FnOnce(vk::CommandBuffer)) -> Result<(), RenderError> {
        if self.is_unwanted.as_ref().is_some_and(|asked| asked()) {
            return Err(RenderError::Stopped);
        }
        self.wait()?;
        let device = &self.gpu.device;
        // SAFETY: this object owns command buffer and fence, which are idle after waiting. The queue is that of
        // `with_queue`, and is locked while it is used.
        unsafe {
            let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
            device.begin_command_buffer(self.commands, &begin).map_err(VulkanError::of("vkBeginCommandBuffer"))?;
            record(self.commands);
            make_visible_to_host(device, self.commands);
            device.end_command_buffer(self.commands).map_err(VulkanError::of("vkEndCommandBuffer"))?;
            let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(self.commands)];
            let submits = [vk::SubmitInfo2::default().command_buffer_infos(&commands)];
            let queue = self.queue.lock().unwrap_or_else(PoisonError::into_inner);
            device.queue_submit2(*queue, &submits, self.fence).map_err(VulkanError::of("vkQueueSubmit2"))?;
        }
        self.is_pending = true;
        Ok(self.wait()?)
    }

    /// Waits until submitted commands have run.
    fn wait(&mut self) -> Result<(), VulkanError> {
        if self.is_pending {
            let device = &self.gpu.device;
            // SAFETY: the fence belongs to the last submission, and is reset once that has run.
            unsafe {
                device.wait_for_fences(&[self.fence], true, u64::MAX).map_err(VulkanError::of("vkWaitForFences"))?;
                device.reset_fences(&[self.fence]).map_err(VulkanError::of("vkResetFences"))?;
            }
            self.is_pending = false;
        }
        Ok(())
    }
}

/// Records a barrier that makes the device's writes visible to mapped memory.
///
/// # Safety
/// `commands` is being recorded for `device`.
unsafe fn make_visible_to_host(device: &ash::Device, commands: vk::CommandBuffer) {
    let barriers = [vk::MemoryBarrier2::default()
        .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
        .dst_stage_mask(vk::PipelineStageFlags2::HOST)
        .dst_access_mask(vk::AccessFlags2::HOST_READ)];
    let info = vk::DependencyInfo::default().memory_barriers(&barriers);
    // SAFETY: guaranteed by the caller.
    unsafe { device.cmd_pipeline_barrier2(commands, &info) };
}

impl Drop for Headless {
    fn drop(&mut self) {
        // An error can be ignored: the commands of a lost device are no longer executed.
        let _ = self.wait();
        // SAFETY: the commands have run; the device is destroyed after its objects.
        unsafe {
            self.gpu.device.destroy_fence(self.fence, None);
            self.gpu.device.destroy_command_pool(self.pool, None);
        }
    }
}

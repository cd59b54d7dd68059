//! A renderer with a device of its own, for images without a window.

use super::plan::Effort;
use super::renderer::{PreparedScene, Renderer};
use super::{Frame, RenderError, Settings, Statistics, Target};
use crate::camera::Camera;
use crate::scene::{Pose, Scene};
use crate::vulkan::{Buffer, Gpu, Instance, InstanceOptions, Memory, MemoryUse, VulkanError};
use ash::vk;
use std::sync::Arc;

/// How to create a [`Headless`].
#[derive(Clone, Debug, Default)]
pub struct HeadlessOptions {
    /// Part of the device's name, or `None` for the best one.
    pub device: Option<String>,
    /// Run under the validation layer.
    pub validation: bool,
}

/// An image and what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendered {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Rows from the top: linear light, premultiplied alpha.
    pub colors: Vec<[f32; 4]>,
    /// Where asked for, what the centre of each pixel sees.
    pub attributes: Vec<PixelAttributes>,
    /// Figures of the frame.
    pub statistics: Statistics,
}

/// A device, a queue, and a renderer in it.
pub struct Headless {
    pub(super) renderer: Renderer,
    gpu: Arc<Gpu>,
    queue: vk::Queue,
    pool: vk::CommandPool,
    commands: vk::CommandBuffer,
    fence: vk::Fence,
    output: Option<(Buffer, Option<Buffer>)>,
}

/// What the centre of a pixel sees besides its colour; the layout is that of `shaders/attributes.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PixelAttributes {
    /// Distance from the eye along the view direction in world units; 0 for background.
    pub depth: f32,
    /// ID of the nearest opaque or MASK triangle; 0 is background.
    pub id: u32,
    /// Samples that the pixel's colour is the mean of.
    pub samples: u32,
    /// 1 for superpixels, otherwise 0.
    pub superpixel: u32,
    /// Unit normal in world space; 0 for background.
    pub normal: [f32; 3],
    /// Unused.
    pub padding: u32,
}

/// Effort is doubled this often before a frame is given up.
const RETRIES: u32 = 6;

impl Headless {
    /// Creates a device and all it needs.
    ///
    /// # Errors
    /// [`VulkanError`] if there is no suitable device, listing what is missing.
    pub fn new(options: &HeadlessOptions) -> Result<Self, VulkanError> {
        let instance = Instance::new(InstanceOptions {
            validation: options.validation,
        })?;
        let gpu = instance.create_gpu(options.device.as_deref())?;
        let renderer = Renderer::in_gpu(gpu.clone())?;
        // SAFETY: the queue family is the one the device was created with; handles made before a failure are
        // destroyed by `Drop`.
        let queue = unsafe { gpu.device.get_device_queue(gpu.queue_family, 0) };
        let mut headless = Self {
            renderer,
            gpu: gpu.clone(),
            queue,
            pool: vk::CommandPool::null(),
            commands: vk::CommandBuffer::null(),
            fence: vk::Fence::null(),
            output: None,
        };
        // SAFETY: plain creations on a live device.
        unsafe {
            let info = vk::CommandPoolCreateInfo::default()
                .queue_family_index(gpu.queue_family)
                .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
            headless.pool = gpu
                .device
                .create_command_pool(&info, None)
                .map_err(VulkanError::of("vkCreateCommandPool"))?;
            let info = vk::CommandBufferAllocateInfo::default()
                .command_pool(headless.pool)
                .command_buffer_count(1);
            let buffers = gpu
                .device
                .allocate_command_buffers(&info)
                .map_err(VulkanError::of("vkAllocateCommandBuffers"))?;
            headless.commands = buffers.first().copied().unwrap_or_default();
            headless.fence = gpu
                .device
                .create_fence(&vk::FenceCreateInfo::default(), None)
                .map_err(VulkanError::of("vkCreateFence"))?;
        }
        Ok(headless)
    }

    /// The device.
    #[must_use]
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Everything the validation layer has said; empty without it.
    #[must_use]
    pub fn validation_messages(&self) -> Vec<String> {
        self.gpu
            .instance()
            .map(|instance| instance.validation_messages())
            .unwrap_or_default()
    }

    /// Puts a posed scene on the device.
    ///
    /// # Errors
    /// If memory runs out or the scene passes a limit of the device.
    pub fn upload(
        &mut self,
        scene: &Scene,
        pose: &Pose,
        max_memory: Option<u64>,
    ) -> Result<PreparedScene, RenderError> {
        let mut prepared = self.renderer.prepare_scene(scene, pose, max_memory)?;
        // SAFETY: the commands are submitted and waited for while the scene is alive.
        self.submit(|renderer, commands| unsafe { prepared.record_upload(renderer, commands) })?;
        prepared.discard_uploads();
        Ok(prepared)
    }

    /// Makes the pipelines and memory for frames of a scene.
    ///
    /// # Errors
    /// If the settings are impossible or memory runs out.
    pub fn prepare(
        &self,
        scene: &PreparedScene,
        settings: &Settings,
    ) -> Result<Frame, RenderError> {
        self.renderer.prepare(scene, settings, None)
    }

    /// Renders a frame and waits for it. Where its records outgrow its memory it is prepared again with more
    /// rounds, so that the image does not depend on how much there was.
    ///
    /// # Errors
    /// If the device is lost, or records do not fit however often the work is split.
    pub fn render(
        &mut self,
        scene: &PreparedScene,
        frame: &mut Frame,
        camera: &Camera,
    ) -> Result<Rendered, RenderError> {
        for _ in 0..RETRIES {
            match self.render_once(scene, frame, camera) {
                Err(RenderError::Unfinished { cells }) => {
                    let shortfall = frame.shortfall();
                    log::debug!("{cells} cells or tiles are left: {shortfall:?}");
                    self.prepare_again(scene, frame, frame.effort().more(shortfall))?;
                }
                Ok(image) => {
                    // Tiles without a list made the image all the same, but slowly.
                    if image.statistics.unlisted_tiles > 0 && frame.lists_can_grow() {
                        self.prepare_again(scene, frame, frame.effort().with_doubled_lists())?;
                    }
                    return Ok(image);
                }
                failed => return failed,
            }
        }
        self.render_once(scene, frame, camera)
    }

    fn prepare_again(
        &self,
        scene: &PreparedScene,
        frame: &mut Frame,
        effort: Effort,
    ) -> Result<(), RenderError> {
        let settings = frame.settings().clone();
        *frame = self.renderer.prepare_with(scene, &settings, None, effort)?;
        Ok(())
    }

    fn render_once(
        &mut self,
        scene: &PreparedScene,
        frame: &mut Frame,
        camera: &Camera,
    ) -> Result<Rendered, RenderError> {
        let size = frame.settings().size;
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        let wants_attributes = frame.settings().attributes;
        let fits = |buffer: &Buffer, bytes: u64| buffer.size() >= bytes;
        let reusable = self.output.as_ref().is_some_and(|(colors, attributes)| {
            fits(colors, pixels * 16)
                && (!wants_attributes || attributes.as_ref().is_some_and(|a| fits(a, pixels * 32)))
        });
        if !reusable {
            self.output = None;
            let memory = Memory::new(self.gpu.clone(), None);
            let make = |name, bytes| {
                memory.buffer(
                    name,
                    bytes,
                    vk::BufferUsageFlags::TRANSFER_DST,
                    MemoryUse::Readback,
                )
            };
            let attributes = if wants_attributes {
                Some(make("attribute read-back", pixels * 32)?)
            } else {
                None
            };
            self.output = Some((make("colour read-back", pixels * 16)?, attributes));
        }
        let Some((colors, attributes)) = self.output.take() else {
            return Err(VulkanError::OutOfMemory {
                what: "read-back".to_owned(),
                bytes: pixels * 16,
            }
            .into());
        };
        let target = Target::Buffer {
            colors: colors.handle(),
            attributes: attributes.as_ref().map(Buffer::handle),
        };
        // SAFETY: the last submission was waited for; scene, frame and target outlive this one, which is waited for.
        let submitted =
            self.submit(|_, commands| unsafe { frame.record(scene, camera, commands, &target) });
        let rendered = submitted.and_then(|()| {
            let statistics = frame.statistics(scene)?;
            let count = pixels as usize;
            let floats: &[[f32; 4]] = bytemuck::try_cast_slice(colors.bytes()).unwrap_or(&[]);
            let seen: &[PixelAttributes] = attributes
                .as_ref()
                .filter(|_| wants_attributes)
                .and_then(|a| bytemuck::try_cast_slice(a.bytes()).ok())
                .unwrap_or(&[]);
            Ok(Rendered {
                size,
                colors: floats.get(..count).unwrap_or(&[]).to_vec(),
                attributes: seen.get(..count).unwrap_or(&[]).to_vec(),
                statistics,
            })
        });
        self.output = Some((colors, attributes));
        rendered
    }

    /// Records, submits and waits.
    pub(super) fn submit(
        &mut self,
        record: impl FnOnce(&Renderer, vk::CommandBuffer),
    ) -> Result<(), RenderError> {
        let device = &self.gpu.device;
        // SAFETY: the command buffer and fence are ours and idle between calls; the queue is used by this thread alone.
        unsafe {
            let begin = vk::CommandBufferBeginInfo::default()
                .flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
            device
                .begin_command_buffer(self.commands, &begin)
                .map_err(VulkanError::of("vkBeginCommandBuffer"))?;
            record(&self.renderer, self.commands);
            make_visible_to_host(device, self.commands);
            device
                .end_command_buffer(self.commands)
                .map_err(VulkanError::of("vkEndCommandBuffer"))?;
            let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(self.commands)];
            let submits = [vk::SubmitInfo2::default().command_buffer_infos(&commands)];
            device
                .queue_submit2(self.queue, &submits, self.fence)
                .map_err(VulkanError::of("vkQueueSubmit2"))?;
            device
                .wait_for_fences(&[self.fence], true, u64::MAX)
                .map_err(VulkanError::of("vkWaitForFences"))?;
            device
                .reset_fences(&[self.fence])
                .map_err(VulkanError::of("vkResetFences"))?;
        }
        Ok(())
    }
}

/// Makes what the device wrote visible to mapped memory.
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
    // SAFETY: passed on to the caller.
    unsafe { device.cmd_pipeline_barrier2(commands, &info) };
}

impl Drop for Headless {
    fn drop(&mut self) {
        // SAFETY: every submission was waited for; the device lives until after.
        unsafe {
            let _ = self.gpu.device.device_wait_idle();
            self.gpu.device.destroy_fence(self.fence, None);
            self.gpu.device.destroy_command_pool(self.pool, None);
        }
    }
}

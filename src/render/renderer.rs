//! The face of the renderer: what it needs of a device, and how scenes and frames are prepared.

use super::frame::Frame;
use super::plan::Effort;
use super::sites::{Casters, Triangles};
use super::{RenderError, Settings, Shadows};
use crate::passes::{Encoding, FrameLayout, GpuScene};
use crate::scene::{Pose, Scene};
use crate::vulkan::{Gpu, Host, Memory, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Renders in a device: the host's or one of our own.
///
/// Everything that can fail happens in `prepare_scene` and `prepare`; recording a frame writes commands and nothing
/// else: it does not submit, wait or allocate.
pub struct Renderer {
    pub(super) layout: Arc<FrameLayout>,
    gpu: Arc<Gpu>,
}

/// A scene on the device.
pub struct PreparedScene {
    pub(super) gpu_scene: GpuScene,
    pub(super) memory: Memory,
    /// For what the host looks for in images of sites.
    pub(super) triangles: Triangles,
    /// What casts shadows, where the scene was made ready for them.
    pub(super) casters: Option<Box<Casters>>,
}

impl PreparedScene {
    /// Bytes of device memory that it takes.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        let casters = self
            .casters
            .as_ref()
            .map_or(0, |casters| casters.memory_bytes());
        self.memory.used() + casters
    }

    /// Number of triangles.
    #[must_use]
    pub fn triangle_count(&self) -> u32 {
        self.gpu_scene.triangle_count()
    }

    /// Records the copies of the scene to the device. Once, before the first frame that shows it.
    ///
    /// # Safety
    /// - `commands` is being recorded for the device and queue family that the renderer was made with.
    /// - The scene outlives the execution of the commands.
    pub unsafe fn record_upload(&self, renderer: &Renderer, commands: vk::CommandBuffer) {
        // SAFETY: passed on to the caller.
        let recorder = unsafe { Recorder::new(&renderer.gpu, commands, None) };
        self.gpu_scene.record_upload(&recorder);
    }

    /// Frees the memory that the upload needed. Once the commands of [`Self::record_upload`] are done.
    pub fn discard_uploads(&mut self) {
        self.gpu_scene.discard_uploads();
    }
}

impl Renderer {
    /// A renderer in a host's device. See [`crate::vulkan::Requirements`] for what the device needs.
    ///
    /// # Errors
    /// [`VulkanError::Missing`] lists all that the device lacks.
    ///
    /// # Safety
    /// - The host's handles are alive, belong together and outlive the renderer and all that it prepares.
    /// - The device was created with [`crate::vulkan::Requirements::features13`] enabled.
    pub unsafe fn new(host: Host) -> Result<Self, VulkanError> {
        // SAFETY: passed on to the caller.
        Self::in_gpu(unsafe { Gpu::new(host) }?)
    }

    /// A renderer in a device of our own.
    ///
    /// # Errors
    /// If the driver refuses the layouts.
    pub fn in_gpu(gpu: Arc<Gpu>) -> Result<Self, VulkanError> {
        Ok(Self {
            layout: FrameLayout::new(&gpu)?,
            gpu,
        })
    }

    /// The device.
    #[must_use]
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Allocates a posed scene's memory on the device.
    ///
    /// # Errors
    /// If memory runs out, `max_memory` bytes are passed, or the scene passes a limit of the device.
    pub fn prepare_scene(
        &self,
        scene: &Scene,
        pose: &Pose,
        max_memory: Option<u64>,
    ) -> Result<PreparedScene, RenderError> {
        let memory = Memory::new(self.gpu.clone(), max_memory);
        let gpu_scene = GpuScene::new(&self.layout, &memory, scene, pose)?;
        Ok(PreparedScene {
            gpu_scene,
            memory,
            triangles: Triangles::new(&pose.geometry),
            casters: None,
        })
    }

    /// Makes the pipelines and memory for frames of a scene; `encoding` is that of the host's image, `None` for
    /// buffers of linear float RGBA.
    ///
    /// # Errors
    /// If the settings are impossible, memory runs out, or the driver refuses something.
    pub fn prepare(
        &self,
        scene: &PreparedScene,
        settings: &Settings,
        encoding: Option<Encoding>,
    ) -> Result<Frame, RenderError> {
        self.prepare_with(scene, settings, encoding, Effort::default())
    }

    /// Makes a frame like another one that ended as [`RenderError::Unfinished`], with more of what it lacked: rounds, memory for
    /// candidates and layers, or subgroups.
    ///
    /// # Errors
    /// As for [`Self::prepare`].
    pub fn prepare_again(
        &self,
        scene: &PreparedScene,
        frame: &Frame,
        encoding: Option<Encoding>,
    ) -> Result<Frame, RenderError> {
        self.prepare_with(
            scene,
            frame.settings(),
            encoding,
            frame.effort().more(frame.shortfall()),
        )
    }

    pub(super) fn prepare_with(
        &self,
        scene: &PreparedScene,
        settings: &Settings,
        encoding: Option<Encoding>,
        effort: Effort,
    ) -> Result<Frame, RenderError> {
        if settings.shadows == Shadows::Exact {
            return Err(RenderError::FrameShadows);
        }
        settings.check(self.gpu.limits())?;
        Frame::new(&self.layout, scene, settings, encoding, effort)
    }
}

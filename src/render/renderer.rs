//! The renderer: requirements for a device, and preparation of scenes and frames.

use super::frame::SceneFrame;
use super::shadows::Casters;
use super::{RenderError, Settings, Shadows};
use crate::engine::pipelines::FrameLayout;
use crate::engine::sampler::{Capacity, RoundPolicy};
use crate::render::data::{AlphaUse, GpuScene, SceneUploads};
use crate::render::passes::Encoding;
use crate::scene::{Motion, Pose, Scene};
use crate::vulkan::{Gpu, Host, Memory, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Renderer in a host's device, or in a device that the library opened.
///
/// Everything that can fail happens in `prepare_scene` and `prepare`. Recording a frame only writes commands: it does
/// not submit, wait or allocate. [`Headless`](crate::render::Headless) submits and waits.
///
/// A clone works in the same device, has the same pipelines, and shows scenes that the original has prepared.
#[derive(Clone)]
pub struct Renderer {
    pub(super) layout: Arc<FrameLayout>,
    gpu: Arc<Gpu>,
}

/// Request to prepare a scene: what to upload, and a limit for its memory.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct SceneRequest<'a> {
    /// Scene with its materials.
    pub scene: &'a Scene,
    /// Moment that is shown unless a frame [shows](SceneFrame::show) another one.
    pub pose: &'a Pose,
    /// Motion that the pose was made with, if frames will show other moments of it. Images of locations always show
    /// the pose.
    pub motion: Option<&'a Motion>,
    /// Shadows that settings may ask for. With [`Shadows::Exact`] the scene's triangles are uploaded twice, as visible
    /// surfaces and as casters of shadows, for at most 32 lights.
    pub shadows: Shadows,
    /// Limit for all device memory in bytes.
    pub max_memory: Option<u64>,
}

impl<'a> SceneRequest<'a> {
    /// Request for a scene that does not move and has no shadows, with unlimited memory.
    #[must_use]
    pub fn new(scene: &'a Scene, pose: &'a Pose) -> Self {
        Self { scene, pose, motion: None, shadows: Shadows::None, max_memory: None }
    }

    /// This request with the motion that the pose was made with, if any.
    #[must_use]
    pub fn moving(self, motion: impl Into<Option<&'a Motion>>) -> Self {
        Self { motion: motion.into(), ..self }
    }

    /// This request with shadows.
    #[must_use]
    pub fn shadowed(self, shadows: Shadows) -> Self {
        Self { shadows, ..self }
    }

    /// This request with a limit for device memory in bytes, if any.
    #[must_use]
    pub fn within(self, max_memory: impl Into<Option<u64>>) -> Self {
        Self { max_memory: max_memory.into(), ..self }
    }
}

/// A scene in device memory.
pub struct PreparedScene {
    /// The scene, shared with the frames that show it.
    pub(super) gpu_scene: Arc<GpuScene>,
    pub(super) uploads: SceneUploads,
    /// Casters of shadows, if the scene was prepared for shadows.
    pub(super) casters: Option<Arc<Casters>>,
    pub(super) caster_uploads: SceneUploads,
}

impl PreparedScene {
    /// Bytes of device memory of the scene, casters of shadows included.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        self.gpu_scene.memory_bytes() + self.casters_bytes()
    }

    pub(super) fn casters_bytes(&self) -> u64 {
        self.casters.as_ref().map_or(0, |casters| casters.memory_bytes())
    }

    /// Number of triangles.
    #[must_use]
    pub fn triangle_count(&self) -> u64 {
        self.gpu_scene.geometry.triangle_count
    }

    /// Records the copies of the scene and of its casters to the device, to be executed before the first frame that
    /// shows it. The copies can be recorded again if the commands were discarded; after [`Self::discard_uploads`]
    /// nothing is recorded.
    ///
    /// # Safety
    /// - `commands` is being recorded for the device and queue family of the renderer that prepared the scene.
    /// - The scene outlives the execution of the commands, and [`Self::discard_uploads`] is not called before it.
    pub unsafe fn record_upload(&self, commands: vk::CommandBuffer) {
        // SAFETY: guaranteed by the caller.
        let recorder = unsafe { Recorder::new(self.gpu_scene.memory.gpu(), commands, None) };
        self.uploads.record(&recorder, &self.gpu_scene);
        if let Some(casters) = &self.casters {
            self.caster_uploads.record(&recorder, casters.scene());
        }
    }

    /// Frees the memory that the upload needed.
    ///
    /// # Safety
    /// The commands of [`Self::record_upload`] have been executed.
    pub unsafe fn discard_uploads(&mut self) {
        self.gpu_scene.set_uploaded();
        self.uploads = SceneUploads::default();
        self.caster_uploads = SceneUploads::default();
    }
}

impl Renderer {
    /// Makes a renderer in a host's device. [`crate::vulkan::Requirements`] lists what the device needs.
    ///
    /// # Errors
    /// [`VulkanError::Missing`] lists everything that the device lacks.
    ///
    /// # Safety
    /// - The host's handles are alive, belong together and outlive the renderer, its clones and everything that they
    ///   prepare.
    /// - The device was created with [`crate::vulkan::Requirements::features13`] enabled.
    pub unsafe fn new(host: Host) -> Result<Self, VulkanError> {
        // SAFETY: guaranteed by the caller.
        Self::in_gpu(unsafe { Gpu::new(host) }?)
    }

    /// Makes a renderer in a device that the library opened.
    ///
    /// # Errors
    /// If the driver refuses the layouts.
    pub fn in_gpu(gpu: Arc<Gpu>) -> Result<Self, VulkanError> {
        Ok(Self { layout: FrameLayout::new(&gpu)?, gpu })
    }

    /// Device of the renderer.
    #[must_use]
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// Allocates device memory for a scene, and for its casters if shadows are asked for.
    ///
    /// # Errors
    /// [`RenderError::Engine`] if memory runs out, exceeds the limit, or the scene exceeds
    /// a limit of the device; [`RenderError::Geometry`] if the geometry contradicts itself;
    /// [`RenderError::OtherMotion`] for a pose and motion that were not made together; [`RenderError::ShadowLights`]
    /// for shadows of more than 32 lights.
    pub fn prepare_scene(&self, request: SceneRequest<'_>) -> Result<PreparedScene, RenderError> {
        let mut prepared = self.prepare_shown(request)?;
        self.prepare_casters(&mut prepared, request)?;
        Ok(prepared)
    }

    /// Prepares a scene without its casters of shadows.
    pub(super) fn prepare_shown(&self, request: SceneRequest<'_>) -> Result<PreparedScene, RenderError> {
        let SceneRequest { scene, pose, motion, max_memory, .. } = request;
        if motion.is_some_and(|motion| !motion.is_of(pose)) {
            return Err(RenderError::OtherMotion);
        }
        self.prepare_moving(scene, pose, motion, AlphaUse::Tests, max_memory)
    }

    pub(super) fn prepare_moving(
        &self,
        scene: &Scene,
        pose: &Pose,
        motion: Option<&Motion>,
        alphas: AlphaUse,
        max_memory: Option<u64>,
    ) -> Result<PreparedScene, RenderError> {
        let memory = Memory::new(self.gpu.clone(), max_memory);
        pose.geometry.check(scene.materials.len())?;
        let (gpu_scene, uploads) = GpuScene::new(&self.layout, &memory, scene, pose, motion, alphas)?;
        Ok(PreparedScene {
            gpu_scene: Arc::new(gpu_scene),
            uploads,
            casters: None,
            caster_uploads: SceneUploads::default(),
        })
    }

    /// Makes pipelines and memory for frames of a scene. `encoding` is that of the host's image; `None` is for buffers
    /// of linear float RGBA.
    ///
    /// # Errors
    /// [`RenderError::OtherDevice`] for a scene of another renderer's device; [`RenderError::NoCasters`] if shadows
    /// are asked for and the scene was not prepared for them; otherwise if the settings are impossible, memory runs
    /// out, or the driver refuses something.
    pub fn prepare(
        &self,
        scene: &PreparedScene,
        settings: &Settings,
        encoding: Option<Encoding>,
    ) -> Result<SceneFrame, RenderError> {
        self.prepare_with(scene, settings, encoding, self.first_capacity(), 0)
    }

    /// Makes a frame like one that ended with [`EngineError::Unfinished`](crate::render::EngineError::Unfinished), with
    /// more memory for candidates and layers, more rounds or more subgroups, whichever that frame lacked.
    ///
    /// # Errors
    /// As [`Self::prepare`].
    pub fn prepare_again(&self, frame: &SceneFrame) -> Result<SceneFrame, RenderError> {
        let shortfall = frame.shortfall()?;
        log::debug!("the frame lacked room and is made again: {shortfall:?}");
        let present = frame.capacity();
        self.prepare_like(frame, present.next(&shortfall).unwrap_or(present))
    }

    /// Capacity for the first frame of a scene.
    pub(super) fn first_capacity(&self) -> Capacity {
        Capacity::usual(RoundPolicy::of(self.gpu.limits()))
    }

    /// Checks that a scene belongs to this renderer's device.
    pub(super) fn check(&self, scene: &GpuScene) -> Result<(), RenderError> {
        if Arc::ptr_eq(scene.memory.gpu(), &self.gpu) { Ok(()) } else { Err(RenderError::OtherDevice) }
    }

    pub(super) fn prepare_like(&self, frame: &SceneFrame, capacity: Capacity) -> Result<SceneFrame, RenderError> {
        self.check(frame.scene())?;
        let mut like = SceneFrame::new(
            &self.layout,
            frame.scene(),
            frame.casters(),
            frame.settings(),
            frame.encoding(),
            capacity,
            frame.reserved(),
        )?;
        if let Some(moment) = frame.moment() {
            like.show(moment.clone())?;
        }
        Ok(like)
    }

    /// Prepares a frame. `reserved` bytes of the memory that the settings allow are left to other owners.
    pub(super) fn prepare_with(
        &self,
        scene: &PreparedScene,
        settings: &Settings,
        encoding: Option<Encoding>,
        capacity: Capacity,
        reserved: u64,
    ) -> Result<SceneFrame, RenderError> {
        self.check(&scene.gpu_scene)?;
        settings.check(self.gpu.limits())?;
        let (shown, casters) = (&scene.gpu_scene, scene.casters.as_ref());
        let reserved = reserved + scene.casters_bytes();
        SceneFrame::new(&self.layout, shown, casters, settings, encoding, capacity, reserved)
    }
}

//! The face of the renderer: what it needs of a device, and how scenes and frames are prepared.

use super::frame::Frame;
use super::shadows::Casters;
use super::{RenderError, Settings, Shadows};
use crate::engine::sampler::plan::Capacity;
use crate::passes::{Encoding, FrameLayout};
use crate::render::passes::{GpuScene, SceneUploads};
use crate::scene::{Motion, Pose, Scene};
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

/// What is to be put on a device of a scene, and how much memory that may take.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct SceneRequest<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The moment that is shown unless a frame [shows](Frame::show) another one.
    pub pose: &'a Pose,
    /// The motion that the pose was made with, where frames show other moments of it, too. Images of locations are those of
    /// the pose.
    pub motion: Option<&'a Motion>,
    /// The shadows that settings may ask for: with [`Shadows::Exact`] the scene's triangles are there twice, as what is seen and
    /// as what casts shadows, for at most 32 lights.
    pub shadows: Shadows,
    /// Bound on device memory in bytes, for all of it.
    pub max_memory: Option<u64>,
}

impl<'a> SceneRequest<'a> {
    /// A scene that keeps still and has no shadows, in as much memory as it takes.
    #[must_use]
    pub fn new(scene: &'a Scene, pose: &'a Pose) -> Self {
        Self {
            scene,
            pose,
            motion: None,
            shadows: Shadows::None,
            max_memory: None,
        }
    }

    /// The same with the motion that the pose was made with, if any.
    #[must_use]
    pub fn moving(self, motion: impl Into<Option<&'a Motion>>) -> Self {
        Self {
            motion: motion.into(),
            ..self
        }
    }

    /// The same with shadows.
    #[must_use]
    pub fn shadowed(self, shadows: Shadows) -> Self {
        Self { shadows, ..self }
    }

    /// The same in at most so many bytes, if any.
    #[must_use]
    pub fn within(self, max_memory: impl Into<Option<u64>>) -> Self {
        Self {
            max_memory: max_memory.into(),
            ..self
        }
    }
}

/// A scene on the device.
pub struct PreparedScene {
    /// Shared with the frames that show it.
    pub(super) gpu_scene: Arc<GpuScene>,
    pub(super) uploads: SceneUploads,
    /// What casts shadows, where the scene was made ready for them.
    pub(super) casters: Option<Arc<Casters>>,
    pub(super) caster_uploads: SceneUploads,
}

impl PreparedScene {
    /// Bytes of device memory that it takes.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        self.gpu_scene.memory_bytes() + self.casters_bytes()
    }

    pub(super) fn casters_bytes(&self) -> u64 {
        self.casters
            .as_ref()
            .map_or(0, |casters| casters.memory_bytes())
    }

    /// Number of triangles.
    #[must_use]
    pub fn triangle_count(&self) -> u64 {
        self.gpu_scene.triangle_count()
    }

    /// Records the copies of the scene, and of what casts shadows, to the device, to be executed before the first frame that
    /// shows it. Where the commands were discarded, it records the same again; after [`Self::discard_uploads`], nothing.
    ///
    /// # Safety
    /// - `commands` is being recorded for the device and queue family of the renderer that prepared the scene.
    /// - The scene outlives the execution of the commands, and [`Self::discard_uploads`] waits for it.
    pub unsafe fn record_upload(&self, commands: vk::CommandBuffer) {
        // SAFETY: passed on to the caller.
        let recorder = unsafe { Recorder::new(self.gpu_scene.memory().gpu(), commands, None) };
        self.uploads.record(&recorder, &self.gpu_scene);
        if let Some(casters) = &self.casters {
            self.caster_uploads.record(&recorder, casters.scene());
        }
    }

    /// Frees the memory that the upload needed.
    ///
    /// # Safety
    /// The commands of [`Self::record_upload`] were executed and are done.
    pub unsafe fn discard_uploads(&mut self) {
        self.gpu_scene.set_uploaded();
        self.uploads = SceneUploads::default();
        self.caster_uploads = SceneUploads::default();
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

    /// Allocates a scene's memory on the device, and that of what casts shadows where these are asked for.
    ///
    /// # Errors
    /// If memory runs out, the bound on it is passed, or the scene passes a limit of the device; [`RenderError::Geometry`] if the
    /// geometry contradicts itself; [`RenderError::OtherMotion`] for a pose and motion that were not made together;
    /// [`RenderError::ShadowLights`] for shadows of more than 32 lights.
    pub fn prepare_scene(&self, request: SceneRequest<'_>) -> Result<PreparedScene, RenderError> {
        let mut prepared = self.prepare_shown(request)?;
        self.prepare_casters(&mut prepared, request)?;
        Ok(prepared)
    }

    /// What is shown of a scene, without what casts shadows.
    pub(super) fn prepare_shown(
        &self,
        request: SceneRequest<'_>,
    ) -> Result<PreparedScene, RenderError> {
        let SceneRequest {
            scene,
            pose,
            motion,
            max_memory,
            ..
        } = request;
        if motion.is_some_and(|motion| !motion.is_of(pose)) {
            return Err(RenderError::OtherMotion);
        }
        self.prepare_moving(scene, (pose, motion), max_memory)
    }

    pub(super) fn prepare_moving(
        &self,
        scene: &Scene,
        (pose, motion): (&Pose, Option<&Motion>),
        max_memory: Option<u64>,
    ) -> Result<PreparedScene, RenderError> {
        let memory = Memory::new(self.gpu.clone(), max_memory);
        pose.geometry.check(scene.materials.len())?;
        let (gpu_scene, uploads) = GpuScene::new(&self.layout, &memory, scene, (pose, motion))?;
        Ok(PreparedScene {
            gpu_scene: Arc::new(gpu_scene),
            uploads,
            casters: None,
            caster_uploads: SceneUploads::default(),
        })
    }

    /// Makes the pipelines and memory for frames of a scene; `encoding` is that of the host's image, `None` for
    /// buffers of linear float RGBA.
    ///
    /// # Errors
    /// [`RenderError::OtherDevice`] for a scene of another renderer's device; [`RenderError::NoCasters`] if shadows are asked for
    /// and the scene was not made ready for them; if the settings are impossible, memory runs
    /// out, or the driver refuses something.
    pub fn prepare(
        &self,
        scene: &PreparedScene,
        settings: &Settings,
        encoding: Option<Encoding>,
    ) -> Result<Frame, RenderError> {
        self.prepare_with(scene, settings, encoding, Capacity::default(), 0)
    }

    /// Makes a frame like another one that ended as [`RenderError::Unfinished`], with more of what it lacked: memory for candidates and
    /// layers, or subgroups.
    ///
    /// # Errors
    /// As for [`Self::prepare`].
    pub fn prepare_again(&self, frame: &Frame) -> Result<Frame, RenderError> {
        self.prepare_like(frame, frame.capacity().more(frame.shortfall()?))
    }

    /// Refuses a scene of another device.
    pub(super) fn check(&self, scene: &GpuScene) -> Result<(), RenderError> {
        if Arc::ptr_eq(scene.memory().gpu(), &self.gpu) {
            Ok(())
        } else {
            Err(RenderError::OtherDevice)
        }
    }

    pub(super) fn prepare_like(
        &self,
        frame: &Frame,
        capacity: Capacity,
    ) -> Result<Frame, RenderError> {
        self.check(frame.scene())?;
        let mut like = Frame::new(
            &self.layout,
            (frame.scene(), frame.casters()),
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

    /// Of what the settings allow, `reserved` bytes are kept free for others.
    pub(super) fn prepare_with(
        &self,
        scene: &PreparedScene,
        settings: &Settings,
        encoding: Option<Encoding>,
        capacity: Capacity,
        reserved: u64,
    ) -> Result<Frame, RenderError> {
        self.check(&scene.gpu_scene)?;
        settings.check(self.gpu.limits())?;
        let shown = (&scene.gpu_scene, scene.casters.as_ref());
        let reserved = reserved + scene.casters_bytes();
        Frame::new(&self.layout, shown, settings, encoding, capacity, reserved)
    }
}

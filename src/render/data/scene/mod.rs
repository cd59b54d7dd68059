//! A posed scene on the device.

mod alpha_atlas;
mod bins;
mod environment;
mod light;
mod look;
mod material;
mod mipmaps;
mod slots;
mod texture;
mod texture_set;
mod triangles;

pub(in crate::render) use bins::MaterialBin;
pub use light::LightFeatures;
pub use look::FrameLook;

use super::geometry::GpuGeometry;
use crate::engine::data::Content;
use crate::engine::data::upload::{Upload, Uploader};
use crate::engine::pipelines::FrameLayout;
use crate::scene::{DrawClass, Environment, Moment, Motion, Pose, Scene};
use crate::vulkan::{Buffer, Memory, Recorder, TexelBuffer, VulkanError};
use alpha_atlas::AlphaAtlas;
pub use alpha_atlas::AlphaUse;
use ash::vk;
use bins::Bins;
use environment::{EnvironmentUpload, GpuEnvironment};
use light::GpuLight;
use look::ChangingLook;
use material::MaterialTable;
use slots::Slots;
use std::sync::atomic::{AtomicBool, Ordering};
use texture::{DeviceSampler, GpuTexture};
use texture_set::TextureSet;
use triangles::Triangles;

/// A posed scene in device memory.
pub struct GpuScene {
    pub(in crate::render) geometry: GpuGeometry,
    materials: TexelBuffer,
    /// Number of vectors of a material in the buffer of materials.
    pub(in crate::render) material_vectors: u32,
    is_tinted: bool,
    lights: Buffer,
    changing: Option<ChangingLook>,
    pub(in crate::render) alpha_atlas: TexelBuffer,
    pub(in crate::render) environment: GpuEnvironment,
    /// Whether an environment map lights surfaces, instead of the built-in studio.
    pub(in crate::render) has_environment: bool,
    pub(in crate::render) bins: Vec<MaterialBin>,
    /// Index of the first MASK triangle; if there is none, the index at which MASK triangles would begin.
    pub(in crate::render) first_mask: u32,
    /// Index of the first BLEND triangle; if there is none, the number of indices.
    pub(in crate::render) first_blend: u32,
    high_frequency_triangles: u64,
    pub(in crate::render) light_features: LightFeatures,
    textures: Vec<GpuTexture>,
    _samplers: Vec<DeviceSampler>,
    pub(in crate::render) memory: Memory,
    /// Whether the copies that fill the device memory have been executed.
    uploaded: AtomicBool,
}

/// Staged contents of a scene's buffers and images.
#[derive(Default)]
pub struct SceneUploads {
    buffers: Vec<Upload>,
    /// Contents of the scene's textures, in their order.
    textures: Vec<Buffer>,
    environment: Option<EnvironmentUpload>,
}

impl SceneUploads {
    /// Records the copies to the device.
    pub fn record(&self, recorder: &Recorder<'_>, scene: &GpuScene) {
        for upload in &self.buffers {
            upload.record(recorder);
        }
        for (texture, upload) in scene.textures.iter().zip(&self.textures) {
            texture.record_upload(recorder, upload);
        }
        if let Some(upload) = &self.environment {
            scene.environment.record_upload(recorder, upload);
        }
    }
}

impl GpuScene {
    /// Allocates all buffers and images, and fills those that the host can write. [`SceneUploads::record`] copies the
    /// other contents.
    ///
    /// # Errors
    /// If memory runs out or the scene exceeds a limit of the device.
    pub fn new(
        layout: &FrameLayout,
        memory: &Memory,
        scene: &Scene,
        pose: &Pose,
        motion: Option<&Motion>,
        alphas: AlphaUse,
    ) -> Result<(Self, SceneUploads), VulkanError> {
        let geometry = &pose.geometry;
        let mut textures = TextureSet::new(memory);
        let looks = pose.materials(scene);
        let slots = looks.iter().map(|material| Slots::of(scene, material)).collect::<Result<Vec<_>, _>>()?;
        let bins = Bins::new(scene, &looks, geometry, &slots, &mut textures)?;
        let triangles = Triangles::new(&looks, geometry, &bins);
        let mut atlas = AlphaAtlas::new(alphas);
        let maps: Vec<_> = looks.iter().map(|m| atlas.place(scene, m)).collect();
        let changing = motion.map(|motion| ChangingLook::new(motion, &slots, &maps));
        let materials = MaterialTable::new(&looks, slots, maps);
        let surroundings = pose.environment(scene);
        let suns = surroundings.map(Environment::suns);
        let suns = suns.into_iter().flat_map(GpuLight::of_suns);
        let lights = pose.lights.iter();
        let lights = lights.map(|light| GpuLight::of_scene(light, geometry.origin));
        // The environment's bright parts follow the scene's lights.
        let lights: Vec<GpuLight> = lights.chain(suns).collect();
        let uint4 = vk::Format::R32G32B32A32_UINT;
        let bins = bins.allocate(layout, &textures)?;
        let mut uploader = Uploader::new(memory);
        let (environment, environment_upload) = GpuEnvironment::new(layout, &mut uploader, surroundings)?;
        let device_geometry = GpuGeometry::new(&mut uploader, scene, geometry, motion, &triangles.words, alphas)?;
        let TextureSet { textures, texture_uploads, samplers, .. } = textures;
        let scene = Self {
            materials: uploader.texels("materials", uint4, &materials.words)?,
            material_vectors: materials.vectors,
            is_tinted: geometry
                .draws
                .iter()
                .filter_map(|draw| looks.get(draw.material as usize))
                .any(|m| m.lobes.transmission.is_some() && !m.unlit),
            changing,
            lights: uploader.storage("lights", bytemuck::cast_slice(&lights))?,
            alpha_atlas: uploader.texels("alpha atlas", vk::Format::R32_UINT, &atlas.words)?,
            environment,
            has_environment: surroundings.is_some(),
            bins,
            first_mask: device_geometry.first_of(DrawClass::Mask),
            first_blend: device_geometry.first_of(DrawClass::Blend),
            geometry: device_geometry,
            high_frequency_triangles: triangles.high_frequency,
            light_features: LightFeatures::of(&pose.lights),
            textures,
            _samplers: samplers.into_iter().map(|(_, sampler)| sampler).collect(),
            memory: memory.clone(),
            uploaded: AtomicBool::new(false),
        };
        let uploads = SceneUploads {
            buffers: uploader.uploads,
            textures: texture_uploads,
            environment: Some(environment_upload),
        };
        Ok((scene, uploads))
    }

    /// Notes that the copies have been executed.
    pub(crate) fn set_uploaded(&self) {
        self.uploaded.store(true, Ordering::Relaxed);
    }

    pub(crate) fn is_uploaded(&self) -> bool {
        self.uploaded.load(Ordering::Relaxed)
    }

    /// Bytes of device memory, including staged uploads that have not been discarded.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        self.memory.used()
    }

    /// Whether a motion moves vertices.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.geometry.is_posed()
    }

    /// Whether the scene has points or lines.
    #[must_use]
    pub fn has_strokes(&self) -> bool {
        self.geometry.strokes.is_some()
    }

    /// Whether a moment belongs to the motion of this scene.
    #[must_use]
    pub fn has_moment(&self, moment: &Moment) -> bool {
        let motion = self.geometry.motion.as_ref();
        motion.is_some_and(|motion| motion.has(moment))
    }

    /// Whether light from behind shines through some surfaces.
    #[must_use]
    pub fn is_backlit(&self) -> bool {
        self.bins.iter().any(|bin| bin.shader.diffuse_transmission)
    }
}

impl Content for GpuScene {
    fn triangle_slots(&self) -> u32 {
        self.geometry.triangle_slots
    }

    fn is_instanced(&self) -> bool {
        self.geometry.is_instanced
    }

    fn has_mask(&self) -> bool {
        self.first_mask < self.first_blend
    }

    fn has_blend(&self) -> bool {
        self.first_blend < self.geometry.triangle_slots
    }

    fn has_high_frequency(&self) -> bool {
        self.high_frequency_triangles > 0
    }

    fn is_tinted(&self) -> bool {
        self.is_tinted
    }

    fn bin_count(&self) -> u32 {
        (self.bins.len() as u32).max(1)
    }
}

//! A posed scene on the device.

use super::FrameLayout;
use super::material::{AlphaAtlas, GpuLight, GpuMaterial, texture_uses};
use super::pool::DescriptorPool;
use super::raster::double_sided;
use super::texture::{DeviceSampler, Texture};
use crate::scene::{
    AlphaMode, DrawClass, Image as SceneImage, LightKind, Material, Pose, Sampler, Scene,
};
use crate::vulkan::{Buffer, BufferView, Memory, MemoryUse, Recorder, VulkanError};
use ash::vk;
use glam::DVec3;
use std::collections::HashMap;

/// What a shading pipeline is specialised for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ShadeFeatures {
    /// Which of the five textures are read, in the order of their bindings.
    pub textures: [bool; 5],
    /// Vertex colours are multiplied in.
    pub vertex_colors: bool,
    /// The base colour is the result.
    pub unlit: bool,
}

/// Materials that are shaded by one dispatch: same pipeline, same textures.
pub(super) struct MaterialBin {
    pub(super) features: ShadeFeatures,
    pub(super) textures: vk::DescriptorSet,
}

/// Neighbouring triangles of one class, drawn at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) class: DrawClass,
    pub(super) first_triangle: u32,
    pub(super) triangle_count: u32,
}

/// Lights of the scene by what shading must compute.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LightFeatures {
    /// Number of lights.
    pub count: u32,
    /// Whether point or spot lights are among them.
    pub local: bool,
}

/// A posed scene on the device.
pub struct GpuScene {
    pub(super) positions: BufferView,
    pub(super) triangles: BufferView,
    pub(super) normals: BufferView,
    pub(super) tangents: BufferView,
    pub(super) uvs: BufferView,
    pub(super) colors: BufferView,
    pub(super) clip: BufferView,
    pub(super) materials: BufferView,
    pub(super) lights: Buffer,
    pub(super) alpha_atlas: BufferView,
    has_glossy: bool,
    pub(super) bins: Vec<MaterialBin>,
    runs: Vec<Run>,
    vertex_count: u32,
    triangle_count: u32,
    first_mask: u32,
    first_blend: u32,
    light_features: LightFeatures,
    origin: DVec3,
    textures: Vec<Texture>,
    _samplers: Vec<DeviceSampler>,
    _pool: Option<DescriptorPool>,
    uploads: Vec<(Buffer, vk::Buffer, u64)>,
}

/// Largest number of materials and of material bins, by the bits of a triangle's last word.
const MATERIAL_LIMIT: u64 = 1 << 16;
const BIN_LIMIT: u64 = 1 << 14;
const GLOSSY_BIT: u32 = 1 << 30;
const DOUBLE_SIDED_BIT: u32 = 1 << 31;

/// A triangle's vertices in their order, beginning with the one whose position comes first. Duplicates of a triangle that
/// begin elsewhere are then computed alike to the bit, and the same one is seen everywhere.
fn first_corner_first(corners: [u32; 3], positions: &[[f32; 3]]) -> [u32; 3] {
    let position = |corner: u32| positions.get(corner as usize).copied().unwrap_or_default();
    let before = |a: u32, b: u32| {
        let pairs = position(a).into_iter().zip(position(b));
        pairs
            .map(|(a, b)| a.total_cmp(&b))
            .find(|order| order.is_ne())
            .is_some_and(std::cmp::Ordering::is_lt)
    };
    let [a, b, c] = corners;
    if before(b, a) && !before(c, b) {
        [b, c, a]
    } else if before(c, a) && before(c, b) {
        [c, a, b]
    } else {
        corners
    }
}

/// Largest roughness at which the light that a surface reflects changes within a pixel.
const GLOSSY_ROUGHNESS: f32 = 0.6;

/// Whether light may change so quickly over a material's surface that one shading point in a pixel is too few.
fn glossy(material: &Material) -> bool {
    let textured =
        material.normal_texture.is_some() || material.metallic_roughness_texture.is_some();
    !material.unlit && (textured || material.roughness < GLOSSY_ROUGHNESS)
}

/// Fills device buffers from the host: directly where the host sees them, else through a copy in the first frame.
struct Uploader<'a> {
    memory: &'a Memory,
    uploads: Vec<(Buffer, vk::Buffer, u64)>,
}

impl Uploader<'_> {
    fn fill(&mut self, name: &str, buffer: &mut Buffer, bytes: &[u8]) -> Result<(), VulkanError> {
        if let Some(mapped) = buffer.bytes_mut().get_mut(..bytes.len()) {
            mapped.copy_from_slice(bytes);
            return Ok(());
        }
        let upload = self.memory.upload(&format!("{name} upload"), bytes)?;
        self.uploads.push((upload, buffer.raw, bytes.len() as u64));
        Ok(())
    }

    fn texels(
        &mut self,
        name: &str,
        format: vk::Format,
        data: &[[u32; 4]],
    ) -> Result<BufferView, VulkanError> {
        let usage = vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER | vk::BufferUsageFlags::TRANSFER_DST;
        let mut view =
            self.memory
                .texel_buffer(name, data.len() as u64, format, usage, MemoryUse::Device)?;
        self.fill(name, &mut view.buffer, bytemuck::cast_slice(data))?;
        Ok(view)
    }

    fn words(&mut self, name: &str, data: &[u32]) -> Result<BufferView, VulkanError> {
        let usage = vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER | vk::BufferUsageFlags::TRANSFER_DST;
        let format = vk::Format::R32_UINT;
        let mut view =
            self.memory
                .texel_buffer(name, data.len() as u64, format, usage, MemoryUse::Device)?;
        self.fill(name, &mut view.buffer, bytemuck::cast_slice(data))?;
        Ok(view)
    }

    fn floats<const N: usize>(
        &mut self,
        name: &str,
        data: &[[f32; N]],
        fill: f32,
    ) -> Result<BufferView, VulkanError> {
        let wide: Vec<[u32; 4]> = data
            .iter()
            .map(|v| std::array::from_fn(|i| v.get(i).copied().unwrap_or(fill).to_bits()))
            .collect();
        self.texels(name, vk::Format::R32G32B32A32_SFLOAT, &wide)
    }

    fn storage(&mut self, name: &str, bytes: &[u8]) -> Result<Buffer, VulkanError> {
        let limit = self.memory.gpu().limits().max_storage_bytes;
        let needed = bytes.len() as u64;
        if needed > limit {
            return Err(VulkanError::TooLarge {
                what: name.to_owned(),
                needed,
                unit: "bytes",
                limit,
            });
        }
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_DST;
        let mut buffer = self.memory.buffer(name, needed, usage, MemoryUse::Device)?;
        self.fill(name, &mut buffer, bytes)?;
        Ok(buffer)
    }
}

impl GpuScene {
    /// Allocates and fills everything; copies that need the device wait for [`GpuScene::record_upload`].
    ///
    /// # Errors
    /// If memory runs out or the scene passes a limit of the device.
    pub fn new(
        layout: &FrameLayout,
        memory: &Memory,
        scene: &Scene,
        pose: &Pose,
    ) -> Result<Self, VulkanError> {
        let geometry = &pose.geometry;
        let mut uploader = Uploader {
            memory,
            uploads: Vec::new(),
        };
        let materials_found = scene.materials.len() as u64;
        if materials_found > MATERIAL_LIMIT {
            return Err(VulkanError::TooLarge {
                what: "the scene".to_owned(),
                needed: materials_found,
                unit: "materials",
                limit: MATERIAL_LIMIT,
            });
        }
        let has_colors = !geometry.streams.colors.is_empty();
        let mut textures = TextureSet::new(memory);
        let (bin_of, keys) = bins(
            scene,
            geometry.draws.iter().map(|draw| draw.material),
            has_colors,
            &mut textures,
        )?;
        let bin_count = keys.len() as u64;
        if bin_count > BIN_LIMIT {
            return Err(VulkanError::TooLarge {
                what: "the scene".to_owned(),
                needed: bin_count,
                unit: "combinations of textures",
                limit: BIN_LIMIT,
            });
        }

        let mut words = vec![0_u32; geometry.triangles.len()];
        let mut runs: Vec<Run> = Vec::new();
        let mut has_glossy = false;
        let is_glossy = |index: u32| scene.materials.get(index as usize).is_some_and(glossy);
        for draw in &geometry.draws {
            let bin = bin_of.get(&draw.material).copied().unwrap_or(0);
            let word = draw.material
                | bin << 16
                | if double_sided(draw.class) {
                    DOUBLE_SIDED_BIT
                } else {
                    0
                }
                | if is_glossy(draw.material) {
                    GLOSSY_BIT
                } else {
                    0
                };
            has_glossy |= is_glossy(draw.material);
            let first = draw.first_triangle as usize;
            words[first..first + draw.triangle_count as usize].fill(word);
            match runs.last_mut() {
                Some(run) if run.class == draw.class => run.triangle_count += draw.triangle_count,
                _ => runs.push(Run {
                    class: draw.class,
                    first_triangle: draw.first_triangle,
                    triangle_count: draw.triangle_count,
                }),
            }
        }
        let triangles: Vec<[u32; 4]> = geometry
            .triangles
            .iter()
            .zip(&words)
            .map(|(&corners, &w)| {
                let [a, b, c] = first_corner_first(corners, &geometry.positions);
                [a, b, c, w]
            })
            .collect();
        let triangle_count = triangles.len() as u32;
        let first_of = |class: DrawClass| {
            runs.iter()
                .find(|run| run.class >= class)
                .map_or(triangle_count, |run| run.first_triangle)
        };

        let mut atlas = AlphaAtlas::new();
        let materials: Vec<GpuMaterial> = scene
            .materials
            .iter()
            .map(|m| GpuMaterial::new(m, atlas.place(scene, m)))
            .collect();
        let lights: Vec<GpuLight> = pose
            .lights
            .iter()
            .map(|light| GpuLight::new(light, geometry.origin))
            .collect();
        // The alpha test reads both streams whether or not the scene has them.
        let has_mask = scene
            .materials
            .iter()
            .any(|m| matches!(m.alpha_mode, AlphaMode::Mask { .. }));
        let filled = |stream: &Vec<[f32; 4]>, value: f32| {
            if stream.is_empty() && has_mask {
                vec![[value; 4]; geometry.positions.len()]
            } else {
                stream.clone()
            }
        };
        let colors = filled(&geometry.streams.colors, 1.0);
        let uvs = filled(&geometry.streams.uvs, 0.0);

        let float4 = vk::Format::R32G32B32A32_SFLOAT;
        let clip_usage =
            vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER | vk::BufferUsageFlags::STORAGE_TEXEL_BUFFER;
        let pool = if keys.is_empty() {
            None
        } else {
            Some(layout.pool(0, keys.len() as u32)?)
        };
        let bins = keys
            .iter()
            .map(|key| {
                let set = pool
                    .as_ref()
                    .map(|pool| pool.allocate(layout.texture_set))
                    .transpose()?
                    .unwrap_or_default();
                textures.write(layout, set, key);
                Ok(MaterialBin {
                    features: key.features,
                    textures: set,
                })
            })
            .collect::<Result<Vec<_>, VulkanError>>()?;
        Ok(Self {
            positions: uploader.floats("positions", &geometry.positions, 1.0)?,
            triangles: uploader.texels("triangles", vk::Format::R32G32B32A32_UINT, &triangles)?,
            normals: uploader.floats("normals", &geometry.streams.normals, 0.0)?,
            tangents: uploader.floats("tangents", &geometry.streams.tangents, 0.0)?,
            uvs: uploader.floats("texture coordinates", &uvs, 0.0)?,
            colors: uploader.floats("vertex colours", &colors, 1.0)?,
            clip: memory.texel_buffer(
                "clip-space vertices",
                geometry.positions.len() as u64,
                float4,
                clip_usage,
                MemoryUse::Device,
            )?,
            materials: uploader.texels(
                "materials",
                vk::Format::R32G32B32A32_UINT,
                bytemuck::cast_slice(&materials),
            )?,
            lights: uploader.storage("lights", bytemuck::cast_slice(&lights))?,
            alpha_atlas: uploader.words("alpha atlas", &atlas.words)?,
            bins,
            vertex_count: geometry.positions.len() as u32,
            triangle_count,
            first_mask: first_of(DrawClass::Mask),
            first_blend: first_of(DrawClass::Blend),
            light_features: LightFeatures {
                count: lights.len() as u32,
                local: pose
                    .lights
                    .iter()
                    .any(|light| light.kind != LightKind::Directional),
            },
            origin: geometry.origin,
            has_glossy,
            runs,
            textures: textures.textures,
            _samplers: textures
                .samplers
                .into_iter()
                .map(|(_, sampler)| sampler)
                .collect(),
            _pool: pool,
            uploads: uploader.uploads,
        })
    }

    /// Records the copies to the device; the first frame does so.
    pub fn record_upload(&self, recorder: &Recorder<'_>) {
        for (upload, target, size) in &self.uploads {
            let region = [vk::BufferCopy::default().size(*size)];
            // SAFETY: the recorder's contract; both buffers hold `size` bytes.
            unsafe {
                recorder
                    .device()
                    .cmd_copy_buffer(recorder.raw(), upload.raw, *target, &region)
            };
        }
        for texture in &self.textures {
            texture.record_upload(recorder);
        }
        recorder.barrier();
    }

    /// Frees what uploads needed, once the first frame is done.
    pub fn discard_uploads(&mut self) {
        self.uploads.clear();
        self.textures.iter_mut().for_each(Texture::discard_upload);
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> u32 {
        self.vertex_count
    }

    /// Number of triangles.
    #[must_use]
    pub fn triangle_count(&self) -> u32 {
        self.triangle_count
    }

    /// Index of the first MASK triangle, or the number of triangles that come before where there is none.
    #[must_use]
    pub fn first_mask(&self) -> u32 {
        self.first_mask
    }

    /// Index of the first BLEND triangle, or the number of triangles.
    #[must_use]
    pub fn first_blend(&self) -> u32 {
        self.first_blend
    }

    /// Whether any triangle is alpha-tested.
    #[must_use]
    pub fn has_mask(&self) -> bool {
        self.first_mask < self.first_blend
    }

    /// Whether any triangle is composited.
    #[must_use]
    pub fn has_blend(&self) -> bool {
        self.first_blend < self.triangle_count
    }

    /// Whether a material asks for several shading points in a pixel.
    #[must_use]
    pub fn has_glossy(&self) -> bool {
        self.has_glossy
    }

    /// Number of material bins, at least 1.
    #[must_use]
    pub fn bin_count(&self) -> u32 {
        (self.bins.len() as u32).max(1)
    }

    /// The scene's lights.
    #[must_use]
    pub fn light_features(&self) -> LightFeatures {
        self.light_features
    }

    /// World position that device positions are relative to.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    pub(super) fn runs(&self) -> &[Run] {
        &self.runs
    }
}

/// What tells one material bin from another: features, and textures by (image, sRGB, sampler).
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct BinKey {
    features: ShadeFeatures,
    textures: [Option<(usize, usize)>; 5],
}

/// Images and samplers made so far.
struct TextureSet<'a> {
    memory: &'a Memory,
    textures: Vec<Texture>,
    known: HashMap<(u32, bool), usize>,
    samplers: Vec<(Sampler, DeviceSampler)>,
    white: Option<usize>,
}

impl<'a> TextureSet<'a> {
    fn new(memory: &'a Memory) -> Self {
        Self {
            memory,
            textures: Vec::new(),
            known: HashMap::new(),
            samplers: Vec::new(),
            white: None,
        }
    }

    /// Indices of image and sampler.
    fn get(
        &mut self,
        scene: &Scene,
        texture: u32,
        srgb: bool,
    ) -> Result<Option<(usize, usize)>, VulkanError> {
        let Some(texture) = scene.textures.get(texture as usize) else {
            return Ok(None);
        };
        let Some(image) = scene.images.get(texture.image as usize) else {
            return Ok(None);
        };
        let index = match self.known.get(&(texture.image, srgb)) {
            Some(index) => *index,
            None => {
                self.textures.push(Texture::new(self.memory, image, srgb)?);
                self.known
                    .insert((texture.image, srgb), self.textures.len() - 1);
                self.textures.len() - 1
            }
        };
        Ok(Some((index, self.sampler(texture.sampler)?)))
    }

    fn sampler(&mut self, sampler: Sampler) -> Result<usize, VulkanError> {
        if let Some(index) = self
            .samplers
            .iter()
            .position(|(known, _)| *known == sampler)
        {
            return Ok(index);
        }
        self.samplers
            .push((sampler, DeviceSampler::new(self.memory.gpu(), &sampler)?));
        Ok(self.samplers.len() - 1)
    }

    /// A texel for bindings that the specialised shader does not read.
    fn unused(&mut self) -> Result<(usize, usize), VulkanError> {
        let index = match self.white {
            Some(index) => index,
            None => {
                let texel = SceneImage {
                    width: 1,
                    height: 1,
                    pixels: vec![255; 4],
                };
                self.textures
                    .push(Texture::new(self.memory, &texel, false)?);
                self.textures.len() - 1
            }
        };
        self.white = Some(index);
        Ok((index, self.sampler(Sampler::default())?))
    }

    fn write(&self, layout: &FrameLayout, set: vk::DescriptorSet, key: &BinKey) {
        let infos: Vec<[vk::DescriptorImageInfo; 1]> = key
            .textures
            .iter()
            .filter_map(|texture| {
                let (image, sampler) = (*texture)?;
                Some([vk::DescriptorImageInfo::default()
                    .image_view(self.textures.get(image)?.image.view)
                    .sampler(self.samplers.get(sampler)?.1.raw)
                    .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)])
            })
            .collect();
        let writes: Vec<_> = infos
            .iter()
            .enumerate()
            .map(|(binding, info)| {
                vk::WriteDescriptorSet::default()
                    .dst_set(set)
                    .dst_binding(binding as u32)
                    .descriptor_type(vk::DescriptorType::COMBINED_IMAGE_SAMPLER)
                    .image_info(info)
            })
            .collect();
        // SAFETY: the set was just allocated; images and samplers live as long as the scene that holds the set.
        unsafe { layout.gpu.device.update_descriptor_sets(&writes, &[]) };
    }
}

/// The bin of each material in use, and what each bin is.
fn bins(
    scene: &Scene,
    used: impl Iterator<Item = u32>,
    has_colors: bool,
    textures: &mut TextureSet<'_>,
) -> Result<(HashMap<u32, u32>, Vec<BinKey>), VulkanError> {
    let mut bin_of = HashMap::new();
    let mut keys: Vec<BinKey> = Vec::new();
    let mut index_of: HashMap<BinKey, u32> = HashMap::new();
    for material_index in used {
        if bin_of.contains_key(&material_index) {
            continue;
        }
        let Some(material) = scene.materials.get(material_index as usize) else {
            continue;
        };
        let key = bin_key(scene, material, has_colors, textures)?;
        let next = keys.len() as u32;
        let bin = *index_of.entry(key).or_insert(next);
        if bin == next {
            keys.push(key);
        }
        bin_of.insert(material_index, bin);
    }
    Ok((bin_of, keys))
}

fn bin_key(
    scene: &Scene,
    material: &Material,
    has_colors: bool,
    textures: &mut TextureSet<'_>,
) -> Result<BinKey, VulkanError> {
    const SRGB: [bool; 5] = [true, false, false, false, true];
    let mut found = [None; 5];
    for (i, used) in texture_uses(material).into_iter().enumerate() {
        let wanted = used.filter(|_| i == 0 || !material.unlit);
        found[i] = match wanted {
            Some(used) => textures.get(scene, used.texture, SRGB[i])?,
            None => None,
        };
    }
    let features = ShadeFeatures {
        textures: found.map(|texture| texture.is_some()),
        vertex_colors: has_colors,
        unlit: material.unlit,
    };
    for texture in &mut found {
        if texture.is_none() {
            *texture = Some(textures.unused()?);
        }
    }
    Ok(BinKey {
        features,
        textures: found,
    })
}

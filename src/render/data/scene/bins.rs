//! Material bins: materials that the same dispatch shades.

use super::slots::{SLOTS, Slots};
use super::texture_set::{TextureIndex, TextureSet};
use crate::engine::pipelines::FrameLayout;
use crate::engine::spirv;
use crate::scene::{Lobes, Material, PosedGeometry, Scene, TextureRole};
use crate::vulkan::{Constants, DescriptorSets, Specialized, VulkanError};
use std::collections::HashMap;
use std::sync::Arc;

/// Shader of a material with these texture slots, without the constants that are the same for the whole scene.
fn shader(material: &Material, slots: &Slots, vertex_colors: bool) -> spirv::Shade {
    use TextureRole as T;
    // Slots are numbered from 16; 0 means no texture.
    let slot = |role: T| slots.of_role[role as usize].map_or(0, |slot| 16 + u32::from(slot));
    let lobes = if material.unlit { Lobes::default() } else { material.lobes };
    spirv::Shade {
        textured: slots.of_role.iter().any(Option::is_some),
        vertex_colors,
        unlit: material.unlit,
        one_uv_transform: slots.one_uv_transform(),
        one_texture_size: slots.one_size,
        specular: lobes.specular.is_some(),
        clearcoat: lobes.clearcoat.is_some(),
        sheen: lobes.sheen.is_some(),
        anisotropy: lobes.anisotropy.is_some(),
        iridescence: lobes.iridescence.is_some(),
        diffuse_transmission: lobes.diffuse_transmission.is_some(),
        transmission: lobes.transmission.is_some(),
        specular_glossiness: lobes.specular_glossiness.is_some(),
        base_color_texture: slot(T::BaseColor),
        metallic_roughness_texture: slot(T::MetallicRoughness),
        normal_texture: slot(T::Normal),
        occlusion_texture: slot(T::Occlusion),
        emissive_texture: slot(T::Emissive),
        specular_texture: slot(T::Specular),
        specular_color_texture: slot(T::SpecularColor),
        clearcoat_texture: slot(T::Clearcoat),
        clearcoat_roughness_texture: slot(T::ClearcoatRoughness),
        clearcoat_normal_texture: slot(T::ClearcoatNormal),
        sheen_color_texture: slot(T::SheenColor),
        sheen_roughness_texture: slot(T::SheenRoughness),
        anisotropy_texture: slot(T::Anisotropy),
        iridescence_texture: slot(T::Iridescence),
        iridescence_thickness_texture: slot(T::IridescenceThickness),
        diffuse_transmission_texture: slot(T::DiffuseTransmission),
        diffuse_transmission_color_texture: slot(T::DiffuseTransmissionColor),
        transmission_texture: slot(T::Transmission),
        thickness_texture: slot(T::Thickness),
        specular_glossiness_texture: slot(T::SpecularGlossiness),
        ..spirv::Shade::default()
    }
}

/// Materials that the same dispatch shades: same pipeline, same textures.
pub(in crate::render) struct MaterialBin {
    /// Shader of the materials, without the constants that are the same for the whole scene.
    pub(in crate::render) shader: spirv::Shade,
    /// Textures with the samplers of the scene.
    pub(in crate::render) textures: Arc<DescriptorSets>,
    /// Textures with samplers for means over footprints.
    pub(in crate::render) averaged_textures: Arc<DescriptorSets>,
}

/// Textures of a material bin.
type BinTextures = [TextureIndex; SLOTS];

/// Largest number of materials, and of material bins: the number of bits that a triangle's last word has for them.
const MATERIAL_LIMIT: usize = 1 << 16;
const BIN_LIMIT: usize = 1 << 14;

/// The bin of each material in use, and the shaders and textures of the bins.
pub(super) struct Bins {
    bin_of: HashMap<u32, u32>,
    bins: Vec<(spirv::Shade, BinTextures)>,
}

impl Bins {
    /// Sorts the materials of all draws into bins, and creates their textures.
    pub(super) fn new(
        scene: &Scene,
        materials: &[Material],
        geometry: &PosedGeometry,
        slots: &[Slots],
        textures: &mut TextureSet<'_>,
    ) -> Result<Self, VulkanError> {
        check(materials.len(), "materials", MATERIAL_LIMIT)?;
        let has_colors = !geometry.streams.colors.is_empty();
        let mut bin_of = HashMap::new();
        let mut bins = Vec::new();
        let mut index_of: HashMap<(Constants, BinTextures), u32> = HashMap::new();
        for draw in &geometry.draws {
            if bin_of.contains_key(&draw.material) {
                continue;
            }
            let index = draw.material as usize;
            let (Some(material), Some(slots)) = (materials.get(index), slots.get(index)) else {
                continue;
            };
            let (shader, textures) = (shader(material, slots, has_colors), textures_of(scene, slots, textures)?);
            let next = bins.len() as u32;
            let bin = *index_of.entry((shader.constants(), textures)).or_insert(next);
            if bin == next {
                bins.push((shader, textures));
            }
            bin_of.insert(draw.material, bin);
        }
        check(bins.len(), "combinations of textures", BIN_LIMIT)?;
        Ok(Self { bin_of, bins })
    }

    /// Index of a material's bin.
    pub(super) fn of(&self, material: u32) -> u32 {
        self.bin_of.get(&material).copied().unwrap_or(0)
    }

    /// Makes the bins, with a descriptor set of textures for each.
    pub(super) fn allocate(
        &self,
        layout: &FrameLayout,
        textures: &TextureSet<'_>,
    ) -> Result<Vec<MaterialBin>, VulkanError> {
        let sets = || layout.own_sets(&[spirv::Shade::INTERFACE], self.bins.len());
        let sets = sets()?.into_iter().zip(sets()?);
        let bin = |((shader, own), (plain, averaged)): (&(spirv::Shade, BinTextures), _)| {
            textures.write(&plain, own, false);
            textures.write(&averaged, own, true);
            MaterialBin { shader: *shader, textures: Arc::new(plain), averaged_textures: Arc::new(averaged) }
        };
        Ok(self.bins.iter().zip(sets).map(bin).collect())
    }
}

fn check(found: usize, unit: &'static str, limit: usize) -> Result<(), VulkanError> {
    VulkanError::check_limit("the scene", found as u64, unit, limit as u64)
}

/// Textures of the slots.
fn textures_of(scene: &Scene, slots: &Slots, textures: &mut TextureSet<'_>) -> Result<BinTextures, VulkanError> {
    let mut all = [textures.unused()?; SLOTS];
    for (index, (used, srgb)) in all.iter_mut().zip(&slots.uses) {
        if let Some(texture) = textures.get(scene, used.texture, *srgb)? {
            *index = texture;
        }
    }
    Ok(all)
}

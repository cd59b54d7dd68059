//! Material bins: materials that the same dispatch shades.

use super::slots::{RoleSlots, SLOTS, Slots};
use super::texture_set::{TextureIndex, TextureSet};
use crate::engine::pipelines::FrameLayout;
use crate::engine::spirv;
use crate::scene::{Material, PosedGeometry, Scene, TextureRole};
use crate::vulkan::{DescriptorSets, Specialized, VulkanError};
use std::collections::HashMap;
use std::sync::Arc;

/// Features for which a shading pipeline is specialised.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(in crate::render) struct ShadeFeatures {
    /// Slot from which each texture is read.
    slots: RoleSlots,
    /// Whether vertex colours are multiplied in.
    vertex_colors: bool,
    /// Whether the base colour is the result.
    unlit: bool,
    /// Whether all textures are read at the same coordinates.
    one_uv_transform: bool,
    /// Whether all textures have the same width and height.
    one_texture_size: bool,
    /// Lobes that are present, in the order of the shader's constants.
    lobes: [bool; 8],
}

impl ShadeFeatures {
    fn new(material: &Material, slots: &Slots, vertex_colors: bool) -> Self {
        let lobes = &material.lobes;
        let lobes = [
            lobes.specular.is_some(),
            lobes.clearcoat.is_some(),
            lobes.sheen.is_some(),
            lobes.anisotropy.is_some(),
            lobes.iridescence.is_some(),
            lobes.diffuse_transmission.is_some(),
            lobes.transmission.is_some(),
            lobes.specular_glossiness.is_some(),
        ];
        Self {
            slots: slots.of_role,
            vertex_colors,
            unlit: material.unlit,
            one_uv_transform: slots.one_uv_transform(),
            one_texture_size: slots.one_size,
            lobes: lobes.map(|lobe| lobe && !material.unlit),
        }
    }

    /// Whether light from behind shines through.
    pub(super) fn is_backlit(&self) -> bool {
        self.lobes[5]
    }

    /// Shader of materials with these features; `common` holds the constants that are the same for the whole scene.
    pub(in crate::render) fn shader(&self, common: spirv::Shade) -> spirv::Shade {
        use TextureRole as T;
        // Slots are numbered from 16; 0 means no texture.
        let slot = |role: T| self.slots[role as usize].map_or(0, |slot| 16 + u32::from(slot));
        let [
            specular,
            clearcoat,
            sheen,
            anisotropy,
            iridescence,
            diffuse_transmission,
            transmission,
            specular_glossiness,
        ] = self.lobes;
        spirv::Shade {
            textured: self.slots.iter().any(Option::is_some),
            vertex_colors: self.vertex_colors,
            unlit: self.unlit,
            one_uv_transform: self.one_uv_transform,
            one_texture_size: self.one_texture_size,
            specular,
            clearcoat,
            sheen,
            anisotropy,
            iridescence,
            diffuse_transmission,
            transmission,
            specular_glossiness,
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
            ..common
        }
    }
}

/// Materials that the same dispatch shades: same pipeline, same textures.
pub(in crate::render) struct MaterialBin {
    pub(in crate::render) features: ShadeFeatures,
    /// Textures with the samplers of the scene.
    pub(in crate::render) textures: Arc<DescriptorSets>,
    /// Textures with samplers for means over footprints.
    pub(in crate::render) averaged_textures: Arc<DescriptorSets>,
}

/// Key of a material bin.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct BinKey {
    features: ShadeFeatures,
    textures: [TextureIndex; SLOTS],
}

/// Largest number of materials, and of material bins: the number of bits that a triangle's last word has for them.
const MATERIAL_LIMIT: usize = 1 << 16;
const BIN_LIMIT: usize = 1 << 14;

/// The bin of each material in use, and the keys of the bins.
pub(super) struct Bins {
    bin_of: HashMap<u32, u32>,
    keys: Vec<BinKey>,
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
        let mut keys: Vec<BinKey> = Vec::new();
        let mut index_of: HashMap<BinKey, u32> = HashMap::new();
        for draw in &geometry.draws {
            if bin_of.contains_key(&draw.material) {
                continue;
            }
            let index = draw.material as usize;
            let (Some(material), Some(slots)) = (materials.get(index), slots.get(index)) else {
                continue;
            };
            let key = BinKey {
                features: ShadeFeatures::new(material, slots, has_colors),
                textures: textures_of(scene, slots, textures)?,
            };
            let next = keys.len() as u32;
            let bin = *index_of.entry(key).or_insert(next);
            if bin == next {
                keys.push(key);
            }
            bin_of.insert(draw.material, bin);
        }
        check(keys.len(), "combinations of textures", BIN_LIMIT)?;
        Ok(Self { bin_of, keys })
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
        let sets = || layout.own_sets(&[spirv::Shade::INTERFACE], self.keys.len());
        let sets = sets()?.into_iter().zip(sets()?);
        let bin = |(key, (plain, averaged)): (&BinKey, _)| {
            textures.write(&plain, &key.textures, false);
            textures.write(&averaged, &key.textures, true);
            MaterialBin { features: key.features, textures: Arc::new(plain), averaged_textures: Arc::new(averaged) }
        };
        Ok(self.keys.iter().zip(sets).map(bin).collect())
    }
}

fn check(found: usize, unit: &'static str, limit: usize) -> Result<(), VulkanError> {
    VulkanError::check_limit("the scene", found as u64, unit, limit as u64)
}

/// Textures of the slots.
fn textures_of(
    scene: &Scene,
    slots: &Slots,
    textures: &mut TextureSet<'_>,
) -> Result<[TextureIndex; SLOTS], VulkanError> {
    let mut all = [textures.unused()?; SLOTS];
    for (index, (used, srgb)) in all.iter_mut().zip(&slots.uses) {
        if let Some(texture) = textures.get(scene, used.texture, *srgb)? {
            *index = texture;
        }
    }
    Ok(all)
}

//! Material bins: materials that are shaded by one dispatch.

use super::material::texture_uses;
use super::texture_set::{TextureIndex, TextureSet};
use crate::passes::FrameLayout;
use crate::passes::pool::DescriptorPool;
use crate::scene::{Geometry, Material, Scene, TextureUse};
use crate::vulkan::VulkanError;
use ash::vk;
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
    /// Occlusion is the red channel of the metallic-roughness texture, and needs no reading of its own.
    pub packed_occlusion: bool,
    /// All textures are read at the same coordinates.
    pub one_uv_transform: bool,
}

/// Materials that are shaded by one dispatch: same pipeline, same textures.
pub(in crate::passes) struct MaterialBin {
    pub(in crate::passes) features: ShadeFeatures,
    pub(in crate::passes) textures: vk::DescriptorSet,
}

/// What tells one material bin from another.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct BinKey {
    features: ShadeFeatures,
    textures: [TextureIndex; 5],
}

/// Largest number of materials and of material bins, by the bits of a triangle's last word.
const MATERIAL_LIMIT: usize = 1 << 16;
const BIN_LIMIT: usize = 1 << 14;

/// Places among the five textures.
const METALLIC_ROUGHNESS: usize = 1;
const OCCLUSION: usize = 3;

/// The bin of each material in use, and what each bin is.
pub(super) struct Bins {
    bin_of: HashMap<u32, u32>,
    keys: Vec<BinKey>,
}

impl Bins {
    /// Sorts the materials of all draws into bins, and makes their textures.
    pub(super) fn new(
        scene: &Scene,
        geometry: &Geometry,
        textures: &mut TextureSet<'_>,
    ) -> Result<Self, VulkanError> {
        check(scene.materials.len(), "materials", MATERIAL_LIMIT)?;
        let has_colors = !geometry.streams.colors.is_empty();
        let mut bin_of = HashMap::new();
        let mut keys: Vec<BinKey> = Vec::new();
        let mut index_of: HashMap<BinKey, u32> = HashMap::new();
        for draw in &geometry.draws {
            if bin_of.contains_key(&draw.material) {
                continue;
            }
            let Some(material) = scene.materials.get(draw.material as usize) else {
                continue;
            };
            let key = bin_key(scene, material, has_colors, textures)?;
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

    /// The bins, with descriptor sets of a pool of their own where there are any.
    pub(super) fn allocate(
        &self,
        layout: &FrameLayout,
        textures: &TextureSet<'_>,
    ) -> Result<(Vec<MaterialBin>, Option<DescriptorPool>), VulkanError> {
        if self.keys.is_empty() {
            return Ok((Vec::new(), None));
        }
        let pool = layout.pool(0, self.keys.len() as u32)?;
        let bins = self
            .keys
            .iter()
            .map(|key| {
                let set = pool.allocate(layout.texture_set)?;
                textures.write(layout, set, &key.textures);
                Ok(MaterialBin {
                    features: key.features,
                    textures: set,
                })
            })
            .collect::<Result<_, VulkanError>>()?;
        Ok((bins, Some(pool)))
    }
}

fn check(found: usize, unit: &'static str, limit: usize) -> Result<(), VulkanError> {
    VulkanError::check_limit("the scene", found as u64, unit, limit as u64)
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
    let place = |used: Option<TextureUse>| used.map(|used| (used.uv_set, used.transform));
    let places = texture_uses(material).map(place);
    let packed_occlusion = found[OCCLUSION].is_some()
        && found[OCCLUSION] == found[METALLIC_ROUGHNESS]
        && places[OCCLUSION] == places[METALLIC_ROUGHNESS];
    if packed_occlusion {
        found[OCCLUSION] = None;
    }
    let features = ShadeFeatures {
        textures: found.map(|texture| texture.is_some()),
        vertex_colors: has_colors,
        unlit: material.unlit,
        packed_occlusion,
        one_uv_transform: places[0].is_some()
            && places
                .iter()
                .flatten()
                .all(|place| places[0] == Some(*place)),
    };
    let mut textures_of = [TextureIndex::default(); 5];
    for (index, found) in textures_of.iter_mut().zip(found) {
        *index = match found {
            Some(texture) => texture,
            None => textures.unused()?,
        };
    }
    Ok(BinKey {
        features,
        textures: textures_of,
    })
}

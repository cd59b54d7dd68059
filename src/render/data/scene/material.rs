//! Materials in the form that shaders read: see `shaders/include/material.glsl`.

use super::slots::Slots;
use crate::engine::spirv;
use crate::scene::{AlphaMode, Lobes, Material, TextureRole, TextureUse};

/// Number of vectors of a material before those for texture coordinates.
const FIXED: usize = spirv::MATERIAL_UV_ROWS as usize;

/// Data of a material's row in the table that the material itself does not hold.
pub(super) struct MaterialRow {
    pub(super) slots: Slots,
    /// Place of the material's alpha texture in the alpha atlas.
    pub(super) alpha: [u32; 4],
}

impl MaterialRow {
    /// The vectors of a material with these slots.
    pub(super) fn words(&self, material: &Material) -> Vec<[u32; 4]> {
        let mut words = fixed_vectors(material, self.alpha).to_vec();
        let textures: Vec<_> = material.textures().collect();
        for slot in 0..self.slots.uses.len() {
            let reads = |(role, _): &&(TextureRole, TextureUse)| {
                self.slots.of_role[*role as usize].map(usize::from) == Some(slot)
            };
            if let Some((_, used)) = textures.iter().find(reads) {
                let [u, v] = used.transform.0;
                words.push([u[0], u[1], u[2], used.uv_set as f32].map(f32::to_bits));
                words.push([v[0], v[1], v[2], 0.0].map(f32::to_bits));
            }
        }
        words
    }
}

/// The vectors of all materials.
pub(super) struct MaterialTable {
    pub(super) words: Vec<[u32; 4]>,
    /// Number of vectors of each material.
    pub(super) vectors: u32,
}

impl MaterialTable {
    /// Makes the table of materials from their slots and their places in the alpha atlas.
    pub(super) fn new(materials: &[Material], slots: Vec<Slots>, alphas: Vec<[u32; 4]>) -> Self {
        let most = slots.iter().map(|slots| slots.uses.len()).max();
        // The alpha test reads the first coordinates even of untextured materials.
        let vectors = FIXED + 2 * most.unwrap_or(0).max(1);
        let mut words = Vec::with_capacity(materials.len() * vectors);
        for ((material, slots), alpha) in materials.iter().zip(slots).zip(alphas) {
            words.extend(MaterialRow { slots, alpha }.words(material));
            words.resize(words.len().next_multiple_of(vectors), [0; 4]);
        }
        Self { words, vectors: vectors as u32 }
    }
}

/// Vector of three colour components and a fourth number.
fn vector([r, g, b]: [f32; 3], w: f32) -> [f32; 4] {
    [r, g, b, w]
}

/// The first vectors of a material, without those for texture coordinates.
fn fixed_vectors(material: &Material, alpha: [u32; 4]) -> [[u32; 4]; FIXED] {
    // The value with which alpha is compared; the alpha of a BLEND material is an opacity.
    let cutoff = match material.alpha_mode {
        AlphaMode::Opaque => 0.0,
        AlphaMode::Mask { cutoff } => cutoff,
        AlphaMode::Blend => -1.0,
    };
    let factors = [material.roughness, material.normal_scale, material.occlusion_strength, cutoff];
    let Lobes {
        specular,
        clearcoat,
        sheen,
        anisotropy,
        iridescence,
        diffuse_transmission,
        transmission,
        specular_glossiness,
    } = &material.lobes;
    let mut vectors = [[0; 4]; FIXED];
    vectors[spirv::MATERIAL_ALPHA as usize] = alpha;
    let mut set = |vector: u32, values: [f32; 4]| {
        vectors[vector as usize] = values.map(f32::to_bits);
    };
    set(spirv::MATERIAL_BASE_COLOR, material.base_color);
    let emissive_metallic = vector(material.emissive, material.metallic);
    set(spirv::MATERIAL_EMISSIVE_METALLIC, emissive_metallic);
    set(spirv::MATERIAL_FACTORS, factors);
    if let Some(lobe) = specular {
        let color = lobe.color.map(|x| x * lobe.reflectance);
        set(spirv::MATERIAL_SPECULAR, vector(color, lobe.factor));
    }
    if let Some(lobe) = clearcoat {
        let values = [lobe.factor, lobe.roughness, lobe.normal_scale, 0.0];
        set(spirv::MATERIAL_CLEARCOAT, values);
    }
    if let Some(lobe) = sheen {
        set(spirv::MATERIAL_SHEEN, vector(lobe.color, lobe.roughness));
    }
    if let Some(lobe) = anisotropy {
        let (sin, cos) = lobe.rotation.sin_cos();
        set(spirv::MATERIAL_ANISOTROPY, [lobe.strength, cos, sin, 0.0]);
    }
    if let Some(lobe) = iridescence {
        let [least, greatest] = lobe.thickness;
        let values = [lobe.factor, lobe.ior, least, greatest];
        set(spirv::MATERIAL_IRIDESCENCE, values);
    }
    if let Some(lobe) = diffuse_transmission {
        let values = vector(lobe.color, lobe.factor);
        set(spirv::MATERIAL_DIFFUSE_TRANSMISSION, values);
    }
    if let Some(lobe) = transmission {
        let values = [lobe.factor, lobe.thickness, 0.0, 0.0];
        set(spirv::MATERIAL_TRANSMISSION, values);
        set(spirv::MATERIAL_VOLUME, vector(lobe.absorption, 0.0));
    }
    if let Some(lobe) = specular_glossiness {
        let values = vector(lobe.specular, lobe.glossiness);
        set(spirv::MATERIAL_SPECULAR_GLOSSINESS, values);
    }
    vectors
}

/// Largest roughness at which the reflection of an untextured surface can change noticeably within a pixel.
const GLOSSY_ROUGHNESS: f32 = 0.6;

/// Whether light or colour may change within a pixel on the material's surface, so that one shading for each pixel is
/// not enough: the material is textured or glossy, or an animation may make it so.
pub(super) fn high_frequency(material: &Material) -> bool {
    let may_be_glossy = material.animated || is_glossy(material);
    material.textures().next().is_some() || (!material.unlit && may_be_glossy)
}

fn is_glossy(material: &Material) -> bool {
    let Lobes { clearcoat, iridescence, specular_glossiness, .. } = &material.lobes;
    let base = specular_glossiness.map_or(material.roughness, |base| 1.0 - base.glossiness);
    let coat = clearcoat.map_or(1.0, |coat| coat.roughness);
    base.min(coat) < GLOSSY_ROUGHNESS || iridescence.is_some()
}

//! Materials in the form that shaders read.

use super::slots::Slots;
use crate::scene::{AlphaMode, Lobes, Material, TextureRole, TextureUse};

/// Number of vectors of a material before those for texture coordinates.
const FIXED: usize = 13;

/// The first vectors of a material in `shaders/include/material.glsl`, without those for texture coordinates.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct GpuMaterial {
    base_color: [f32; 4],
    emissive_metallic: [f32; 4],
    roughness_normal_occlusion_cutoff: [f32; 4],
    alpha: [u32; 4],
    specular: [f32; 4],
    clearcoat: [f32; 4],
    sheen: [f32; 4],
    anisotropy: [f32; 4],
    iridescence: [f32; 4],
    diffuse_transmission: [f32; 4],
    transmission: [f32; 4],
    volume: [f32; 4],
    specular_glossiness: [f32; 4],
}

/// Data of a material's row in the table that the material itself does not hold.
pub(super) struct MaterialRow {
    pub(super) slots: Slots,
    /// Place of the material's alpha texture in the alpha atlas.
    pub(super) alpha: [u32; 4],
}

impl MaterialRow {
    /// The vectors of a material with these slots.
    pub(super) fn words(&self, material: &Material) -> Vec<[u32; 4]> {
        let fixed = GpuMaterial::new(material, self.alpha);
        let mut words = bytemuck::cast_slice::<_, [u32; 4]>(&[fixed]).to_vec();
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
        Self {
            words,
            vectors: vectors as u32,
        }
    }
}

/// Vector of three colour components and a fourth number.
fn vector([r, g, b]: [f32; 3], w: f32) -> [f32; 4] {
    [r, g, b, w]
}

impl GpuMaterial {
    fn new(material: &Material, alpha: [u32; 4]) -> Self {
        // The value with which alpha is compared; the alpha of a BLEND material is an opacity.
        let cutoff = match material.alpha_mode {
            AlphaMode::Opaque => 0.0,
            AlphaMode::Mask { cutoff } => cutoff,
            AlphaMode::Blend => -1.0,
        };
        let lobes = &material.lobes;
        Self {
            base_color: material.base_color,
            emissive_metallic: vector(material.emissive, material.metallic),
            roughness_normal_occlusion_cutoff: [
                material.roughness,
                material.normal_scale,
                material.occlusion_strength,
                cutoff,
            ],
            alpha,
            specular: lobes.specular.map_or([0.0; 4], |lobe| {
                vector(lobe.color.map(|x| x * lobe.reflectance), lobe.factor)
            }),
            clearcoat: lobes.clearcoat.map_or([0.0; 4], |lobe| {
                [lobe.factor, lobe.roughness, lobe.normal_scale, 0.0]
            }),
            sheen: lobes
                .sheen
                .map_or([0.0; 4], |lobe| vector(lobe.color, lobe.roughness)),
            anisotropy: lobes.anisotropy.map_or([0.0; 4], |lobe| {
                let (sin, cos) = lobe.rotation.sin_cos();
                [lobe.strength, cos, sin, 0.0]
            }),
            iridescence: lobes.iridescence.map_or([0.0; 4], |lobe| {
                [lobe.factor, lobe.ior, lobe.thickness[0], lobe.thickness[1]]
            }),
            diffuse_transmission: lobes
                .diffuse_transmission
                .map_or([0.0; 4], |lobe| vector(lobe.color, lobe.factor)),
            transmission: lobes
                .transmission
                .map_or([0.0; 4], |lobe| [lobe.factor, lobe.thickness, 0.0, 0.0]),
            volume: lobes
                .transmission
                .map_or([0.0; 4], |lobe| vector(lobe.absorption, 0.0)),
            specular_glossiness: lobes
                .specular_glossiness
                .map_or([0.0; 4], |lobe| vector(lobe.specular, lobe.glossiness)),
        }
    }
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
    let Lobes {
        clearcoat,
        iridescence,
        specular_glossiness,
        ..
    } = &material.lobes;
    let base = specular_glossiness.map_or(material.roughness, |base| 1.0 - base.glossiness);
    let coat = clearcoat.map_or(1.0, |coat| coat.roughness);
    base.min(coat) < GLOSSY_ROUGHNESS || iridescence.is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::passes::spirv;

    #[test]
    fn the_material_is_the_shaders() {
        let offset = |vector: u32| 16 * vector as usize;
        macro_rules! check {
            ($($field:ident $vector:ident,)*) => {
                $(assert_eq!(std::mem::offset_of!(GpuMaterial, $field), offset(spirv::$vector));)*
            };
        }
        check! {
            base_color MATERIAL_BASE_COLOR,
            emissive_metallic MATERIAL_EMISSIVE_METALLIC,
            roughness_normal_occlusion_cutoff MATERIAL_FACTORS,
            alpha MATERIAL_ALPHA,
            specular MATERIAL_SPECULAR,
            clearcoat MATERIAL_CLEARCOAT,
            sheen MATERIAL_SHEEN,
            anisotropy MATERIAL_ANISOTROPY,
            iridescence MATERIAL_IRIDESCENCE,
            diffuse_transmission MATERIAL_DIFFUSE_TRANSMISSION,
            transmission MATERIAL_TRANSMISSION,
            volume MATERIAL_VOLUME,
            specular_glossiness MATERIAL_SPECULAR_GLOSSINESS,
        }
        assert_eq!(size_of::<GpuMaterial>(), offset(spirv::MATERIAL_UV_ROWS));
        assert_eq!(size_of::<GpuMaterial>(), 16 * FIXED);
    }
}

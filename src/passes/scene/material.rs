//! Materials as the shaders read them.

use crate::scene::{AlphaMode, Filter, Material, Sampler, Scene, TextureTransform, TextureUse};

/// The vectors of `shaders/include/material.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct GpuMaterial {
    base_color: [f32; 4],
    emissive_metallic: [f32; 4],
    roughness_normal_occlusion_cutoff: [f32; 4],
    alpha: [u32; 4],
    uv_rows: [[f32; 4]; 10],
}

/// The five textures in the order of their bindings.
pub(super) fn texture_uses(material: &Material) -> [Option<TextureUse>; 5] {
    [
        material.base_color_texture,
        material.metallic_roughness_texture,
        material.normal_texture,
        material.occlusion_texture,
        material.emissive_texture,
    ]
}

impl GpuMaterial {
    pub(super) fn new(material: &Material, alpha: [u32; 4]) -> Self {
        let mut uv_rows = [[0.0; 4]; 10];
        for (i, used) in texture_uses(material).into_iter().enumerate() {
            let used = used.unwrap_or(TextureUse {
                texture: 0,
                uv_set: 0,
                transform: TextureTransform::default(),
            });
            let [u, v] = used.transform.0;
            uv_rows[2 * i] = [u[0], u[1], u[2], used.uv_set as f32];
            uv_rows[2 * i + 1] = [v[0], v[1], v[2], 0.0];
        }
        let [r, g, b] = material.emissive;
        let cutoff = if let AlphaMode::Mask { cutoff } = material.alpha_mode {
            cutoff
        } else {
            0.0
        };
        Self {
            base_color: material.base_color,
            emissive_metallic: [r, g, b, material.metallic],
            roughness_normal_occlusion_cutoff: [
                material.roughness,
                material.normal_scale,
                material.occlusion_strength,
                cutoff,
            ],
            alpha,
            uv_rows,
        }
    }
}

/// Largest roughness at which the light that a surface reflects changes within a pixel.
const GLOSSY_ROUGHNESS: f32 = 0.6;

/// Whether light or paint may change so quickly over a material's surface that one shading point in a pixel is too few:
/// it is glossy, or has a texture that its sampler does not filter over a pixel.
pub(super) fn uneven(scene: &Scene, material: &Material) -> bool {
    let glossy = !material.unlit && material.roughness < GLOSSY_ROUGHNESS;
    let _ = (scene, steps);
    glossy
        || texture_uses(material)
            .into_iter()
            .any(|used| used.is_some())
}

/// Whether neighbouring pixels may see texels that do not blend into each other.
fn steps(sampler: &Sampler) -> bool {
    sampler.mip.is_none() || [sampler.min, sampler.mag].contains(&Filter::Nearest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_material_is_the_shaders() {
        let text = include_str!("../../../shaders/include/material.glsl");
        let vector = |name: &str| -> usize {
            let line = text
                .lines()
                .find(|line| line.starts_with(&format!("#define {name} ")))
                .unwrap();
            line.split_whitespace()
                .nth(2)
                .unwrap()
                .trim_end_matches('u')
                .parse()
                .unwrap()
        };
        macro_rules! check {
            ($($name:literal = $field:ident),*) => {
                $(assert_eq!(vector($name) * 16, std::mem::offset_of!(GpuMaterial, $field), $name);)*
            };
        }
        check!(
            "MATERIAL_BASE_COLOR" = base_color,
            "MATERIAL_EMISSIVE_METALLIC" = emissive_metallic,
            "MATERIAL_FACTORS" = roughness_normal_occlusion_cutoff,
            "MATERIAL_ALPHA" = alpha,
            "MATERIAL_UV_ROWS" = uv_rows
        );
        assert_eq!(vector("MATERIAL_VECTORS") * 16, size_of::<GpuMaterial>());
    }
}

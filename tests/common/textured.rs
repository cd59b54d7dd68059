//! A material for stages with a texture.

use gpc::scene::{AlphaMode, Material, TextureTransform, TextureUse};

/// Unlit material with the stage's texture, visible from both sides.
pub fn textured(alpha_mode: AlphaMode) -> Material {
    Material {
        base_color_texture: Some(TextureUse { texture: 0, uv_set: 0, transform: TextureTransform::default() }),
        alpha_mode,
        unlit: true,
        double_sided: true,
        ..Material::default()
    }
}

//! Stripped scenes: one without light and one without paint. The one that keeps an error tells its cause.

use gpc::color::srgb;
use gpc::scene::{AlphaMode, Image, Material, Scene, Texture};

/// Part of a scene's appearance that a stripped scene keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stripped {
    /// Paint alone: every material is unlit and has its base colour, from factor, texture and vertices.
    Paint,
    /// Light alone: every base colour texture is replaced by its mean colour and keeps its alpha. All other textures
    /// stay, emissive ones too.
    Light,
}

impl Stripped {
    /// Copy of a scene that keeps only this part. Poses of the scene are valid for the copy too.
    pub fn of(self, scene: &Scene) -> Scene {
        let mut stripped = scene.clone();
        match self {
            Self::Paint => {
                for material in &mut stripped.materials {
                    material.unlit = true;
                }
            }
            Self::Light => {
                for index in 0..stripped.materials.len() {
                    flatten(&mut stripped, index);
                }
            }
        }
        stripped
    }
}

/// Replaces the colours of a material's base colour texture by their mean.
fn flatten(scene: &mut Scene, index: usize) {
    let Some(material) = scene.materials.get_mut(index) else {
        return;
    };
    let Some(mut read) = material.base_color_texture.take() else {
        return;
    };
    let Some(texture) = scene.textures.get(read.texture as usize).copied() else {
        return;
    };
    let Some(image) = scene.images.get(texture.image as usize) else {
        return;
    };
    tint(material, mean(image, material.alpha_mode));
    if material.alpha_mode == AlphaMode::Opaque {
        return;
    }
    // Alpha stays, so that cut-outs do.
    let mut white = image.clone();
    for pixel in white.pixels.as_chunks_mut::<4>().0 {
        pixel[..3].fill(255);
    }
    read.texture = scene.textures.len() as u32;
    material.base_color_texture = Some(read);
    scene.textures.push(Texture { image: scene.images.len() as u32, ..texture });
    scene.images.push(white);
}

fn tint(material: &mut Material, color: [f64; 3]) {
    for (factor, mean) in material.base_color.iter_mut().zip(color) {
        *factor *= mean as f32;
    }
}

/// Mean colour of an image in linear light, weighted by alpha unless `alpha_mode` is opaque; white if the image is
/// transparent everywhere.
fn mean(image: &Image, alpha_mode: AlphaMode) -> [f64; 3] {
    let linear: Vec<f64> = (0..=255).map(|code| srgb::decode(f64::from(code) / 255.0)).collect();
    let (mut sum, mut weights) = ([0.0; 3], 0.0);
    let full = image.levels().next().unwrap_or_default();
    for [r, g, b, a] in full.as_chunks::<4>().0 {
        let weight = match alpha_mode {
            AlphaMode::Opaque => 1.0,
            AlphaMode::Mask { .. } | AlphaMode::Blend => f64::from(*a),
        };
        for (sum, code) in sum.iter_mut().zip([r, g, b]) {
            *sum += weight * linear.get(usize::from(*code)).copied().unwrap_or_default();
        }
        weights += weight;
    }
    if weights > 0.0 { sum.map(|sum| sum / weights) } else { [1.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::scene::{Sampler, TextureTransform, TextureUse};

    fn painted(alpha_mode: AlphaMode) -> Scene {
        let mut scene = Scene::from_materials(vec![Material {
            base_color: [0.5, 1.0, 1.0, 1.0],
            base_color_texture: Some(TextureUse { texture: 0, uv_set: 0, transform: TextureTransform::default() }),
            alpha_mode,
            ..Material::default()
        }]);
        scene.images = vec![Image { width: 2, height: 1, pixels: vec![255, 0, 0, 255, 0, 255, 0, 0] }];
        scene.textures = vec![Texture { image: 0, sampler: Sampler::default() }];
        scene
    }

    #[test]
    fn paint_is_unlit_and_keeps_its_textures() {
        let scene = painted(AlphaMode::Opaque);
        let paint = Stripped::Paint.of(&scene);
        assert!(paint.materials.iter().all(|material| material.unlit));
        let uses = |scene: &Scene| scene.materials[0].base_color_texture;
        assert_eq!(uses(&paint), uses(&scene));
    }

    #[test]
    fn light_has_the_mean_colour_of_what_shows() {
        let light = Stripped::Light.of(&painted(AlphaMode::Opaque));
        assert_eq!(light.materials[0].base_color_texture, None);
        assert_eq!(light.materials[0].base_color, [0.25, 0.5, 0.0, 1.0]);

        let light = Stripped::Light.of(&painted(AlphaMode::Mask { cutoff: 0.5 }));
        assert_eq!(light.materials[0].base_color, [0.5, 0.0, 0.0, 1.0]);
        let texture = light.materials[0].base_color_texture.unwrap().texture;
        let image = light.textures[texture as usize].image;
        let expected = [255, 255, 255, 255, 255, 255, 255, 0];
        assert_eq!(light.images[image as usize].pixels, expected);
    }
}

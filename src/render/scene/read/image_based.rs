//! Environments of a file (`EXT_lights_image_based`). An environment that can't be used is left out with a warning.

use std::{collections::BTreeMap, sync::Arc};

use glam::DQuat;
use gltf::json::{self, Index};
use serde::Deserialize;

use super::{Context, image::DecodedImages, model};
use crate::color::srgb;
use crate::scene::{environment::Environment, error::Fault, material::Image};

const NAME: &str = "EXT_lights_image_based";
/// Largest side of a face in texels, which every device supports.
const MAX_SIDE: u32 = 4096;

/// A light of the extension.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct LightObject {
    rotation: Option<[f64; 4]>,
    intensity: Option<f32>,
    irradiance_coefficients: [[f32; 3]; 9],
    specular_image_size: u32,
    specular_images: Vec<[Index<json::Image>; 6]>,
}

/// Reference of a scene to a light.
#[derive(Deserialize)]
struct LightReference {
    light: usize,
}

/// Environment of each scene, if it has one.
pub fn read_all(context: &mut Context<'_>) -> Vec<Option<Arc<Environment>>> {
    let mut known = BTreeMap::new();
    let scenes = context.model.root.scenes.iter().enumerate();
    let lights = scenes.map(|(index, scene)| {
        let others = scene.extensions.as_ref().map(|extensions| &extensions.others);
        let place = format!("/scenes/{index}");
        let chosen = model::extension::<LightReference>(others, NAME, &place);
        let chosen = context.tolerate(chosen, "the scene has the light of the studio");
        let (LightReference { light }, place) = chosen?;
        let read = known.entry(light).or_insert_with(|| {
            let read = read(light, &format!("{place}/light"), context).map(Some);
            context.tolerate(read, "the light is left out").map(Arc::new)
        });
        read.clone()
    });
    lights.collect()
}

/// Reads the light at `index`; `from` is the place of a reference to it.
fn read(index: usize, from: &str, context: &mut Context<'_>) -> Result<Environment, Fault> {
    let place = format!("/extensions/{NAME}/lights/{index}");
    let value = context.model.at(&place).ok_or_else(|| {
        let reason = format!("refers to light {index}, which the document does not have");
        Fault::new(from, reason)
    })?;
    let item: LightObject = model::typed(value, &place)?;
    let size = item.specular_image_size;
    let levels = item.specular_images.len();
    if size > MAX_SIDE {
        let reason = format!("a cube of {size} texels a side is larger than {MAX_SIDE}");
        return Err(Fault::new(place, reason));
    }
    if !size.is_power_of_two() || levels == 0 || levels > size.ilog2() as usize + 1 {
        let reason = format!("a cube of {size} texels a side does not have {levels} levels");
        return Err(Fault::new(place, reason));
    }
    let rotation = item.rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
    let rotation = rotation.is_finite().then(|| rotation.normalize());
    let rotation = rotation.filter(|rotation| rotation.is_finite());
    let intensity = item.intensity.unwrap_or(1.0);
    let (Some(rotation), true) = (rotation, intensity.is_finite() && intensity >= 0.0) else {
        let reason = "the rotation has no direction, or the intensity is negative";
        return Err(Fault::new(place, reason));
    };

    for (level, faces) in item.specular_images.iter().enumerate() {
        for (face, image) in faces.iter().enumerate() {
            let place = format!("{place}/specularImages/{level}/{face}");
            context.model.check(image, &place)?;
        }
    }
    let mut images = DecodedImages::default();
    let all = item.specular_images.as_flattened();
    images.decode(context, all.iter().map(Index::value));
    let places: Vec<_> = all.iter().map(|i| images.place(i.value())).collect();
    let decoded = images.into_decoded();
    let mut cubes = Vec::new();
    for (level, faces) in places.chunks(6).enumerate() {
        let side = size >> level;
        let mut texels = Vec::new();
        for (face, image) in faces.iter().enumerate() {
            let image = image.and_then(|image| decoded.get(image as usize));
            let fits = |image: &&Image| image.width == side && image.height == side;
            let image = image.filter(fits).ok_or_else(|| {
                let place = format!("{place}/specularImages/{level}/{face}");
                Fault::new(place, format!("is no image of {side} x {side} texels"))
            })?;
            let own = image.levels().next().unwrap_or_default();
            texels.extend(own.chunks_exact(4).map(|texel| radiance(texel, intensity)));
        }
        cubes.push((side, texels));
    }
    // The file's coefficients are those of the irradiance, which has to be divided by pi.
    let irradiance = item.irradiance_coefficients.map(|color| color.map(|x| x * intensity / std::f32::consts::PI));
    Ok(Environment::from_levels(cubes, irradiance, rotation))
}

/// Radiance of an RGBD texel: an sRGB colour divided by alpha; a missing alpha is 1.
fn radiance(texel: &[u8], intensity: f32) -> [f32; 3] {
    let [r, g, b, a] = [0, 1, 2, 3].map(|channel| texel.get(channel).copied().unwrap_or(u8::MAX));
    let divisor = f32::from(a.max(1)) / 255.0;
    [r, g, b].map(|code| srgb::decode_u8(code) as f32 * intensity / divisor)
}

//! `KHR_animation_pointer`: spheres whose colour, roughness, coat, glow and texture change, under a lamp that changes
//! too.

use super::glb::{Builder, Placement, linear};
use super::mesh::globe;
use super::picture::paint;
use glam::dvec3;
use serde_json::{Value, json};

pub fn build() -> Vec<u8> {
    let mut file = Builder::default();
    let stripes = file.texture(
        &paint(32, |x, _| match (8.0 * x) as u32 % 2 {
            0 => [240, 190, 40, 255],
            _ => [40, 60, 140, 255],
        }),
        true,
    );
    let [r, g, b] = [170, 30, 36].map(linear);
    let plain = |roughness: f64, metallic: f64| -> Value {
        json!({
            "baseColorFactor": [r, g, b, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness,
        })
    };
    let materials = [
        json!({ "pbrMetallicRoughness": plain(0.6, 0.0) }),
        json!({ "pbrMetallicRoughness": plain(0.9, 1.0) }),
        json!({
            "pbrMetallicRoughness": plain(0.9, 0.0),
            "extensions": { "KHR_materials_clearcoat": { "clearcoatRoughnessFactor": 0.05 } },
        }),
        json!({
            "pbrMetallicRoughness": plain(0.9, 0.0), "emissiveFactor": [1.0, 0.6, 0.2],
            "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 0.0 } },
        }),
        json!({ "pbrMetallicRoughness": {
            "metallicFactor": 0.0, "roughnessFactor": 0.8, "baseColorTexture": { "index": stripes },
        } }),
    ];
    let ball = file.surface(&globe(32, 18));
    let count = materials.len();
    for (index, material) in materials.into_iter().enumerate() {
        let material = file.material(material);
        let mesh = file.mesh(&[(ball, material)]);
        let x = 2.2 * (index as f64 - (count - 1) as f64 / 2.0);
        file.place(mesh, Placement::at(dvec3(x, 1.0, 0.0)));
    }
    file.sun("sun", dvec3(-0.4, -0.7, -0.6), [1.0, 1.0, 1.0], 3.0);
    file.perspective("front", dvec3(0.0, 2.6, 13.5), dvec3(0.0, 0.9, 0.0), 27.0);
    let light = "/extensions/KHR_lights_punctual/lights/0";
    let there_and_back = |first: &[f32], middle: &[f32]| [first, middle, first].map(<[f32]>::to_vec);
    let base = "pbrMetallicRoughness";
    let red = [r, g, b, 1.0].map(|x| x as f32);
    let channels = [
        (format!("/materials/0/{base}/baseColorFactor"), there_and_back(&red, &[0.05, 0.3, 0.6, 1.0])),
        (format!("/materials/1/{base}/roughnessFactor"), there_and_back(&[0.9], &[0.1])),
        ("/materials/2/extensions/KHR_materials_clearcoat/clearcoatFactor".to_owned(), there_and_back(&[0.0], &[1.0])),
        (
            "/materials/3/extensions/KHR_materials_emissive_strength/emissiveStrength".to_owned(),
            there_and_back(&[0.0], &[3.0]),
        ),
        (
            format!("/materials/4/{base}/baseColorTexture/extensions/KHR_texture_transform/rotation"),
            there_and_back(&[0.0], &[1.2]),
        ),
        (
            format!("/materials/4/{base}/baseColorTexture/extensions/KHR_texture_transform/scale"),
            there_and_back(&[1.0, 1.0], &[2.0, 2.0]),
        ),
        (format!("{light}/color"), there_and_back(&[1.0; 3], &[0.6, 0.8, 1.0])),
        (format!("{light}/intensity"), there_and_back(&[3.0], &[1.5])),
        ("/cameras/0/perspective/yfov".to_owned(), there_and_back(&[0.471_239], &[0.4])),
    ];
    file.animate("changes", &channels);
    file.finish("Animation pointers")
}

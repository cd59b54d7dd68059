//! `EXT_lights_image_based`: spheres of metal and of paint with increasing roughness, under a sky with a sun and above
//! a warm ground.

use super::glb::{Builder, Placement, linear};
use super::mesh::globe;
use super::picture::paint;
use glam::{DQuat, DVec3, dvec3};
use serde_json::json;
use std::f64::consts::PI;

const COUNT: usize = 5;
/// Texels along the side of a face of the finest level.
const SIDE: u32 = 32;
const LEVELS: u32 = 4;

pub fn build() -> Vec<u8> {
    let mut file = Builder::default();
    let ball = file.surface(&globe(32, 18));
    for (row, (metallic, color)) in [(1.0, [230, 226, 220]), (0.0, [190, 60, 50])].into_iter().enumerate() {
        for index in 0..COUNT {
            let [r, g, b] = color.map(linear);
            let material = file.material(json!({ "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 1.0], "metallicFactor": metallic,
                "roughnessFactor": index as f64 / (COUNT - 1) as f64,
            } }));
            let mesh = file.mesh(&[(ball, material)]);
            let x = 2.2 * (index as f64 - (COUNT - 1) as f64 / 2.0);
            let y = 3.3 - 2.2 * row as f64;
            file.place(mesh, Placement::at(dvec3(x, y, 0.0)));
        }
    }
    let levels: Vec<_> = (0..LEVELS)
        .map(|level| {
            let blur = f64::from(level) / f64::from(LEVELS - 1);
            let faces = (0..6).map(|face| {
                let texel = |a, b| rgbd(sky(direction(face, a, b), blur));
                file.image(&paint(SIDE >> level, texel))
            });
            faces.collect::<Vec<_>>()
        })
        .collect();
    let turn = DQuat::from_rotation_y(PI / 6.0);
    file.environment(json!({
        "name": "sky", "intensity": 1.0, "rotation": turn.as_quat().to_array(),
        "irradianceCoefficients": irradiance(), "specularImageSize": SIDE, "specularImages": levels,
    }));
    file.perspective("front", dvec3(0.0, 2.6, 16.0), dvec3(0.0, 2.2, 0.0), 27.0);
    file.finish("Image-based light")
}

/// Radiance from a direction; a larger `blur` makes it smoother.
fn sky(towards: DVec3, blur: f64) -> DVec3 {
    const SUN: DVec3 = DVec3::new(0.48, 0.6, 0.64);
    let (horizon, zenith) = (dvec3(0.75, 0.85, 1.0), dvec3(0.15, 0.35, 0.9));
    let ground = dvec3(0.3, 0.22, 0.15);
    let sky = horizon.lerp(zenith, towards.y.clamp(0.0, 1.0));
    let edge = 0.02 + blur;
    let share = ((towards.y + edge) / (2.0 * edge)).clamp(0.0, 1.0);
    // The same light is spread over a cone that the roughness widens.
    let sharpness = 60.0 / (1.0 + 30.0 * blur);
    let sun = (sharpness * (towards.dot(SUN) - 1.0)).exp() * sharpness / 3.0;
    ground.lerp(sky, share) + dvec3(1.0, 0.9, 0.7) * sun
}

/// Direction of a place on a face of a cube map in the order of Vulkan; column `a` and row `b` are 0 to 1.
fn direction(face: u32, a: f64, b: f64) -> DVec3 {
    let (a, b) = (2.0 * a - 1.0, 2.0 * b - 1.0);
    let towards = match face {
        0 => dvec3(1.0, -b, -a),
        1 => dvec3(-1.0, -b, a),
        2 => dvec3(a, 1.0, b),
        3 => dvec3(a, -1.0, -b),
        4 => dvec3(a, -b, 1.0),
        _ => dvec3(-a, -b, -1.0),
    };
    towards.normalize()
}

/// An sRGB colour and an alpha, whose quotient is the radiance.
fn rgbd(radiance: DVec3) -> [u8; 4] {
    let divisor = (255.0 / radiance.max_element().max(1.0)).floor().max(1.0);
    let code = |x: f64| {
        let x = (x * divisor / 255.0).clamp(0.0, 1.0);
        let encoded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
        (255.0 * encoded).round() as u8
    };
    let [r, g, b] = radiance.to_array().map(code);
    [r, g, b, divisor as u8]
}

/// Coefficients of the irradiance, summed over evenly spread directions.
fn irradiance() -> Vec<[f32; 3]> {
    const DIRECTIONS: u32 = 20_000;
    let mut sums = [DVec3::ZERO; 9];
    for i in 0..DIRECTIONS {
        let y = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(DIRECTIONS);
        let (sin, cos) = (f64::from(i) * PI * (3.0 - 5.0_f64.sqrt())).sin_cos();
        let across = (1.0 - y * y).sqrt();
        let d = dvec3(across * cos, y, across * sin);
        let values = [
            0.282_095,
            0.488_603 * d.y,
            0.488_603 * d.z,
            0.488_603 * d.x,
            1.092_548 * d.x * d.y,
            1.092_548 * d.y * d.z,
            0.315_392 * (3.0 * d.z * d.z - 1.0),
            1.092_548 * d.x * d.z,
            0.546_274 * (d.x * d.x - d.y * d.y),
        ];
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += sky(d, 0.0) * value;
        }
    }
    let cosine = [PI, 2.0 * PI / 3.0, PI / 4.0];
    let band = |i: usize| cosine[usize::from(i > 0) + usize::from(i > 3)];
    let scale = 4.0 * PI / f64::from(DIRECTIONS);
    let sums = sums.into_iter().enumerate();
    // Three decimals are the same on all processors.
    let round = |x: f64| ((1e3 * x).round() / 1e3) as f32;
    sums.map(|(i, sum)| (sum * scale * band(i)).to_array().map(round)).collect()
}

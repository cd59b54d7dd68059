//! Plain and bumpy spheres packed on a disc: many triangles, where most neighbouring pixels show different triangles
//! of the same sphere.

use super::glb::{Builder, Placement, linear};
use super::mesh::{Mesh, icosphere};
use glam::{DQuat, DVec3, dvec3};
use gpc::testing::Random;
use serde_json::json;
use std::f64::consts::TAU;

const COUNT: u32 = 72;
/// sRGB colour, metalness and roughness.
const PALETTE: [([u8; 3], f64, f64); 8] = [
    ([226, 106, 80], 0.0, 0.35),
    ([244, 196, 92], 0.0, 0.5),
    ([64, 142, 148], 0.0, 0.25),
    ([240, 234, 222], 0.0, 0.6),
    ([46, 74, 108], 0.0, 0.3),
    ([214, 170, 108], 1.0, 0.35),
    ([158, 190, 140], 0.0, 0.55),
    ([208, 210, 214], 1.0, 0.25),
];

/// Builds the scene.
pub fn build() -> Vec<u8> {
    let mut file = Builder::default();
    let materials = PALETTE.map(|(color, metallic, roughness)| {
        let [r, g, b] = color.map(linear);
        file.material(json!({ "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness,
        } }))
    });
    let plain = file.surface(&icosphere(3, |_| 1.0));
    let bumpy = file.surface(&icosphere(3, bumps));
    let meshes: Vec<_> =
        materials.iter().map(|&material| [file.mesh(&[(plain, material)]), file.mesh(&[(bumpy, material)])]).collect();
    let mut random = Random::new(3);
    // Sunflower packing: each sphere is a golden angle further around, at a radius that keeps the density even.
    let golden_angle = TAU * (1.0 - 1.0 / ((1.0 + 5.0_f64.sqrt()) / 2.0));
    for i in 0..COUNT {
        let index = f64::from(i);
        let (sin, cos) = (index * golden_angle).sin_cos();
        let distance = 0.98 * (index + 0.4).sqrt();
        let size = random.range(0.5, 0.82);
        let mesh = meshes[(i as usize * 5 + i as usize / 8) % PALETTE.len()][usize::from(i % 3 == 1)];
        file.place(
            mesh,
            Placement {
                translation: dvec3(distance * cos, size, distance * sin),
                rotation: DQuat::from_rotation_y(random.range(0.0, TAU)),
                scale: DVec3::splat(size),
            },
        );
    }
    floor(&mut file);
    file.perspective("overview", dvec3(4.4, 6.2, 12.6), dvec3(-0.1, 0.1, 0.5), 36.0);
    file.perspective("close", dvec3(1.6, 2.4, 7.4), dvec3(-0.4, 0.5, 0.0), 40.0);
    file.finish("Spheres")
}

/// A sphere with rounded bumps, about a tenth of its radius high.
fn bumps(direction: DVec3) -> f64 {
    let wave = |v: f64| (9.0 * v).sin();
    1.0 + 0.09 * (wave(direction.x) * wave(direction.y + 0.3) * wave(direction.z + 0.7))
}

fn floor(file: &mut Builder) {
    let sand = file.paint("sand", [222, 212, 196], 0.9);
    let rim = |step: i32| {
        let (sin, cos) = (TAU * f64::from(step) / 96.0).sin_cos();
        dvec3(14.0 * cos, 0.0, 14.0 * sin)
    };
    let mut disc = Mesh::default();
    for step in 0..96 {
        disc.polygon(&[DVec3::ZERO, rim(step + 1), rim(step)]);
    }
    let surface = file.surface(&disc);
    let mesh = file.mesh(&[(surface, sand)]);
    file.place(mesh, Placement::at(DVec3::ZERO));
}

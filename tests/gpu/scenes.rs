//! A small lit scene with silhouettes, thin features and a horizon.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use gpc::scene::{AlphaMode, Light, LightKind, Material};

use crate::stage::{Stage, flat};

/// White light from above, which casts the shadow of the ball on the floor.
pub fn distant_lamp() -> Light {
    Light {
        kind: LightKind::Directional,
        position: DVec3::ZERO,
        direction: DVec3::new(-0.3, -1.0, -0.4).normalize(),
        color: [1.0; 3],
        range: None,
    }
}

/// A faceted ball above a checker floor, with a fan of wires behind it. No edge runs along a pixel's diagonal or side
/// through its centre, where samples would tie.
pub fn ball_over_checker() -> Stage {
    let lit =
        |base_color| Material { unlit: false, metallic: 0.0, roughness: 0.5, ..flat(base_color, AlphaMode::Opaque) };
    let mut stage = Stage::new(vec![
        lit([0.8, 0.1, 0.05, 1.0]),
        lit([0.9, 0.9, 0.85, 1.0]),
        lit([0.05, 0.06, 0.1, 1.0]),
        flat([1.0, 0.8, 0.1, 1.0], AlphaMode::Opaque),
    ]);
    ball(&mut stage, [-0.4, -0.1, -2.6], 0.85);
    for (row, column) in (0..10_u8).flat_map(|row| (0..12_u8).map(move |column| (row, column))) {
        let [left, near] = [f64::from(column) * 0.7 - 4.13, -0.6 - f64::from(row) * 0.7];
        let corner = |x: f64, z: f64| [x as f32, -1.0, z as f32];
        stage.add_quad(
            usize::from(1 + (row + column) % 2),
            [corner(left, near), corner(left + 0.7, near), corner(left + 0.7, near - 0.7), corner(left, near - 0.7)],
        );
    }
    for wire in 0..9 {
        let angle = f64::from(wire) * 0.19 + 0.07;
        let at = |angle: f64, far: f64| [(1.1 - far * angle.cos()) as f32, (far * angle.sin() - 0.9) as f32, -3.5];
        stage.add(3, [[1.1, -0.9, -3.5], at(angle + 0.006, 3.0), at(angle - 0.006, 3.0)]);
    }
    stage
}

/// Adds a sphere of flat facets.
fn ball(stage: &mut Stage, middle: [f64; 3], radius: f64) {
    const RINGS: u32 = 10;
    const SECTORS: u32 = 16;
    let at = |ring: u32, sector: u32| {
        let (polar, azimuth) = (PI * f64::from(ring) / f64::from(RINGS), TAU * f64::from(sector) / f64::from(SECTORS));
        let direction = [polar.sin() * azimuth.sin(), polar.cos(), polar.sin() * azimuth.cos()];
        [0, 1, 2].map(|axis| (middle[axis] + radius * direction[axis]) as f32)
    };
    for (ring, sector) in (0..RINGS).flat_map(|ring| (0..SECTORS).map(move |sector| (ring, sector))) {
        let [a, b] = [at(ring, sector), at(ring + 1, sector)];
        let [c, d] = [at(ring + 1, sector + 1), at(ring, sector + 1)];
        stage.add_quad(0, [a, b, c, d]);
    }
}

/// Panes, alpha-tested triangles and a checkerboard behind each other, so that each kernel has tiles of its own.
pub fn layered() -> Stage {
    let mut stage = ball_over_checker();
    for mode in [AlphaMode::Mask { cutoff: 0.5 }, AlphaMode::Blend] {
        let material = stage.materials.len();
        stage.materials.push(flat([0.9, 0.3, 0.2, 0.6], mode));
        for k in 0..6_u8 {
            let [x, y] = [f32::from(k % 3) - 1.4, f32::from(k / 3) - 0.9];
            let z = -3.0 - f32::from(k) * 0.1 - material as f32 * 0.3;
            let corners = [[x, y, z], [x + 0.9, y + 0.13, z], [x + 0.2, y + 0.8, z]];
            stage.add(material, corners);
        }
    }
    stage
}

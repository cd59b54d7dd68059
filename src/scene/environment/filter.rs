//! What lobes of each roughness average of a cube: sums over directions of GGX, each of which reads the level whose texels are
//! as large as what it stands for, so that small bright lights neither flicker nor sparkle (Křivánek and Colbert, "Real-time
//! Shading with Filtered Importance Sampling", 2008).

use glam::{DMat3, DVec3, Vec3};
use std::f64::consts::{PI, TAU};

use super::cube::{Cube, direction, middle};

/// Roughnesses from 0 to 1.
const LEVELS: u32 = 6;
/// Directions a texel.
const DIRECTIONS: u32 = 64;

/// Levels of ever rougher surfaces, each half as large as the one before.
pub(super) fn levels(pyramid: &[Cube]) -> Vec<Cube> {
    let side = pyramid.first().map_or(1, |cube| cube.side);
    let count = LEVELS.min(side.ilog2() + 1);
    (0..count)
        .map(|level| {
            if level == 0 {
                return pyramid[0].clone();
            }
            let roughness = f64::from(level) / f64::from(count - 1);
            let lobe = lobe(roughness * roughness, side);
            Cube::new(side >> level, |face, x, y| {
                let normal = direction(face, middle(side >> level, x, y)).normalize();
                average(pyramid, &lobe, normal).to_array()
            })
        })
        .collect()
}

/// A direction about +z, what it weighs, and the level to read.
type Ray = (DVec3, f32, f64);

/// Reflections of a view along the normal.
fn lobe(alpha: f64, side: u32) -> Vec<Ray> {
    let texel = 4.0 * PI / (6.0 * f64::from(side * side));
    let square = alpha * alpha;
    let rays = (0..DIRECTIONS).filter_map(|i| {
        let u = (f64::from(i) + 0.5) / f64::from(DIRECTIONS);
        let (sin_turn, cos_turn) = (TAU * f64::from(i.reverse_bits()) / 2.0_f64.powi(32)).sin_cos();
        let n_h = ((1.0 - u) / (1.0 + (square - 1.0) * u)).sqrt();
        let across = (1.0 - n_h * n_h).sqrt();
        let half = DVec3::new(across * cos_turn, across * sin_turn, n_h);
        let ray = 2.0 * n_h * half - DVec3::Z;
        let bottom = n_h * n_h * (square - 1.0) + 1.0;
        let density = square / (PI * bottom * bottom) / 4.0;
        let stands_for = 1.0 / (f64::from(DIRECTIONS) * density);
        // Twice as wide as it needs to be on average, for those between which more lies.
        let level = 0.5 * (stands_for / texel).log2() + 1.0;
        (ray.z > 0.0).then_some((ray, ray.z as f32, level.max(0.0)))
    });
    rays.collect()
}

fn average(pyramid: &[Cube], lobe: &[Ray], normal: DVec3) -> Vec3 {
    let (right, up) = normal.any_orthonormal_pair();
    let axes = DMat3::from_cols(right, up, normal);
    let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
    for (ray, weight, level) in lobe {
        let towards = axes * *ray;
        let last = pyramid.len() - 1;
        let finer = (level.floor() as usize).min(last);
        let coarser = (finer + 1).min(last);
        let share = (level - level.floor()) as f32;
        let color = pyramid[finer]
            .sample(towards)
            .lerp(pyramid[coarser].sample(towards), share);
        sum += *weight * color;
        weights += weight;
    }
    sum / weights
}

#[cfg(test)]
mod tests {
    use super::super::{cube::pyramid, equirectangular::Equirectangular};
    use super::*;

    #[test]
    fn what_is_alike_all_around_stays_so() {
        let source = pyramid(&Equirectangular {
            width: 64,
            height: 32,
            pixels: vec![[0.5, 1.0, 4.0]; 64 * 32],
        });
        for level in levels(&source) {
            for texel in level.texels {
                for (found, expected) in texel.iter().zip([0.5, 1.0, 4.0]) {
                    assert!((found - expected).abs() < 1e-4 * expected, "{texel:?}");
                }
            }
        }
    }

    /// A single bright texel makes no sparks: rough levels show it as one hill, whose texels differ little from their
    /// neighbours, and keep its light.
    #[test]
    fn a_small_light_makes_no_sparks() {
        let (width, height) = (256, 128);
        let mut pixels = vec![[0.0; 3]; (width * height) as usize];
        // On the horizon, straight ahead.
        pixels[(63 * width + 128) as usize] = [1e4; 3];
        let source = pyramid(&Equirectangular {
            width,
            height,
            pixels,
        });
        let all = levels(&source);
        let total = |cube: &Cube| {
            let side = cube.side;
            let texels = cube.texels.iter().enumerate();
            let sum: f64 = texels
                .map(|(i, texel)| {
                    let place = i as u32 % (side * side);
                    let at = middle(side, place % side, place / side);
                    f64::from(texel[0]) * super::super::cube::solid_angle(at)
                })
                .sum();
            sum / f64::from(side * side)
        };
        let expected = total(&all[0]);
        for level in &all[2..] {
            let found = total(level);
            assert!(
                (found / expected - 1.0).abs() < 0.25,
                "{found}, expected {expected}"
            );
            // Along the row of the light, its face rises to it and falls from it.
            let row: Vec<f32> = (0..level.side)
                .map(|x| level.texel(5, x, level.side / 2).x)
                .collect();
            let peak = row.iter().copied().fold(0.0, f32::max);
            let turns = row.windows(3).filter(|w| {
                (w[1] - w[0]) * (w[2] - w[1]) < 0.0 && (w[1] - w[0]).abs() > 0.02 * peak
            });
            assert!(turns.count() <= 1, "{row:?}");
        }
    }
}

//! Stages of random triangles.

use super::stage::{Stage, flat, seen_at};
use gpc::scene::{AlphaMode, Material};
use gpc::testing::Random;

/// Number of colours of a [`soup`]'s opaque triangles.
const COLORS: usize = 16;

/// Stage of `count` random triangles in sixteen colours; the last `blend` triangles are translucent. Sums of these
/// colours over samples are exact, so that the order of summation, which follows the IDs, has no effect.
pub fn soup(seed: u64, size: [u32; 2], count: usize, blend: usize) -> Stage {
    let mut random = Random::new(seed);
    let mut channel = || random.below(65) as f32 / 64.0;
    let mut materials: Vec<Material> =
        (0..COLORS).map(|_| flat([channel(), channel(), channel(), 1.0], AlphaMode::Opaque)).collect();
    materials.push(flat([0.25, 0.5, 0.75, 0.5], AlphaMode::Blend));
    let mut stage = Stage::new(materials);
    let mut random = Random::new(!seed);
    for index in 0..count {
        let middle = size.map(|side| random.range(-0.5, 0.5) * f64::from(side));
        let corners = [0; 3].map(|_| {
            let place = middle.map(|middle| middle + random.range(-20.0, 20.0));
            seen_at(place, random.range(1.0, 9.0), size[1])
        });
        let material = if index + blend < count { index % COLORS } else { COLORS };
        stage.add(material, corners);
    }
    stage
}

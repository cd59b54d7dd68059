//! Prefiltered reflection of an environment along a surface's normal: the average that `prefilter` computes from
//! cubes.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

/// A cube map, face by face in Vulkan's order, row by row.
#[derive(Clone, Debug)]
pub struct Cube {
    /// Side of a face in texels.
    pub side: u32,
    /// Radiance of each texel.
    pub texels: Vec<DVec3>,
}

/// For each face, unit vectors: outwards, to the right in the face, and down.
const FACES: [[DVec3; 3]; 6] = [
    [DVec3::X, DVec3::NEG_Z, DVec3::NEG_Y],
    [DVec3::NEG_X, DVec3::Z, DVec3::NEG_Y],
    [DVec3::Y, DVec3::X, DVec3::Z],
    [DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z],
    [DVec3::Z, DVec3::X, DVec3::NEG_Y],
    [DVec3::NEG_Z, DVec3::NEG_X, DVec3::NEG_Y],
];

impl Cube {
    /// Unit vector to the middle of a texel.
    #[must_use]
    pub fn direction(side: u32, index: u32) -> DVec3 {
        let place = index % (side * side);
        let middle = |i: u32| f64::from(2 * i + 1) / f64::from(side) - 1.0;
        let [ahead, right, down] = FACES[(index / (side * side)) as usize];
        (ahead + right * middle(place % side) + down * middle(place / side)).normalize()
    }

    /// Radiance interpolated between the nearest texels of the face in this direction.
    fn read(&self, direction: DVec3) -> DVec3 {
        let ahead = |face: usize| direction.dot(FACES[face][0]);
        let face = (0..6).fold(0, |best, face| if ahead(face) > ahead(best) { face } else { best });
        let last = f64::from(self.side - 1);
        let along = |axis: usize| {
            let at = direction.dot(FACES[face][axis]) / ahead(face);
            let at = ((at + 1.0) / 2.0 * f64::from(self.side) - 0.5).clamp(0.0, last);
            (at.floor(), (at.floor() + 1.0).min(last), at.fract())
        };
        let ((left, right, u), (top, bottom, v)) = (along(1), along(2));
        let texel = |x: f64, y: f64| {
            let row = face as u32 * self.side + y as u32;
            self.texels[(row * self.side + x as u32) as usize]
        };
        let row = |y| texel(left, y).lerp(texel(right, y), u);
        row(top).lerp(row(bottom), v)
    }
}

/// Average of `levels` around the direction `normal`. Each of `rays` is a direction relative to +z, whose z component
/// is its weight, and the level that it reads.
#[must_use]
pub fn average(levels: &[Cube], rays: &[[f32; 4]], normal: DVec3) -> DVec3 {
    let turn = if normal.z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (turn + normal.z);
    let b = normal.x * normal.y * a;
    let right = DVec3::new(1.0 + turn * normal.x.powi(2) * a, turn * b, -turn * normal.x);
    let up = DVec3::new(b, turn + normal.y.powi(2) * a, -normal.y);
    let axes = DMat3::from_cols(right, up, normal);
    let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
    for ray in rays {
        let [x, y, z, level] = ray.map(f64::from);
        let towards = axes * DVec3::new(x, y, z);
        sum += z * levels[level as usize].read(towards);
        weights += z;
    }
    sum / weights
}

/// Share of the light from a direction, per solid angle, in the reflection of a surface seen along its normal: the GGX
/// distribution with this roughness, times the cosine. `cosine` is that of the angle between the direction and the normal.
#[must_use]
pub fn density(alpha: f64, cosine: f64) -> f64 {
    let square = alpha * alpha;
    let distribution = |n_h_squared: f64| square / (PI * (n_h_squared * (square - 1.0) + 1.0).powi(2));
    // The mean cosine of the lobe, in closed form; it is 1/4 for the widest.
    let (b, end) = (square - 1.0, 1.0 / (1.0 + square));
    let mean = match b.abs() < 1e-4 {
        true => 0.25,
        false => 2.0 * (square / (b * b) * (1.0 + b * end).ln() - end / b) - end,
    };
    distribution((1.0 + cosine) / 2.0) / 4.0 * cosine.max(0.0) / mean
}

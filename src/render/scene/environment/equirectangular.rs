//! Images of all directions: longitude along the width, latitude along the height.

use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Equirectangular image, rows from the top. Its middle shows the direction -z, and its right side turns towards +x.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Equirectangular {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) pixels: Vec<[f32; 3]>,
}

impl Equirectangular {
    /// Colour in the direction of a unit vector, interpolated between the nearest texels; columns wrap around.
    pub(super) fn towards(&self, direction: DVec3) -> DVec3 {
        let u = direction.x.atan2(-direction.z) / TAU + 0.5;
        let v = direction.y.clamp(-1.0, 1.0).acos() / PI;
        let (x, y) = (
            u * f64::from(self.width) - 0.5,
            (v * f64::from(self.height) - 0.5).clamp(0.0, f64::from(self.height - 1)),
        );
        let (left, top) = (x.floor(), y.floor());
        let column = |x: f64| x.rem_euclid(f64::from(self.width)) as usize;
        let rows = [top as usize, (top as usize + 1).min(self.height as usize - 1)];
        let texel =
            |x: f64, row: usize| DVec3::from_array(self.pixels[row * self.width as usize + column(x)].map(f64::from));
        let row = |row| texel(left, row).lerp(texel(left + 1.0, row), x - left);
        row(rows[0]).lerp(row(rows[1]), y - top)
    }
}

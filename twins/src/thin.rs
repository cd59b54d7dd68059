//! Folds: whether a thin triangle lies at an angle to the triangle that a pixel's centre sees.

use glam::DVec3;

/// Cosine of the angle between two triangles from which on they are a fold.
pub const FOLD: f64 = 0.5;

/// Cosine of the angle between two triangles that are seen from `eye`: the angle between those sides that the eye sees.
/// Corners and eye are in the same space. The cosine is 0 if a triangle has no area.
#[must_use]
pub fn cosine(a: [DVec3; 3], b: [DVec3; 3], eye: DVec3) -> f64 {
    let [a, b] = [a, b].map(|corners| {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let towards = normal.dot(eye - corners[0]);
        normal.normalize_or_zero() * towards.signum()
    });
    a.dot(b)
}

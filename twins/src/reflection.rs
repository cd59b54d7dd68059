//! Light that a surface reflects to the eye, by glTF's metallic-roughness model (glTF 2.0, appendix B).

use std::f64::consts::PI;

use glam::DVec3;

/// Isotropic surface without extensions.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Unit normal; it may point away from the eye.
    pub normal: DVec3,
    /// Albedo of the base.
    pub diffuse: DVec3,
    /// Reflectance at normal incidence.
    pub f0: DVec3,
    /// Squared perceptual roughness.
    pub alpha: f64,
}

/// Normal for reflections: a normal that points away from the eye, mirrored at the plane perpendicular to the unit vector
/// `to_eye`.
#[must_use]
pub fn facing(normal: DVec3, to_eye: DVec3) -> DVec3 {
    match normal.dot(to_eye) {
        away if away < 0.0 => normal - 2.0 * away * to_eye,
        _ => normal,
    }
}

/// Share of its reflections that a surface with this normal keeps: 1 on the side of the eye, 0 straight away from it.
#[must_use]
pub fn facing_share(normal: DVec3, to_eye: DVec3) -> f64 {
    (1.0 + normal.dot(to_eye)).min(1.0)
}

/// Radiance towards the eye due to a light in the direction `to_light`, with an irradiance of 1 on a surface that faces it.
#[must_use]
pub fn reflected(surface: &Surface, to_eye: DVec3, to_light: DVec3) -> DVec3 {
    let mirror = facing(surface.normal, to_eye);
    let half = (to_eye + to_light).normalize();
    let n_l = surface.normal.dot(to_light).max(0.0);
    let (n_v, n_h) = (mirror.dot(to_eye).max(1e-4), mirror.dot(half).max(0.0));
    let share = facing_share(surface.normal, to_eye);
    let grazing = (1.0 - to_eye.dot(half).clamp(0.0, 1.0)).powi(5);
    let fresnel = share * (surface.f0 + (1.0 - surface.f0) * grazing);
    let square = surface.alpha * surface.alpha;
    let distribution = square / (PI * (n_h * n_h * (square - 1.0) + 1.0).powi(2));
    let smith = |a: f64, b: f64| a * (b * b * (1.0 - square) + square).sqrt();
    let visibility = 0.5 / (smith(n_l, n_v) + smith(n_v, n_l) + 1e-7);
    let base = (1.0 - fresnel) * surface.diffuse / PI;
    (base + fresnel * distribution * visibility) * n_l
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirrored_normals_meet_the_others_at_the_horizon() {
        let eye = DVec3::Z;
        assert_eq!(facing(-eye, eye), eye);
        assert_eq!(facing(DVec3::X, eye), DVec3::X);
        let tilted = DVec3::new(0.6, 0.0, -0.8);
        assert!((facing(tilted, eye) - DVec3::new(0.6, 0.0, 0.8)).length() < 1e-15);
        let shares = [eye, DVec3::X, -eye].map(|normal| facing_share(normal, eye));
        assert_eq!(shares, [1.0, 1.0, 0.0]);
    }
}

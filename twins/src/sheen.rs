//! Share of a uniform environment's light that white sheen reflects (`KHR_materials_sheen`): the integral that shaders
//! approximate.

use std::f64::consts::{PI, TAU};

/// Reflected share for a perceptual roughness from 0.15 to 1 and a viewing angle to the normal with the cosine `n_v`,
/// above 0. It is clamped to 1, which the model exceeds at grazing angles.
#[must_use]
pub fn albedo(roughness: f64, n_v: f64) -> f64 {
    const STEPS: u32 = 300;
    let sharpness = 1.0 / (roughness * roughness);
    let middle = |step: u32| (f64::from(step) + 0.5) / f64::from(STEPS);
    let eye_across = (1.0 - n_v * n_v).sqrt();
    let mut sum = 0.0;
    for root in (0..STEPS).map(middle) {
        // Squares place more steps at grazing angles, from which most light is reflected.
        let n_l = root * root;
        let across = (1.0 - n_l * n_l).sqrt();
        for angle in (0..STEPS).map(|step| PI * middle(step)) {
            let half = [across * angle.cos() + eye_across, across * angle.sin(), n_l + n_v];
            let length = half.iter().map(|x| x * x).sum::<f64>().sqrt();
            let n_h = half[2] / length;
            let distribution = (2.0 + sharpness) * (1.0 - n_h * n_h).max(0.0).powf(sharpness / 2.0) / TAU;
            let visibility = 0.25 / (n_l + n_v - n_l * n_v);
            sum += distribution * visibility * n_l * 2.0 * root;
        }
    }
    (sum * TAU / f64::from(STEPS * STEPS)).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For the roughest sheen seen along the normal, light at the angle t gives 3 sin(t / 2) / (8 pi). Its integral
    /// with the cosine over the hemisphere is sqrt(2) / 10.
    #[test]
    fn the_roughest_sheen_seen_along_the_normal_has_a_closed_form() {
        let found = albedo(1.0, 1.0);
        assert!((found - 2.0_f64.sqrt() / 10.0).abs() < 1e-4, "{found}");
    }
}

//! Irradiance by spherical harmonics (Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps",
//! 2001).

use glam::DVec3;
use std::f64::consts::PI;

use super::cube::{Cube, direction, solid_angle};
use super::suns::Suns;

/// Largest side of the faces that are integrated: a coarse cube suffices for the first three bands.
const SIDE: u32 = 32;

/// Values of the real spherical harmonics of the first three bands in a direction.
pub(super) fn basis(d: DVec3) -> [f64; 9] {
    let [zero, one, two] = [1.0 / PI, 3.0 / PI, 15.0 / PI].map(|x: f64| 0.5 * x.sqrt());
    [
        zero,
        one * d.y,
        one * d.z,
        one * d.x,
        two * d.x * d.y,
        two * d.y * d.z,
        0.25 * (5.0 / PI).sqrt() * (3.0 * d.z * d.z - 1.0),
        two * d.x * d.z,
        0.5 * two * (d.x * d.x - d.y * d.y),
    ]
}

/// Factors of the clamped cosine for each harmonic, divided by pi.
const COSINE: [f64; 9] = {
    let (one, two) = (2.0 / 3.0, 0.25);
    [1.0, one, one, one, two, two, two, two, two]
};

/// Spherical-harmonic coefficients of the irradiance / pi, due to a map and the suns that were taken out of it.
pub(super) fn irradiance(pyramid: &[Cube], suns: &Suns) -> [[f32; 3]; 9] {
    let Some(cube) = pyramid.iter().find(|cube| cube.side <= SIDE) else {
        return [[0.0; 3]; 9];
    };
    let mut sums = [DVec3::ZERO; 9];
    let mut weights = 0.0;
    for face in 0..6 {
        for y in 0..cube.side {
            for x in 0..cube.side {
                let at = cube.middle(x, y);
                let weight = solid_angle(at);
                let color = weight * cube.texel(face, x, y).as_dvec3();
                let values = basis(direction(face, at).normalize());
                sums.iter_mut().zip(values).for_each(|(s, v)| *s += color * v);
                weights += weight;
            }
        }
    }
    let of_all = 4.0 * PI / weights;
    let mut sums = sums.map(|sum| sum * of_all);
    for sun in suns.parts() {
        let values = basis(sun.direction);
        sums.iter_mut().zip(values).for_each(|(s, v)| *s += sun.light * v);
    }
    std::array::from_fn(|i| (sums[i] * COSINE[i]).as_vec3().to_array())
}

#[cfg(test)]
mod tests {
    use super::super::Environment;
    use super::*;

    /// If the radiance is 1 + y, the irradiance of a surface with the normal `n` is pi (1 + 2/3 n.y).
    #[test]
    fn a_sky_brighter_above_has_a_closed_form() {
        let (width, height) = (128, 64);
        let pixels: Vec<[f32; 3]> = (0..width * height)
            .map(|i| {
                let latitude = (f64::from(i / width) + 0.5) / f64::from(height) * PI;
                [1.0 + latitude.cos() as f32; 3]
            })
            .collect();
        let sky = Environment::from_equirectangular(width, height, pixels).unwrap();
        for normal in [DVec3::Y, DVec3::X, DVec3::NEG_Y, DVec3::new(0.6, 0.8, 0.0)] {
            let found = sky.irradiance_towards(normal).x;
            let expected = 1.0 + 2.0 / 3.0 * normal.y;
            assert!((found - expected).abs() < 3e-3, "{normal}: {found}, expected {expected}");
        }
    }
}

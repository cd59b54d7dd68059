//! Stress check: cameras inside closed surfaces. The triangles cross the planes of the eye and of the near plane in
//! many ways and reach millions of pixels off the image.

use super::counting::{Hits, count};
use super::partition::report;
use super::stage::{Stage, everywhere};
use super::{Finding, Length};
use glam::{DMat3, DQuat, DVec2, DVec3, EulerRot};
use gpc::camera::{Camera, Projection};
use gpc::render::{Headless, RenderError};
use gpc::sampling::Pattern;
use gpc::testing::Random;
use std::f64::consts::{PI, TAU};

/// Vertical fields of view in degrees.
const FIELDS: [f64; 8] = [0.1, 1.0, 10.0, 60.0, 90.0, 150.0, 175.0, 179.0];
/// Distance of the near plane; the surface is at distance 1 from its centre.
const NEAR: f64 = 1e-4;

pub(super) fn check(headless: &mut Headless, length: Length) -> Result<Vec<Finding>, RenderError> {
    let mut findings = Vec::new();
    for (index, field) in FIELDS.into_iter().enumerate() {
        let mut random = Random::new(index as u64);
        let mut hits = Hits::default();
        for _ in 0..length.choose(2, 24) {
            let stage = closed_surface(&mut random, length.choose(12, 40));
            let camera = Camera {
                eye: DVec3::from([0; 3].map(|_| random.range(-0.4, 0.4))),
                axes: orientation(&mut random),
                projection: Projection::Perspective { fov: field.to_radians(), near: NEAR, far: None },
                shift: DVec2::ZERO,
            };
            let settings = everywhere([length.choose(48, 96); 2], Pattern::Sobol, 16);
            hits.add(count(headless, &stage, &settings, &camera, |_| true)?);
        }
        let case = format!("inside closed surfaces, field of view {field} degrees");
        report(&mut findings, &case, hits);
    }
    Ok(findings)
}

/// Convex surface of about 2 x `rings`^2 triangles around the origin. Its vertices lie on a sphere at random longitudes
/// and latitudes that rows and columns share, so that its quadrilaterals are plane.
fn closed_surface(random: &mut Random, rings: usize) -> Stage {
    let mut steps = |count: usize, length: f64| -> Vec<f64> {
        (0..count).map(|step| (step as f64 + random.range(0.1, 0.9)) / count as f64 * length).collect()
    };
    let mut polar = steps(rings, PI);
    polar.insert(0, 0.0);
    polar.push(PI);
    let mut around = steps(rings, TAU);
    around.extend(around.first().copied());
    let vertex = |polar: f64, around: f64| {
        let ring = if polar == 0.0 || polar == PI { 0.0 } else { polar.sin() };
        [ring * around.cos(), polar.cos(), ring * around.sin()].map(|v| v as f32)
    };
    let mut stage = Stage::default();
    for rows in polar.windows(2) {
        for columns in around.windows(2) {
            let (&[upper, lower], &[left, right]) = (rows, columns) else {
                continue;
            };
            if upper > 0.0 {
                let corners = [vertex(upper, left), vertex(upper, right), vertex(lower, left)];
                stage.add(0, corners);
            }
            if lower < PI {
                let corners = [vertex(upper, right), vertex(lower, right), vertex(lower, left)];
                stage.add(0, corners);
            }
        }
    }
    stage
}

fn orientation(random: &mut Random) -> DMat3 {
    let [a, b, c] = [0; 3].map(|_| random.range(0.0, TAU));
    DMat3::from_quat(DQuat::from_euler(EulerRot::YXZ, a, b, c))
}

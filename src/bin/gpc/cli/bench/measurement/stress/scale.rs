//! Stress check: scenes of all sizes, scenes far from the origin, and deep scenes.

use super::difference::{in_codes, same};
use super::stage::{NEAR, Stage, camera, everywhere, flat, seen_at};
use super::{Finding, Length, soup};
use glam::DVec3;
use gpc::camera::{Camera, Projection};
use gpc::render::{Headless, RenderError, Rendered, SceneRequest, Settings, SuperpixelOptions};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;
use gpc::testing::Random;

/// Share of the pixels, those with samples on edges, that may differ when vertices are rounded differently.
const ROUNDED: f64 = 0.002;

pub(super) fn check(headless: &mut Headless, length: Length) -> Result<Vec<Finding>, RenderError> {
    let size = length.choose([96, 64], [480, 320]);
    let mut stage = soup(5, size, length.choose(200, 5000), 20);
    for material in &mut stage.materials {
        material.unlit = false;
        material.roughness = 0.5;
    }
    let settings = Settings::new(size[0], size[1]).method(SuperpixelOptions::new(16));
    let first = stage.render(headless, &settings)?;
    let mut findings = Vec::new();
    for power in [-20, -7, 7, 20] {
        let factor = 2.0_f64.powi(power);
        let image = scaled(headless, &stage, &settings, factor)?;
        findings.push(same(format!("scaled by 2^{power}"), &first, &image));
    }
    for power in [-6, -3, 3, 6] {
        let factor = 10.0_f64.powi(power);
        let image = scaled(headless, &stage, &settings, factor)?;
        findings.push(Finding {
            case: format!("scaled by 10^{power}"),
            checked: image.colors.len() as u64,
            unit: "share of pixels that differ by more than a code",
            measured: in_codes(&first, &image),
            allowed: Some(ROUNDED),
        });
    }
    for far in [1e3, 1e6, 1e9] {
        let away = DVec3::new(far, -far, far);
        let (scene, mut pose) = stage.build();
        pose.geometry.origin = away;
        let prepared = headless.upload(SceneRequest::new(&scene, &pose))?;
        let mut frame = headless.prepare(&prepared, &settings)?;
        let camera = Camera { eye: away, ..camera() };
        let image = headless.render(&mut frame, &camera)?;
        findings.push(same(format!("{far:e} units away in each axis"), &first, &image));
    }
    for samples in [1, 16] {
        findings.push(ladder(headless, samples)?);
    }
    Ok(findings)
}

/// Image of a stage whose lengths, the near plane's distance included, are scaled by `factor`.
fn scaled(headless: &mut Headless, stage: &Stage, settings: &Settings, factor: f64) -> Result<Rendered, RenderError> {
    let mut stage = stage.clone();
    for corner in stage.triangles.iter_mut().flat_map(|t| &mut t.corners) {
        *corner = corner.map(|v| (f64::from(v) * factor) as f32);
    }
    stage.seen_by(headless, settings, &near_at(NEAR * factor))
}

fn near_at(near: f64) -> Camera {
    Camera { projection: Projection::Perspective { fov: std::f64::consts::FRAC_PI_2, near, far: None }, ..camera() }
}

/// Finding on columns at distances from 10^-3 to 10^6 in random order, each in front of a wall that is farther by a
/// factor of 1 + 2^-16.
fn ladder(headless: &mut Headless, samples: u32) -> Result<Finding, RenderError> {
    const STEPS: u32 = 10;
    const COLUMN: u32 = 8;
    let size = [STEPS * COLUMN, 16];
    let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
    let mut order: Vec<(u32, bool)> = (0..STEPS).flat_map(|s| [(s, true), (s, false)]).collect();
    Random::new(4).shuffle(&mut order);
    for (step, wall) in order {
        let distance = 10.0_f64.powi(step as i32 - 3) * if wall { 1.0 + 1.0 / 65536.0 } else { 1.0 };
        let left = f64::from(step * COLUMN) - f64::from(size[0]) / 2.0;
        let right = left + f64::from(COLUMN);
        let corners = [[left, -20.0], [right, -20.0], [right, 20.0], [left, 20.0]];
        let first = stage.triangles.len();
        stage.add_quad(0, corners.map(|place| seen_at(place, distance, size[1])));
        for triangle in stage.triangles.iter_mut().skip(first) {
            triangle.color = if wall { [0.0, 0.0, 0.0, 1.0] } else { [1.0; 4] };
        }
    }
    let settings = everywhere(size, Pattern::Sobol, samples);
    let image = stage.seen_by(headless, &settings, &near_at(1e-4))?;
    Ok(Finding {
        case: format!("distances from 0.001 to 1,000,000, each 2^-16 before another, {samples} samples"),
        checked: image.colors.len() as u64 * u64::from(samples),
        unit: "samples of the farther surface",
        measured: image.colors.iter().map(|color| ((1.0 - f64::from(color[0])) * f64::from(samples)).round()).sum(),
        allowed: Some(0.0),
    })
}

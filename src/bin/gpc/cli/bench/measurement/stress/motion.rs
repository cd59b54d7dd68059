//! Stress check: thin wires under a camera that pans by fractions of a pixel. Their total brightness must stay the
//! same and must not flicker.

use super::stage::{Stage, camera, flat, once, seen_at};
use super::{Finding, Length};
use glam::DVec2;
use gpc::camera::Camera;
use gpc::render::{Headless, MethodKind, RenderError, SceneRequest, Settings};
use gpc::scene::AlphaMode;

/// Largest relative difference of an image's brightness from that of the wires.
const ENERGY: f64 = 0.01;
/// Widths of the wires in pixels.
const WIDTHS: [f64; 3] = [0.1, 0.3, 0.8];
/// Angles between the wires and the vertical, in degrees.
const LEANS: [f64; 4] = [0.5, 3.0, 11.0, 27.0];
/// Distance between the wires' middles / height of the image, large enough that the most slanted wire stays in its
/// interval.
const PITCH: f64 = 0.625;

pub(super) fn check(headless: &mut Headless, length: Length) -> Result<Vec<Finding>, RenderError> {
    let frames = length.choose(8, 32);
    let height = length.choose(96, 384);
    let mut findings = Vec::new();
    for width in WIDTHS {
        let scene = Wires::new(width, height);
        for (name, method, samples, allowed) in [
            ("one sample", MethodKind::None, 1, None),
            ("msaa 4", MethodKind::Msaa, 4, None),
            ("ssaa 64", MethodKind::Ssaa, 64, None),
            ("superpixel 64", MethodKind::Superpixel, 64, Some(ENERGY)),
        ] {
            let settings = once(scene.size)
                .attributes(false)
                .method(method.with_samples(samples))
                .map_superpixels(|options| options.thin(true));
            let [energy, flicker] = scene.pan(headless, &settings, frames)?;
            for (unit, measured, allowed) in [
                ("greatest error of an image's energy", energy, allowed),
                ("flicker: deviation of the energy of a row", flicker, None),
            ] {
                findings.push(Finding {
                    case: format!("wires {width} pixels wide, {name}"),
                    checked: u64::from(frames),
                    unit,
                    measured,
                    allowed,
                });
            }
        }
    }
    Ok(findings)
}

/// White wires side by side that extend above and below the image.
struct Wires {
    size: [u32; 2],
    stage: Stage,
    /// Expected sum of the colours of a row.
    energy: f64,
}

impl Wires {
    fn new(width: f64, height: u32) -> Self {
        let pitch = PITCH * f64::from(height);
        let size = [(pitch * LEANS.len() as f64) as u32, height];
        let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
        let mut energy = 0.0;
        for (index, lean) in LEANS.into_iter().enumerate() {
            let middle = (index as f64 + 0.5) * pitch - f64::from(size[0]) / 2.0;
            let slope = lean.to_radians().tan();
            // Width of a slanted wire along a row.
            let across = width / lean.to_radians().cos();
            let end = f64::from(size[1]);
            let place = |x: f64, y: f64| seen_at([middle + x + slope * y, y], 2.0, size[1]);
            let half = 0.5 * across;
            stage.add_quad(0, [place(-half, -end), place(half, -end), place(half, end), place(-half, end)]);
            energy += across;
        }
        Self { size, stage, energy }
    }

    /// Pans right by one pixel, and down by less, in `frames` steps. Returns the largest relative error of an image's
    /// brightness, and the root mean squared relative error of a row's brightness.
    fn pan(&self, headless: &mut Headless, settings: &Settings, frames: u32) -> Result<[f64; 2], RenderError> {
        let (scene, pose) = self.stage.build();
        let prepared = headless.upload(SceneRequest::new(&scene, &pose))?;
        let mut frame = headless.prepare(&prepared, settings)?;
        let [columns, rows] = self.size.map(|side| side as usize);
        let mut worst = 0.0_f64;
        let mut squares = 0.0;
        for step in 0..frames {
            let way = f64::from(step) / f64::from(frames);
            let pixels = DVec2::new(way, 0.37 * way);
            let camera = Camera { shift: pixels / DVec2::new(columns as f64, rows as f64), ..camera() };
            let image = headless.render(&mut frame, &camera)?;
            let mut whole = 0.0;
            for row in image.colors.chunks_exact(columns) {
                let energy: f64 = row.iter().map(|color| f64::from(color[0])).sum();
                squares += (energy / self.energy - 1.0).powi(2);
                whole += energy;
            }
            worst = worst.max((whole / (self.energy * rows as f64) - 1.0).abs());
        }
        Ok([worst, (squares / (f64::from(frames) * rows as f64)).sqrt()])
    }
}

//! Stress check: interpolated attributes stay within the range of the vertices' values, for slivers, for triangles
//! with vertices behind the eye, and for triangles smaller than pixels.

use super::meshes::{Depths, delaunay, fan, ground, slivers};
use super::stage::{Stage, camera, everywhere, flat};
use super::{Finding, Length};
use gpc::render::{Headless, Method, RenderError, SceneRequest, Shading};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;
use gpc::testing::Random;

/// Range of the vertices' colours.
const RANGE: [f32; 2] = [0.25, 0.75];
/// Largest distance of a colour from the range: rounding of floats with 24 bits, summed over samples.
const ROUNDING: f64 = 1e-5;

pub(super) fn check(headless: &mut Headless, length: Length) -> Result<Vec<Finding>, RenderError> {
    let side = length.choose(40, 200);
    let half = f64::from(side) / 2.0;
    let meshes = [
        fan(3, half, 48, Depths::Random),
        slivers(3, half, 60, Depths::Random),
        delaunay(3, half, length.choose(60, 400), Depths::Random),
        ground(3, half, 2.0, 24),
    ];
    let sampled =
        |shading| everywhere([side; 2], Pattern::Sobol, 16).map_superpixels(|options| options.shading(shading));
    let one = sampled(Shading::Triangle).method(Method::None);
    let methods = [
        ("one sample", one),
        ("shaded once a triangle", sampled(Shading::Triangle)),
        ("shaded once a sample", sampled(Shading::Sample)),
    ];
    let mut findings = Vec::new();
    for mesh in meshes {
        let mut stage = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
        stage.add_mesh(0, &mesh, side, |triangle| triangle);
        let (scene, mut pose) = stage.build();
        let mut random = Random::new(8);
        let [low, high] = RANGE.map(f64::from);
        pose.geometry.streams.colors = (pose.geometry.positions.iter())
            .map(|_| [0; 3].map(|_| random.range(low, high) as f32))
            .map(|[r, g, b]| [r, g, b, 1.0])
            .collect();
        let prepared = headless.upload(SceneRequest::new(&scene, &pose))?;
        for (name, settings) in &methods {
            let mut frame = headless.prepare(&prepared, settings)?;
            let image = headless.render(&mut frame, &camera())?;
            let excess = |[r, g, b, a]: &[f32; 4]| {
                let worst = |v: &f32| (RANGE[0] * a - v).max(v - RANGE[1] * a);
                // `f32::max` ignores NaN, but a sum keeps it.
                let parts = [r, g, b].map(worst);
                let sum: f32 = parts.iter().sum();
                if sum.is_nan() { f64::INFINITY } else { f64::from(parts.into_iter().fold(0.0, f32::max)) }
            };
            findings.push(Finding {
                case: format!("{}, {name}", mesh.name),
                checked: image.colors.len() as u64,
                unit: "colour out of range",
                measured: image.colors.iter().map(excess).fold(0.0, f64::max),
                allowed: Some(ROUNDING),
            });
        }
    }
    Ok(findings)
}

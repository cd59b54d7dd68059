//! Stress check: triangles of a tiling hit each sample exactly once (partition of unity).

use super::counting::{Hits, count};
use super::meshes::{ground, tilings};
use super::stage::{Stage, camera, everywhere};
use super::{Finding, Length, Mesh};
use gpc::render::{Detection, Headless, RenderError, Settings};
use gpc::sampling::Pattern;

/// Samples a pixel of each run.
const COUNTS: [u32; 6] = [1, 4, 16, 64, 256, 1024];

/// Row below the image's centre from which [`ground`] covers the image.
const HORIZON: f64 = 2.0;

pub(super) fn check(headless: &mut Headless, length: Length) -> Result<Vec<Finding>, RenderError> {
    let mut findings = Vec::new();
    for samples in COUNTS {
        // All images have about the same number of samples.
        let side = length.choose(128, 1472) / samples.isqrt();
        let settings = everywhere([side; 2], Pattern::Sobol, samples);
        let mut hits = Hits::default();
        for mesh in tilings(u64::from(samples), f64::from(side) / 2.0) {
            hits.add(of_mesh(headless, &mesh, &settings, |_| true)?);
        }
        report(&mut findings, &format!("tilings, {samples} samples"), hits);
    }
    for samples in length.choose(&[4, 64][..], &COUNTS) {
        let side = length.choose(96, 768) / samples.isqrt();
        let settings = everywhere([side; 2], Pattern::Lattice, *samples);
        let half = f64::from(side) / 2.0;
        let mesh = ground(u64::from(*samples), half, HORIZON, length.choose(12, 48));
        let below = |[_, row]: [u32; 2]| f64::from(row) >= half + HORIZON;
        let hits = of_mesh(headless, &mesh, &settings, below)?;
        let case = format!("plane through the eye, cut by the near plane, {samples} samples");
        report(&mut findings, &case, hits);
    }
    for samples in [4, 64] {
        // Triangles are larger than pixels, so that superpixels and ordinary pixels lie side by side.
        let settings = everywhere([length.choose(96, 512); 2], Pattern::Sobol, samples)
            .map_superpixels(|options| options.detection(Detection::Exact));
        let mut hits = Hits::default();
        for mesh in tilings(1, f64::from(settings.size[0]) / 2.0) {
            hits.add(of_mesh(headless, &mesh, &settings, |_| true)?);
        }
        let case = format!("across the borders of superpixels, {samples} samples");
        report(&mut findings, &case, hits);
    }
    Ok(findings)
}

/// Counts the hits of a mesh's triangles, whose vertices are in all orders.
fn of_mesh(
    headless: &mut Headless,
    mesh: &Mesh,
    settings: &Settings,
    counts: impl Fn([u32; 2]) -> bool,
) -> Result<Hits, RenderError> {
    let mut stage = Stage::default();
    stage.add_mesh(0, mesh, settings.size[1], |triangle| triangle);
    count(headless, &stage, settings, &camera(), counts)
}

/// Adds findings about holes and double hits, neither of which is allowed.
pub(super) fn report(findings: &mut Vec<Finding>, case: &str, hits: Hits) {
    for (unit, measured) in [("samples without a hit", hits.holes), ("hits other than one", hits.excess)] {
        findings.push(Finding { case: case.to_owned(), checked: hits.samples, unit, measured, allowed: Some(0.0) });
    }
}

//! Stress check: surfaces in the same place.

use super::meshes::{Depths, delaunay};
use super::stage::{Stage, everywhere, flat, once};
use super::{Finding, Length};
use gpc::render::{Headless, RenderError, Rendered};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;
use gpc::testing::Random;

pub(super) fn check(headless: &mut Headless, length: Length) -> Result<Vec<Finding>, RenderError> {
    let size = [length.choose(64, 512); 2];
    let mesh = delaunay(6, f64::from(size[0]) / 2.0, length.choose(12, 60), Depths::Random);
    let mut plain = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]);
    plain.add_mesh(0, &mesh, size[1], |triangle| triangle);
    let mut findings = Vec::new();
    for (turns, what) in [(0, "duplicates"), (1, "duplicates begun at another vertex")] {
        let stage = with_duplicates(&plain, turns);
        let raster = stage.render(headless, &once(size))?;
        // A grid of one sample lies at the pixel's centre.
        let sampled = stage.render(headless, &everywhere(size, Pattern::Grid, 1))?;
        let [raster, sampled] = [&raster, &sampled].map(winners);
        let share = |count: usize| count as f64 / raster.len() as f64;
        let duplicates = |winners: &[bool]| share(winners.iter().filter(|first| !**first).count());
        let disagree = raster.iter().zip(&sampled).filter(|(a, b)| a != b).count();
        for (unit, measured) in [
            ("share of pixels that show the later one, first pass", duplicates(&raster)),
            ("share of pixels that show the later one, samples", duplicates(&sampled)),
            ("share of pixels in which the passes disagree", share(disagree)),
        ] {
            findings.push(Finding {
                case: what.to_owned(),
                checked: raster.len() as u64,
                unit,
                measured,
                allowed: Some(0.0),
            });
        }
    }
    Ok(findings)
}

/// Stage of the white triangles of `plain`, followed by black copies in another order whose vertices are rotated by
/// `turns`.
fn with_duplicates(plain: &Stage, turns: usize) -> Stage {
    let mut stage = plain.clone();
    let mut duplicates = plain.triangles.clone();
    Random::new(3).shuffle(&mut duplicates);
    for triangle in &mut duplicates {
        triangle.color = [0.0, 0.0, 0.0, 1.0];
        triangle.corners.rotate_left(turns);
    }
    stage.triangles.extend(duplicates);
    stage
}

/// Whether each pixel shows a white triangle rather than a black one.
fn winners(image: &Rendered) -> Vec<bool> {
    image.colors.iter().map(|color| color[0] > 0.5).collect()
}

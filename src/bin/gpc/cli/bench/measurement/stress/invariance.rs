//! Stress check: changes of settings and scenes that must not change an image.

use super::difference::same;
use super::stage::{Stage, everywhere};
use super::{Finding, Length, soup};
use gpc::render::{EngineError, Headless, RenderError, Rendered, Settings};
use gpc::sampling::Pattern;
use gpc::testing::Random;

/// Samples of a superpixel.
const SAMPLES: u32 = 16;

pub(super) fn check(headless: &mut Headless, length: Length) -> Result<Vec<Finding>, RenderError> {
    let size = length.choose([96, 64], [384, 240]);
    let (count, blend) = length.choose((300, 40), (3000, 150));
    let stage = soup(1, size, count, blend);
    let settings = everywhere(size, Pattern::Sobol, SAMPLES);
    let first = stage.render(headless, &settings)?;
    let again = stage.render(headless, &settings)?;
    let mut findings = vec![same("another run", &first, &again)];
    for seed in 0..2 {
        let mut shuffled = stage.clone();
        let (opaque, blended) = shuffled.triangles.split_at_mut(count - blend);
        let mut random = Random::new(seed);
        random.shuffle(opaque);
        random.shuffle(blended);
        let image = shuffled.render(headless, &settings)?;
        findings.push(same(format!("another order of triangles, {seed}"), &first, &image));
    }
    for turns in [1, 2] {
        let mut turned = stage.clone();
        for triangle in &mut turned.triangles {
            triangle.corners.rotate_left(turns);
        }
        let image = turned.render(headless, &settings)?;
        findings.push(same(format!("vertices turned by {turns}"), &first, &image));
    }
    less_memory(headless, &stage, &settings, &first, &mut findings)?;
    Ok(findings)
}

/// Renders with the memory limit reduced by a quarter each time, until it is too small.
fn less_memory(
    headless: &mut Headless,
    stage: &Stage,
    settings: &Settings,
    first: &Rendered,
    findings: &mut Vec<Finding>,
) -> Result<(), RenderError> {
    let mut used = first.statistics.memory_bytes;
    loop {
        let less = settings.clone().max_memory(Some(used / 4 * 3));
        let image = match stage.render(headless, &less) {
            Err(RenderError::Engine(EngineError::Memory { .. } | EngineError::Unfinished { .. })) => return Ok(()),
            done => done?,
        };
        used = image.statistics.memory_bytes;
        let case = format!(
            "{:.0} % of the memory, {} regions, {} rounds",
            100.0 * used as f64 / first.statistics.memory_bytes as f64,
            image.statistics.regions,
            image.statistics.rounds
        );
        findings.push(same(case, first, &image));
    }
}

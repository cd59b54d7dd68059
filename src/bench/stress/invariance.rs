//! What must not change an image.

use super::difference::same;
use super::stage::{Stage, everywhere};
use super::{Finding, Length, Random, soup};
use crate::render::{Headless, RenderError, Settings};
use crate::sampling::Pattern;

/// Samples a superpixel.
const SAMPLES: u32 = 16;

pub(super) fn check(headless: &mut Headless, length: Length) -> Result<Vec<Finding>, RenderError> {
    let size = length.choose([96, 64], [640, 400]);
    let (count, blend) = length.choose((300, 40), (8000, 400));
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
        findings.push(same(
            format!("another order of triangles, {seed}"),
            &first,
            &image,
        ));
    }
    for turns in [1, 2] {
        let image = turned(&stage, turns).render(headless, &settings)?;
        findings.push(same(format!("vertices turned by {turns}"), &first, &image));
    }
    let used = first.statistics.memory_bytes;
    for quarters in [3, 2] {
        let less = Settings {
            max_memory: Some(used / 4 * quarters),
            ..settings.clone()
        };
        let image = stage.render(headless, &less)?;
        let regions = image.statistics.regions;
        let case = format!("{quarters}/4 of the memory, {regions} regions");
        findings.push(same(case, &first, &image));
    }
    Ok(findings)
}

fn turned(stage: &Stage, turns: usize) -> Stage {
    let mut turned = stage.clone();
    for triangle in &mut turned.triangles {
        triangle.corners.rotate_left(turns);
    }
    turned
}

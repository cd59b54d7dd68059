//! Ratios over all scenes.

use super::results::{Row, SceneResults};
use crate::cli::render::Antialiasing;
use gpc::bench::Spread;
use serde::Serialize;

/// What superpixels cost and remove at one number of samples. Medians are over the scenes that have both rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AtSamples {
    pub samples: u32,
    /// Scenes with superpixels at this number of samples.
    pub scenes: usize,
    /// Median time of the device under supersampling over that with superpixels.
    pub speedup: Option<f64>,
    /// Median time with superpixels over that of one sample a pixel.
    pub over_none: Option<f64>,
    /// Median RMSE (as a display shows it) with superpixels over that of supersampling.
    pub rmse_ratio: Option<f64>,
    /// The scene where that ratio is largest, and the ratio.
    pub worst_rmse_ratio: Option<(String, f64)>,
    /// Median share of the aliasing error removed.
    pub removed: Option<f64>,
}

/// Sums up the scenes, a line for each number of samples that superpixels were measured with.
pub fn summarize(scenes: &[SceneResults]) -> Vec<AtSamples> {
    let superpixels = |row: &&Row| row.method == Antialiasing::Superpixel;
    let rows = scenes.iter().flat_map(|scene| &scene.rows);
    let mut counts: Vec<_> = rows.filter(superpixels).map(|row| row.samples).collect();
    counts.sort_unstable();
    counts.dedup();
    counts.iter().map(|count| at(scenes, *count)).collect()
}

fn at(scenes: &[SceneResults], samples: u32) -> AtSamples {
    let each =
        |ratio: &dyn Fn(&SceneResults) -> Option<f64>| median(scenes.iter().filter_map(ratio));
    let ratios = scenes
        .iter()
        .filter_map(|scene| Some((scene.name.clone(), rmse_ratio(scene, samples)?)));
    AtSamples {
        samples,
        scenes: scenes
            .iter()
            .filter(|scene| scene.row(Antialiasing::Superpixel, samples).is_some())
            .count(),
        speedup: each(&|scene| speedup(scene, samples)),
        over_none: each(&|scene| over_none(scene, samples)),
        rmse_ratio: each(&|scene| rmse_ratio(scene, samples)),
        worst_rmse_ratio: ratios.max_by(|a, b| a.1.total_cmp(&b.1)),
        removed: each(&|scene| {
            let row = scene.row(Antialiasing::Superpixel, samples)?;
            Some(row.accuracy.removed)
        }),
    }
}

/// Time under supersampling over that with superpixels.
pub fn speedup(scene: &SceneResults, samples: u32) -> Option<f64> {
    let ssaa = scene.row(Antialiasing::Ssaa, samples)?;
    let superpixel = scene.row(Antialiasing::Superpixel, samples)?;
    ratio(ssaa.cost.gpu_ms.median, superpixel.cost.gpu_ms.median)
}

/// Time with superpixels over that of one sample a pixel.
pub fn over_none(scene: &SceneResults, samples: u32) -> Option<f64> {
    let superpixel = scene.row(Antialiasing::Superpixel, samples)?;
    let none = scene.row(Antialiasing::None, 1)?;
    ratio(superpixel.cost.gpu_ms.median, none.cost.gpu_ms.median)
}

/// RMSE with superpixels over that of supersampling.
pub fn rmse_ratio(scene: &SceneResults, samples: u32) -> Option<f64> {
    let superpixel = scene.row(Antialiasing::Superpixel, samples)?;
    let ssaa = scene.row(Antialiasing::Ssaa, samples)?;
    ratio(superpixel.accuracy.rmse, ssaa.accuracy.rmse)
}

fn ratio(above: f64, below: f64) -> Option<f64> {
    (below > 0.0).then(|| above / below)
}

fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let spread = Spread::of(values);
    (spread.count > 0).then_some(spread.median)
}

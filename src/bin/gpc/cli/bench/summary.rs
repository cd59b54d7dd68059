//! Ratios over all scenes, those with and those without textures separately.

use super::front::{TARGETS, time_to_error};
use super::results::{Row, SceneResults};
use super::split::shares;
use gpc::bench::Spread;
use gpc::render::{CellOptions, MethodKind};
use serde::Serialize;

/// Summary of the scenes with textures, or of those without.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Whether the summarised scenes have textures.
    pub textured: bool,
    /// Number of scenes.
    pub scenes: usize,
    /// Ratios at each number of samples that superpixels were measured with.
    pub at: Vec<AtSamples>,
    /// Times to reach the error of supersampling, at each of its numbers of samples.
    pub reach: Vec<TimeToMatch>,
}

/// Cost and accuracy of superpixels at one number of samples. Each median is taken over the scenes that have both
/// rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AtSamples {
    pub samples: u32,
    /// Scenes with superpixels at this number of samples.
    pub scenes: usize,
    /// Median of supersampling time / superpixel time, on the device.
    pub speedup: Option<f64>,
    /// Median of superpixel time / time of one sample a pixel, on the device.
    pub over_none: Option<f64>,
    /// Superpixel RMSE / supersampling RMSE against the reference, in sRGB-encoded values.
    pub rmse_ratio: Option<Ratio>,
    /// Superpixel FLIP / supersampling FLIP.
    pub flip_ratio: Option<Ratio>,
    /// Superpixel RMSE / supersampling RMSE of geometry alone.
    pub geometry_ratio: Option<Ratio>,
    /// Median share of the aliasing error that superpixels remove.
    pub removed: Option<f64>,
}

/// A ratio's median and largest value over all scenes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ratio {
    pub median: f64,
    /// Largest ratio.
    pub worst: f64,
    /// Name of the scene with the largest ratio.
    pub worst_scene: String,
}

/// Superpixel time / supersampling time, at the error of supersampling.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimeToMatch {
    /// Samples a pixel of supersampling, whose error is the goal.
    pub samples: u32,
    /// The median ratio; `None` if at least half of the scenes never reach the error.
    pub share: Option<f64>,
    /// Scenes for which the ratio was measured, with their ratios; `None` if superpixels never reach the error.
    pub scenes: Vec<(String, Option<f64>)>,
}

/// Summaries of the scenes: those with textures first, then those without.
pub fn summarize(scenes: &[SceneResults]) -> Vec<Summary> {
    [true, false]
        .into_iter()
        .filter_map(|textured| {
            let mine: Vec<_> = scenes.iter().filter(|s| s.textured == textured).collect();
            let counts = counts(mine.iter().copied());
            (!counts.is_empty()).then(|| Summary {
                textured,
                scenes: mine.len(),
                at: counts.iter().map(|count| at(&mine, *count)).collect(),
                reach: TARGETS.into_iter().filter_map(|samples| reach(&mine, samples)).collect(),
            })
        })
        .collect()
}

/// Numbers of samples that superpixels were measured with.
pub fn counts<'a>(scenes: impl IntoIterator<Item = &'a SceneResults>) -> Vec<u32> {
    let rows = scenes.into_iter().flat_map(|scene| &scene.rows);
    let superpixels = rows.filter(|row: &&Row| row.method == MethodKind::Superpixel);
    let mut counts: Vec<_> = superpixels.map(|row| row.samples).collect();
    counts.sort_unstable();
    counts.dedup();
    counts
}

impl Summary {
    /// Phrase for the summarised scenes: their number, and whether they are textured.
    pub fn about(&self) -> String {
        let kind = if self.textured { "textured" } else { "untextured" };
        let scenes = if self.scenes == 1 { "scene" } else { "scenes" };
        format!("{} {kind} {scenes}", self.scenes)
    }
}

fn at(scenes: &[&SceneResults], samples: u32) -> AtSamples {
    let each = |ratio: &dyn Fn(&SceneResults) -> Option<f64>| median(scenes.iter().filter_map(|s| ratio(s)));
    let row = |scene: &SceneResults| {
        let row = scene.row(MethodKind::Superpixel, samples)?;
        Some(row.accuracy.removed)
    };
    AtSamples {
        samples,
        scenes: scenes.iter().filter(|scene| row(scene).is_some()).count(),
        speedup: each(&|scene| speedup(scene, samples)),
        over_none: each(&|scene| over_none(scene, samples)),
        rmse_ratio: Ratio::over(scenes, |scene| rmse_ratio(scene, samples)),
        flip_ratio: Ratio::over(scenes, |scene| flip_ratio(scene, samples)),
        geometry_ratio: Ratio::over(scenes, |scene| geometry_ratio(scene, samples)),
        removed: each(&row),
    }
}

fn reach(scenes: &[&SceneResults], samples: u32) -> Option<TimeToMatch> {
    let scenes: Vec<_> =
        scenes.iter().filter_map(|scene| Some((scene.name.clone(), time_to_error(scene, samples)?))).collect();
    let shares = scenes.iter().map(|(_, share)| share.unwrap_or(f64::INFINITY));
    let share = median(shares)?;
    Some(TimeToMatch { samples, share: share.is_finite().then_some(share), scenes })
}

impl Ratio {
    fn over(scenes: &[&SceneResults], ratio: impl Fn(&SceneResults) -> Option<f64>) -> Option<Self> {
        Self::of(scenes.iter().filter_map(|scene| Some((scene.name.clone(), ratio(scene)?, 1.0))))
    }

    /// Median and largest of the ratios `first / second` of named pairs. A pair whose second number is 0 is left out.
    pub fn of(pairs: impl IntoIterator<Item = (String, f64, f64)>) -> Option<Self> {
        let ratios: Vec<_> =
            pairs.into_iter().filter_map(|(name, above, below)| Some((ratio(above, below)?, name))).collect();
        let (worst, worst_scene) = ratios.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Self {
            median: median(ratios.iter().map(|(ratio, _)| *ratio))?,
            worst: *worst,
            worst_scene: worst_scene.clone(),
        })
    }
}

/// Supersampling time / superpixel time.
pub fn speedup(scene: &SceneResults, samples: u32) -> Option<f64> {
    let ssaa = scene.row(MethodKind::Ssaa, samples)?;
    let superpixel = scene.row(MethodKind::Superpixel, samples)?;
    ratio(ssaa.cost.gpu_ms.median, superpixel.cost.gpu_ms.median)
}

/// Superpixel time / time of one sample a pixel.
pub fn over_none(scene: &SceneResults, samples: u32) -> Option<f64> {
    let superpixel = scene.row(MethodKind::Superpixel, samples)?;
    let none = scene.row(MethodKind::None, 1)?;
    ratio(superpixel.cost.gpu_ms.median, none.cost.gpu_ms.median)
}

/// Superpixel RMSE / supersampling RMSE.
pub fn rmse_ratio(scene: &SceneResults, samples: u32) -> Option<f64> {
    let superpixel = scene.row(MethodKind::Superpixel, samples)?;
    let ssaa = scene.row(MethodKind::Ssaa, samples)?;
    ratio(superpixel.accuracy.rmse, ssaa.accuracy.rmse)
}

/// Superpixel FLIP / supersampling FLIP.
fn flip_ratio(scene: &SceneResults, samples: u32) -> Option<f64> {
    let superpixel = scene.row(MethodKind::Superpixel, samples)?;
    let ssaa = scene.row(MethodKind::Ssaa, samples)?;
    ratio(superpixel.accuracy.flip, ssaa.accuracy.flip)
}

/// Largest part of the squared error that superpixels leave, and its share. The number of samples is the default, or
/// otherwise the largest that was measured.
pub fn most_of_what_is_left(scene: &SceneResults) -> Option<(&'static str, f64)> {
    let superpixels = |row: &&Row| row.method == MethodKind::Superpixel;
    let row = scene
        .rows
        .iter()
        .filter(superpixels)
        .max_by_key(|row| (row.samples == CellOptions::DEFAULT_SAMPLES, row.samples))?;
    let (left, within) = (row.left?, row.left_within?);
    let causes = shares(&left, &within);
    let whole: f64 = causes.iter().map(|(_, share)| share).sum();
    let (name, share) = causes.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((name, ratio(share, whole)?))
}

/// Superpixel RMSE / supersampling RMSE of geometry alone.
pub fn geometry_ratio(scene: &SceneResults, samples: u32) -> Option<f64> {
    let superpixel = scene.row(MethodKind::Superpixel, samples)?;
    let ssaa = scene.row(MethodKind::Ssaa, samples)?;
    ratio(superpixel.geometry?.rmse, ssaa.geometry?.rmse)
}

fn ratio(above: f64, below: f64) -> Option<f64> {
    (below > 0.0).then(|| above / below)
}

fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let spread = Spread::of(values);
    (spread.count > 0).then_some(spread.median)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::bench::{Accuracy, Cost};

    fn scene(name: &str, textured: bool, rows: &[(MethodKind, u32, f64, f64)]) -> SceneResults {
        let row = |&(method, samples, ms, rmse): &(MethodKind, u32, f64, f64)| Row {
            method,
            samples,
            cost: Cost { gpu_ms: Spread::of([ms]), wall_ms: Spread::of([ms]), passes: Vec::new() },
            memory_bytes: 1,
            superpixel_fraction: 0.5,
            candidates: 1,
            accuracy: Accuracy { rmse, ..Accuracy::default() },
            geometry: None,
            left: None,
            left_within: None,
        };
        SceneResults {
            name: name.to_owned(),
            file: name.to_owned(),
            triangles: 1,
            textured,
            surface_fraction: 1.0,
            reference_seconds: None,
            notes: Vec::new(),
            rows: rows.iter().map(row).collect(),
        }
    }

    #[test]
    fn untextured_scenes_do_not_flatter() {
        use MethodKind::{Ssaa, Superpixel};
        let scenes = [
            scene("paint", true, &[(Ssaa, 64, 100.0, 0.01), (Superpixel, 64, 10.0, 0.04)]),
            scene("cloth", true, &[(Ssaa, 64, 100.0, 0.01), (Superpixel, 64, 20.0, 0.02)]),
            scene("metal", false, &[(Ssaa, 64, 90.0, 0.01), (Superpixel, 64, 9.0, 0.01)]),
        ];
        let [textured, untextured] = summarize(&scenes).try_into().unwrap();
        assert!(textured.textured && textured.scenes == 2 && untextured.scenes == 1);
        let expected = Ratio { median: 3.0, worst: 4.0, worst_scene: "paint".to_owned() };
        assert_eq!(textured.at[0].rmse_ratio.as_ref(), Some(&expected));
        assert_eq!(textured.at[0].speedup, Some(7.5));
        assert_eq!(textured.at[0].geometry_ratio, None);
        // Neither textured scene reaches the error of supersampling; the untextured one does, in a tenth of the time.
        assert_eq!(textured.reach[0].share, None);
        assert_eq!(untextured.reach[0].share, Some(0.1));
        assert_eq!(untextured.reach.len(), 1, "256 samples were not measured");
    }
}

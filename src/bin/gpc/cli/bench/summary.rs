//! Ratios over all scenes, those with and those without textures separately.

use super::columns::{Cell, Column, Study, column};
use super::front::{TARGETS, ratio_at_equal_time, time_to_error};
use super::measurement::Spread;
use super::results::{Row, SceneResults};
use gpc::render::MethodKind;
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
    /// Superpixel RMSE / the RMSE that brute force reaches in the same time.
    pub equal_time_ratio: Option<Ratio>,
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
fn counts<'a>(scenes: impl IntoIterator<Item = &'a SceneResults>) -> Vec<u32> {
    let rows = scenes.into_iter().flat_map(|scene| &scene.rows);
    let superpixels = rows.filter(|row: &&Row| row.method == MethodKind::Superpixel);
    let mut counts: Vec<_> = superpixels.map(|row| row.samples).collect();
    counts.sort_unstable();
    counts.dedup();
    counts
}

impl Study for Summary {
    type Row = AtSamples;
    const FILE: &'static str = "summary.csv";

    fn title(&self) -> String {
        let kind = if self.textured { "textured" } else { "untextured" };
        let scenes = if self.scenes == 1 { "scene" } else { "scenes" };
        format!("superpixel, medians of {} {kind} {scenes}", self.scenes)
    }

    /// The shares of supersampling's time in which superpixels reach its error.
    fn notes(&self) -> Vec<String> {
        let note = |reach: &TimeToMatch| {
            let never = reach.scenes.iter().filter(|(_, share)| share.is_none()).count();
            let share = reach.share.map_or_else(|| "never".to_owned(), |share| format!("{:.1} %", 100.0 * share));
            let scenes = reach.scenes.len();
            format!("share of its time until ssaa {}'s error: {share} (never on {never} of {scenes})", reach.samples)
        };
        self.reach.iter().map(note).collect()
    }

    fn rows(&self) -> &[AtSamples] {
        &self.at
    }

    fn columns() -> Vec<Column<Self, AtSamples>> {
        let keys = [
            column("textured", "", |summary: &Self, _| Cell::text(summary.textured)),
            column("samples", "N", |_, row: &AtSamples| Cell::Count(row.samples.into())),
            column("scenes", "scenes", |_, row: &AtSamples| Cell::Count(row.scenes as u64)),
        ];
        let number = |name, heading, value: fn(&AtSamples) -> Option<f64>| {
            column(name, heading, move |_: &Self, row| Cell::optional(value(row), |value| Cell::Number(value, 2)))
        };
        let ratio = |[name, worst]: [&'static str; 2], heading, of: fn(&AtSamples) -> Option<&Ratio>| {
            [
                column(name, heading, move |_: &Self, row| Cell::optional(of(row), |of| Cell::Number(of.median, 2))),
                column(worst, "worst", move |_: &Self, row| Cell::optional(of(row), |of| Cell::Number(of.worst, 2))),
            ]
        };
        let ratios = [
            ratio(["rmse_ratio", "rmse_ratio_worst"], "RMSE over ssaa's", |row| row.rmse_ratio.as_ref()),
            ratio(["flip_ratio", "flip_ratio_worst"], "FLIP over ssaa's", |row| row.flip_ratio.as_ref()),
            ratio(["geometry_ratio", "geometry_ratio_worst"], "geometry alone", |row| row.geometry_ratio.as_ref()),
            ratio(["equal_time_ratio", "equal_time_ratio_worst"], "RMSE at equal time", |row| {
                row.equal_time_ratio.as_ref()
            }),
        ];
        let figures = [
            column("removed", "removed", |_: &Self, row: &AtSamples| {
                Cell::optional(row.removed, |share| Cell::Percent(share, 1))
            }),
            number("speedup", "ssaa/superpixel", |row| row.speedup),
            number("over_none", "superpixel/none", |row| row.over_none),
        ];
        keys.into_iter().chain(ratios.into_iter().flatten()).chain(figures).collect()
    }
}

fn at(scenes: &[&SceneResults], samples: u32) -> AtSamples {
    let (superpixel, ssaa, none) =
        ((MethodKind::Superpixel, samples), (MethodKind::Ssaa, samples), (MethodKind::None, 1));
    type Value = fn(&Row) -> Option<f64>;
    let of = |scene: &SceneResults, (method, samples), value: Value| scene.row(method, samples).and_then(value);
    let over = |above, below, value: Value| {
        move |scene: &SceneResults| ratio(of(scene, above, value)?, of(scene, below, value)?)
    };
    let each = |ratio: &dyn Fn(&SceneResults) -> Option<f64>| median(scenes.iter().filter_map(|s| ratio(s)));
    let time: Value = |row| Some(row.cost.gpu_ms.median);
    AtSamples {
        samples,
        scenes: scenes.iter().filter(|scene| scene.row(MethodKind::Superpixel, samples).is_some()).count(),
        speedup: each(&over(ssaa, superpixel, time)),
        over_none: each(&over(superpixel, none, time)),
        rmse_ratio: Ratio::over(scenes, over(superpixel, ssaa, |row| Some(row.accuracy.rmse))),
        flip_ratio: Ratio::over(scenes, over(superpixel, ssaa, |row| Some(row.accuracy.flip))),
        equal_time_ratio: Ratio::over(scenes, |scene| {
            ratio_at_equal_time(scene, scene.row(MethodKind::Superpixel, samples)?)
        }),
        geometry_ratio: Ratio::over(scenes, over(superpixel, ssaa, |row| Some(row.geometry?.rmse))),
        removed: each(&|scene| of(scene, superpixel, |row| Some(row.accuracy.removed))),
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
    use crate::cli::bench::gallery::Gallery;
    use crate::cli::bench::measurement::{Accuracy, Cost};

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
            gallery: Gallery::default(),
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

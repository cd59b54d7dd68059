//! The most important figure: how fast superpixels reach the error of supersampling.

use crate::by_scene;
use crate::data::{Measurement, Row, Spread};
use crate::text::short;

/// Time in which superpixels reach the RMSE of supersampling with `samples` samples, over the time of supersampling. Of the
/// numbers of samples that reach it, the fastest counts; the share is 1 if none does.
fn share(of: &Measurement, scene: &str, samples: u32) -> Option<f64> {
    let target = of.find(scene, "ssaa", samples)?;
    let tried = of.samples("superpixel");
    let rows = tried.iter().filter_map(|n| of.find(scene, "superpixel", *n));
    let reached = rows.filter(|row| row.number("rmse") <= target.number("rmse"));
    let fastest = reached.map(Row::ms).fold(f64::INFINITY, f64::min);
    Some((fastest / target.ms()).min(1.0))
}

/// The share of each scene.
pub fn shares<'a>(of: &'a Measurement, scenes: &[&'a str], samples: u32) -> Option<Spread<'a>> {
    by_scene::spread_of(share, of, scenes, samples)
}

/// Table of the shares, scene by scene and in the median.
pub fn table() -> String {
    by_scene::tables(&[], share, percent)
}

fn percent(share: f64) -> String {
    format!("{} %", short(100.0 * share))
}

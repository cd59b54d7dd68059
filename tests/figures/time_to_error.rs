//! The most important figure: how fast superpixels reach the error of supersampling.

use crate::data::{Measurement, Row, Spread, spread};

/// Time in which superpixels reach the RMSE of supersampling with `samples` samples, over the time of supersampling. Of the
/// numbers of samples that reach it, the fastest counts; the share is 1 if none does.
pub fn share(of: &Measurement, scene: &str, samples: u32) -> Option<f64> {
    let target = of.find(scene, "ssaa", samples)?;
    let tried = of.samples("superpixel");
    let rows = tried.iter().filter_map(|n| of.find(scene, "superpixel", *n));
    let reached = rows.filter(|row| row.number("rmse") <= target.number("rmse"));
    let fastest = reached.map(Row::ms).fold(f64::INFINITY, f64::min);
    Some((fastest / target.ms()).min(1.0))
}

/// Median and worst of the shares of some scenes.
pub fn shares<'a>(of: &Measurement, scenes: &[&'a str], samples: u32) -> Option<Spread<'a>> {
    let measured = |scene: &&'a str| Some((share(of, scene, samples)?, *scene));
    spread(scenes.iter().filter_map(measured).collect())
}

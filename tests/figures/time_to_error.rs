//! The most important figures: how fast superpixels reach the error of supersampling, and their error beside that of brute force
//! in the same time.

use crate::data::{Measurement, Row, Spread, spread};

#[path = "../../src/bin/gpc/cli/bench/pareto.rs"]
#[allow(dead_code, reason = "`gpc bench` uses the rest")]
mod pareto;

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

/// Methods that sample every pixel alike.
const BRUTE: [&str; 4] = ["none", "ssaa", "accumulate", "rotated"];

/// Error of superpixels, divided by the error that brute force reaches in the same time. `None` if brute force was not measured at
/// shorter and at longer times.
pub fn at_equal_time(of: &Measurement, scene: &str, samples: u32, error: fn(&Row) -> f64) -> Option<f64> {
    let fine = of.find(scene, "superpixel", samples)?;
    let rows = of.rows.iter().filter(|row| row.scene() == scene && BRUTE.contains(&row.text("method")));
    let brute = rows.map(|row| [row.ms(), error(row)]).collect();
    Some(error(fine) / pareto::error_at(&pareto::front(brute), fine.ms())?)
}

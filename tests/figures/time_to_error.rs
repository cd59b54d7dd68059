//! The most important figures: how fast superpixels reach the error of supersampling, and their error beside that of brute force
//! in the same time.

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

/// Methods that sample every pixel alike.
const BRUTE: [&str; 4] = ["none", "ssaa", "accumulate", "rotated"];

/// Error of superpixels, divided by the error that brute force reaches in the same time. `None` if brute force was not measured at
/// shorter and at longer times.
pub fn at_equal_time(of: &Measurement, scene: &str, samples: u32, error: fn(&Row) -> f64) -> Option<f64> {
    let fine = of.find(scene, "superpixel", samples)?;
    let rows = of.rows.iter().filter(|row| row.scene() == scene && BRUTE.contains(&row.text("method")));
    let brute: Vec<_> = rows.map(|row| (row.ms(), error(row))).collect();
    Some(error(fine) / lowest_error(brute, fine.ms())?)
}

/// Error that the best of these points of (time, error) reach in `ms`, on a straight line on logarithmic axes between the two
/// points around it, among those that no other point beats in both.
fn lowest_error(mut points: Vec<(f64, f64)>, ms: f64) -> Option<f64> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut least = f64::INFINITY;
    points.retain(|(_, error)| {
        let is_better = *error < least;
        least = least.min(*error);
        is_better
    });
    let after = points.iter().position(|(time, _)| *time >= ms)?;
    let (late, low) = points[after];
    let (early, high) = *points.get(after.checked_sub(1)?)?;
    Some(high * (low / high).powf((ms / early).ln() / (late / early).ln()))
}

#[test]
fn the_error_at_a_time_lies_between_the_best_points() {
    let points = vec![(1.0, 0.1), (100.0, 0.001), (50.0, 0.2)];
    assert!((lowest_error(points.clone(), 10.0).unwrap() - 0.01).abs() < 1e-12);
    assert_eq!(lowest_error(points.clone(), 0.5), None);
    assert_eq!(lowest_error(points, 101.0), None);
}

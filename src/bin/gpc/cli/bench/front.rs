//! The Pareto front of time and error, and the time at which it reaches an error.

use super::results::{Row, SceneResults};
use gpc::render::MethodKind;

/// Numbers of samples of supersampling whose error serves as a target for superpixels.
pub const TARGETS: [u32; 2] = [64, 256];

/// Median milliseconds of a row's frame on the device.
fn time(row: &Row) -> f64 {
    row.cost.gpu_ms.median
}

/// A row's RMSE against the reference, in sRGB-encoded values.
fn error(row: &Row) -> f64 {
    row.accuracy.rmse
}

/// Times and errors of the rows that no other row beats in both, sorted by time: their Pareto front.
fn front<'a>(rows: impl IntoIterator<Item = &'a Row>) -> Vec<[f64; 2]> {
    let mut sorted: Vec<_> = rows.into_iter().collect();
    sorted.sort_by(|a, b| time(a).total_cmp(&time(b)).then(error(a).total_cmp(&error(b))));
    let mut least = f64::INFINITY;
    sorted.retain(|row| {
        let better = error(row) < least;
        least = least.min(error(row));
        better
    });
    sorted.into_iter().map(|row| [time(row), error(row)]).collect()
}

/// Superpixel time / supersampling time, at the error of supersampling with `samples` samples: the time that
/// superpixels need to reach this error. `Some(None)` if they never reach it, `None` if either was not measured.
pub fn time_to_error(scene: &SceneResults, samples: u32) -> Option<Option<f64>> {
    let goal = scene.row(MethodKind::Ssaa, samples)?;
    let rows = scene.rows.iter();
    let superpixels = rows.filter(|row| row.method == MethodKind::Superpixel);
    let points = front(superpixels);
    if points.is_empty() || time(goal) <= 0.0 {
        return None;
    }
    Some(reached(&points, error(goal)).map(|ms| ms / time(goal)))
}

/// Superpixel RMSE / the RMSE that brute force reaches in the time of this row, the best of all methods that shade every
/// sample. `None` for other methods, and if brute force was not measured at shorter and at longer times.
pub fn ratio_at_equal_time(scene: &SceneResults, row: &Row) -> Option<f64> {
    use MethodKind::{Accumulate, None as OneSample, Rotated, Ssaa, Superpixel};
    if row.method != Superpixel {
        return None;
    }
    let rivals = scene.rows.iter().filter(|row| [OneSample, Ssaa, Accumulate, Rotated].contains(&row.method));
    let rival = error_at(&front(rivals), time(row))?;
    (rival > 0.0).then(|| error(row) / rival)
}

/// Error that a front reaches in `ms`, on a straight line on logarithmic axes between two of its points; `None` before its
/// first point and beyond its last one.
fn error_at(front: &[[f64; 2]], ms: f64) -> Option<f64> {
    let after = front.iter().position(|[time, _]| *time >= ms)?;
    let [late, low] = *front.get(after)?;
    match after.checked_sub(1).and_then(|index| front.get(index)) {
        Some([early, high]) if low > 0.0 && *early > 0.0 => {
            let share = (ms / early).ln() / (late / early).ln();
            Some(high * (low / high).powf(share))
        }
        _ => (late == ms).then_some(low),
    }
}

/// Time at which a front reaches the error `goal`. `front` holds times and falling errors. Between two points the
/// front is a straight line on logarithmic axes; it ends at its last point.
fn reached(front: &[[f64; 2]], goal: f64) -> Option<f64> {
    let after = front.iter().position(|[_, error]| *error <= goal)?;
    let [late, low] = *front.get(after)?;
    let before = after.checked_sub(1).and_then(|index| front.get(index));
    Some(match before {
        // A logarithmic axis has no zero, so a line to an error of zero can't be followed.
        Some([early, high]) if low > 0.0 && *early > 0.0 => {
            let share = (high / goal).ln() / (high / low).ln();
            early * (late / early).powf(share)
        }
        _ => late,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_reached_along_the_front() {
        let front = [[1.0, 0.1], [100.0, 0.001]];
        let near = |goal: f64, expected: f64| {
            let found = reached(&front, goal).unwrap();
            assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
        };
        near(0.01, 10.0);
        near(0.001, 100.0);
        // An error that the first point reaches already costs that point's time.
        near(0.2, 1.0);
        assert_eq!(reached(&front, 0.0005), None);
        assert_eq!(reached(&[[1.0, 0.1], [5.0, 0.0]], 0.05), Some(5.0));
    }

    #[test]
    fn an_error_at_a_time_lies_on_the_front() {
        let front = [[1.0, 0.1], [100.0, 0.001]];
        assert!((error_at(&front, 10.0).unwrap() / 0.01 - 1.0).abs() < 1e-9);
        assert_eq!(error_at(&front, 1.0), Some(0.1));
        assert_eq!([error_at(&front, 0.5), error_at(&front, 101.0)], [None, None]);
    }
}

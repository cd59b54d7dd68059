//! Superpixels and brute force at equal error and at equal time.

use super::pareto::{self, error_at, reached};
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

/// Pareto front of the rows' times and errors.
fn front<'a>(rows: impl IntoIterator<Item = &'a Row>) -> Vec<[f64; 2]> {
    pareto::front(rows.into_iter().map(|row| [time(row), error(row)]).collect())
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

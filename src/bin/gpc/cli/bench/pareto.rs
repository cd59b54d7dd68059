//! The Pareto front of times and errors, the time at which it reaches an error, and the error that it reaches in a time.

/// Those of the points [time, error] that no other point beats in both, sorted by time.
pub fn front(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut least = f64::INFINITY;
    points.retain(|[_, error]| {
        let better = *error < least;
        least = least.min(*error);
        better
    });
    points
}

/// Error that a front reaches in `ms`, on a straight line on logarithmic axes between two of its points; `None` before its
/// first point and beyond its last one.
pub fn error_at(front: &[[f64; 2]], ms: f64) -> Option<f64> {
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
pub fn reached(front: &[[f64; 2]], goal: f64) -> Option<f64> {
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
    fn points_that_another_one_beats_are_left_out() {
        assert_eq!(front(vec![[1.0, 0.1], [100.0, 0.001], [50.0, 0.2]]), [[1.0, 0.1], [100.0, 0.001]]);
    }

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

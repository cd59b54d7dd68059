//! Summary of several measurements of one quantity.

use serde::Serialize;

/// Median, minimum and spread of several measurements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// Median: the middle measurement, or the mean of the middle two.
    pub median: f64,
    /// Smallest measurement.
    pub min: f64,
    /// Difference between the largest and the smallest measurement.
    pub spread: f64,
    /// Number of measurements.
    pub count: usize,
}

impl Spread {
    /// Summarises measurements; all fields are zero if there are none.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let mut sorted: Vec<f64> = values.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        let (Some(min), Some(max)) = (sorted.first(), sorted.last()) else {
            return Self::default();
        };
        let upper = sorted.len() / 2;
        let lower = (sorted.len() - 1) / 2;
        Self { median: 0.5 * (sorted[lower] + sorted[upper]), min: *min, spread: max - min, count: sorted.len() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_one_or_between_two() {
        let odd = Spread::of([5.0, 1.0, 2.0]);
        assert_eq!((odd.median, odd.min, odd.spread, odd.count), (2.0, 1.0, 4.0, 3));
        assert_eq!(Spread::of([4.0, 1.0, 2.0, 30.0]).median, 3.0);
        assert_eq!(Spread::of([]), Spread::default());
    }
}

//! Heights of the bands in which a picture is made: each takes a short time, so that the window stays responsive.

use super::samples::TARGET_MS;
use gpc::render::{PassTime, Statistics};
use std::ops::Range;

/// Number of rows of which the height of a band is a multiple: the height of a tile.
pub const ROW_STEP: u32 = 4;
/// Passes over the scene's triangles, which take about as long for one row as for all. Most of the time of shadows does not
/// depend on the number of rows either.
const OF_TRIANGLES: [&str; 5] = ["pose", "stroke", "thin", "cull", PassTime::SHADOWS];

/// Device milliseconds that a piece of work took.
#[derive(Clone, Copy, Debug)]
pub struct Took {
    pub ms: f64,
    /// Milliseconds that do not depend on the number of rows, included in `ms`.
    pub fixed_ms: f64,
}

impl Took {
    pub fn of(statistics: &Statistics) -> Self {
        let passes = statistics.passes.iter();
        let fixed = passes.filter(|pass| OF_TRIANGLES.contains(&pass.pass));
        Self { ms: statistics.gpu_ms(), fixed_ms: fixed.map(|pass| pass.ms).sum() }
    }

    /// Milliseconds per row of `rows` rows, without the fixed part.
    fn of_row(self, rows: u32) -> f64 {
        (self.ms - self.fixed_ms) / f64::from(rows.max(1))
    }
}

/// Heights of the bands of a picture, estimated from the time of the bands before.
#[derive(Debug)]
pub struct BandHeights {
    /// Height of the picture.
    height: u32,
    /// Expected milliseconds of a row.
    row_ms: f64,
    /// Expected milliseconds of a band that do not depend on its number of rows.
    fixed_ms: f64,
}

impl BandHeights {
    /// Heights for a picture of `height` rows. Until a band has been measured, one of `rows` rows is expected to be right.
    pub fn new(height: u32, rows: u32) -> Self {
        Self { height, row_ms: TARGET_MS / f64::from(rows.max(1)), fixed_ms: 0.0 }
    }

    /// Rows of the band that begins at the row `first`.
    pub fn band(&self, first: u32) -> Range<u32> {
        // The rows take at least half of a band's time; otherwise a picture of many triangles would never be
        // finished.
        let target = TARGET_MS.max(2.0 * self.fixed_ms) - self.fixed_ms;
        let rows = (target / self.row_ms).min(f64::from(self.height)) as u32;
        let rows = (rows / ROW_STEP * ROW_STEP).max(ROW_STEP);
        first..(first + rows).min(self.height)
    }

    /// Expects rows to take `times` as long as the last ones.
    pub fn expect(&mut self, times: f64) {
        self.row_ms *= times;
    }

    /// Takes the time of a picture of all rows.
    pub fn learn_all(&mut self, took: Took) {
        self.row_ms = took.of_row(self.height);
        self.fixed_ms = took.fixed_ms;
    }

    /// Takes the time of a band of `rows` rows.
    pub fn learn(&mut self, rows: u32, took: Took) {
        self.fixed_ms = took.fixed_ms;
        let found = took.of_row(rows);
        // Rows differ within an image, so the estimate moves half of the way, but stays near the last measurement.
        let halfway = (self.row_ms * found).sqrt();
        self.row_ms = halfway.clamp(0.5 * found, 2.0 * found);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn took(passes: &[(&'static str, f64)]) -> Took {
        let passes = passes.iter().map(|&(pass, ms)| PassTime { pass, ms }).collect();
        Took::of(&Statistics { passes, ..Statistics::default() })
    }

    #[test]
    fn shadows_make_bands_higher() {
        let found = took(&[("cull", 10.0), (PassTime::SHADOWS, 470.0), ("sample", 20.0)]);
        assert_eq!((found.ms, found.fixed_ms), (500.0, 480.0));
        // With 2 ms a row, 240 rows take as long as the fixed part.
        let mut heights = BandHeights::new(720, 40);
        heights.learn(40, Took { ms: 560.0, fixed_ms: 480.0 });
        assert_eq!(heights.band(0), 0..240);
    }
}

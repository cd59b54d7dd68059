//! Times of the steps up to the first image.

use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Instant;

/// A clock that is read after each step until the first image is there.
pub struct Clock {
    start: Instant,
    last: Instant,
    /// Taken with the first image.
    laps: Option<BTreeMap<&'static str, f64>>,
}

/// Wall-clock milliseconds of each step from the start of the command to the first image, and their sum, `total`:
/// `load` (reading the scene and decoding its images), `pose`, `device` (what it took longer to open than to load and
/// pose, beside which it is opened), `upload`, `pipelines`, `frame` (on drivers that compile kernels when they first run,
/// with that) and `write`.
#[derive(Serialize)]
#[serde(transparent)]
pub struct StartUp(BTreeMap<&'static str, f64>);

impl Clock {
    pub fn start() -> Self {
        let now = Instant::now();
        Self {
            start: now,
            last: now,
            laps: Some(BTreeMap::new()),
        }
    }

    /// Books the time since the last step under the name of this one.
    pub fn lap(&mut self, step: &'static str) {
        let now = Instant::now();
        if let Some(laps) = &mut self.laps {
            *laps.entry(step).or_default() += 1e3 * (now - self.last).as_secs_f64();
        }
        self.last = now;
    }

    /// Times of all steps up to the first image; `None` when asked again.
    pub fn finish(&mut self) -> Option<StartUp> {
        let total = 1e3 * (self.last - self.start).as_secs_f64();
        let mut laps = self.laps.take()?;
        laps.insert("total", total);
        Some(StartUp(laps))
    }
}

//! Times of the steps up to the first image.

use std::collections::BTreeMap;
use std::time::Instant;

/// A clock that times the steps until the first image is done. The steps are `load` (reading the scene and decoding its
/// images), `pose`, `device` (the time by which opening the device outlasts loading and posing, which run in parallel),
/// `upload`, `pipelines`, `frame` (some drivers compile kernels in it, when they first run) and `write`.
pub struct Clock {
    start: Instant,
    last: Instant,
    /// Milliseconds by step; `None` once [`Self::finish`] has returned them.
    laps: Option<BTreeMap<&'static str, f64>>,
}

impl Clock {
    pub fn start() -> Self {
        let now = Instant::now();
        Self { start: now, last: now, laps: Some(BTreeMap::new()) }
    }

    /// Adds the time since the last call to the step that has just ended.
    pub fn lap(&mut self, step: &'static str) {
        let now = Instant::now();
        if let Some(laps) = &mut self.laps {
            *laps.entry(step).or_default() += 1e3 * (now - self.last).as_secs_f64();
        }
        self.last = now;
    }

    /// Wall-clock milliseconds of all steps up to the first image, and their sum, `total`; `None` from the second call on.
    pub fn finish(&mut self) -> Option<BTreeMap<&'static str, f64>> {
        let total = 1e3 * (self.last - self.start).as_secs_f64();
        let mut laps = self.laps.take()?;
        laps.insert("total", total);
        Some(laps)
    }
}

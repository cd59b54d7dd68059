//! Runs over a list, which are divided or made again with more memory until they are finished.

use super::plan::LocationPlan;
use crate::engine::sampler::{Capacity, Shortfall};
use crate::render::{Headless, RenderError};
use std::ops::Range;

impl Headless {
    /// Processes a list run by run, in the partition's order. `make` plans the runs, and makes the passes for them. `process`
    /// has a run processed, and returns what it left unfinished. `take` gets each run that was finished.
    pub(super) fn each_run<T>(
        &mut self,
        make: impl Fn(Capacity) -> Result<(LocationPlan, T), RenderError>,
        mut process: impl FnMut(&mut Self, &mut T, &Range<usize>) -> Result<Shortfall, RenderError>,
        mut take: impl FnMut(&T, Range<usize>) -> Result<(), RenderError>,
    ) -> Result<(), RenderError> {
        let mut capacity = Capacity::default();
        let (plan, mut passes) = make(capacity)?;
        let mut waiting: Vec<_> = plan.runs.into_iter().rev().collect();
        while let Some(run) = waiting.pop() {
            let shortfall = process(self, &mut passes, &run)?;
            if shortfall.left() == 0 {
                take(&passes, run)?;
                continue;
            }
            log::debug!("{} locations lacked room: {shortfall:?}", run.len());
            let more = capacity.next(&shortfall);
            // A plane of a light needs as much room for half of the locations, and a long list of candidates stays long.
            let is_divisible =
                more.is_none_or(|more| more.long_lists == capacity.long_lists && more.planes == capacity.planes);
            if run.len() > 1 && is_divisible {
                waiting.extend(halves(&run));
            } else if let Some(more) = more {
                capacity = more;
                let (plan, larger) = make(capacity)?;
                passes = larger;
                let left = plan.runs.iter().rev().filter(|other| other.end > run.start);
                waiting = left.map(|other| other.start.max(run.start)..other.end).collect();
            } else {
                return Ok(shortfall.check()?);
            }
        }
        Ok(())
    }
}

/// Halves of a run, the first half last. Half of the locations have about half of the visibility samples and pairs.
fn halves(run: &Range<usize>) -> [Range<usize>; 2] {
    let middle = run.start + run.len() / 2;
    [middle..run.end, run.start..middle]
}

//! Sampler of a host's frame or list, with its memory.

use super::lending::Lending;
use super::{HostError, Outcome};
use crate::engine::sampler::{Capacity, Job, Sampler, Shortfall};

/// Sampler of a frame or list, which has one region, and the memory in which it works.
pub(super) struct Sampling {
    pub job: Job,
    pub sampler: Sampler,
}

impl Sampling {
    fn tiles(&self) -> [u32; 1] {
        [self.job.resources().sizes().tiles()]
    }

    /// Work that the last recording could not finish.
    ///
    /// # Errors
    /// If its commands are not done, or counters can't be read.
    pub fn shortfall(&self) -> Result<Shortfall, HostError> {
        Ok(self.job.shortfall([&self.sampler], &self.tiles())?)
    }

    /// Capacity with more of what the last recording lacked; the present one if it lacked nothing, or if more would not help.
    ///
    /// # Errors
    /// As [`Self::shortfall`].
    pub fn next_capacity(&self) -> Result<Capacity, HostError> {
        let present = self.job.capacity();
        Ok(present.next(&self.shortfall()?).unwrap_or(present))
    }

    /// Result of the last recording, of `triangles` triangles besides those of indirect draws. Other objects take `beside`
    /// bytes of memory.
    ///
    /// # Errors
    /// As [`Self::shortfall`]; if timestamps can't be read.
    pub fn outcome(&self, triangles: u32, lending: &Lending, beside: u64) -> Result<Outcome, HostError> {
        let left_over = self.shortfall()?.left();
        let indirect = lending.indirect_counts()?;
        let triangles = u64::from(triangles) + indirect.triangles;
        let statistics = self.job.statistics(Some(&self.sampler), &self.tiles(), triangles, beside)?;
        Ok(Outcome { statistics, left_over, indirect })
    }
}

//! Timing of the parts of a frame.

use super::{Gpu, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Time of a pass on the device, or of another part of a frame that has a name here.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    /// Name of the pass, or of the other part.
    pub pass: &'static str,
    /// Time in milliseconds.
    pub ms: f64,
}

impl PassTime {
    /// Colours of the background, before pixels are shaded.
    pub const BACKGROUND: &'static str = "background";
    /// Search for the lights that reach a place: all passes of the lights' planes.
    pub const SHADOWS: &'static str = "shadows";
    /// Shading by the pipelines of a host. The name is that of the pass that shades scenes of files.
    pub const HOST_SHADING: &'static str = "shade";
    /// All rounds after the first, unless each of them is timed by itself.
    pub const ROUNDS: &'static str = "rounds";
    /// Copies of the image to where the caller wants it.
    pub const COPY: &'static str = "copy";

    /// Conversion of the image to the encoding that the caller wants. The name is that of the pass.
    pub const ENCODE: &'static str = "encode";

    /// Whether this part only brings the finished image to the caller.
    #[must_use]
    pub fn is_output(pass: &str) -> bool {
        [Self::ENCODE, Self::COPY].contains(&pass)
    }

    /// Milliseconds of all parts of a frame but its [output](Self::is_output).
    #[must_use]
    pub fn total(parts: &[Self]) -> f64 {
        let parts = parts.iter().filter(|part| !Self::is_output(part.pass));
        parts.map(|part| part.ms).sum()
    }
}

/// Timestamps of a frame. The times of equal names are added up.
pub struct Timings {
    gpu: Arc<Gpu>,
    /// Pools of [`Self::POOL`] queries each; marks make more of them as they need.
    pools: Vec<vk::QueryPool>,
    names: Vec<Option<&'static str>>,
    /// Whether the passes of repetitions are timed one by one.
    pub(super) times_repetitions: bool,
    /// Why there is no further pool.
    refused: Option<vk::Result>,
}

impl Timings {
    /// Number of queries of a pool.
    const POOL: usize = 64;

    /// Makes a timer. The commands of a [repetition](super::Recorder::repeated_rounds) have one time together.
    pub fn new(gpu: &Arc<Gpu>) -> Self {
        Self { gpu: gpu.clone(), pools: Vec::new(), names: Vec::new(), times_repetitions: false, refused: None }
    }

    /// The same timer, which times the passes of repetitions one by one where that is `wanted`.
    pub fn with_repetitions(mut self, wanted: bool) -> Self {
        self.times_repetitions = wanted;
        self
    }

    pub(super) fn begin(&mut self, raw: vk::CommandBuffer) {
        self.names.clear();
        self.refused = None;
        self.mark(raw, None);
    }

    pub(super) fn mark(&mut self, raw: vk::CommandBuffer, name: Option<&'static str>) {
        if self.gpu.limits().timestamp_period == 0.0 || self.refused.is_some() {
            return;
        }
        let [number, query] = [self.names.len() / Self::POOL, self.names.len() % Self::POOL];
        if number == self.pools.len() {
            let info =
                vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::TIMESTAMP).query_count(Self::POOL as u32);
            // SAFETY: plain creation on a live device.
            match unsafe { self.gpu.device.create_query_pool(&info, None) } {
                Ok(pool) => self.pools.push(pool),
                Err(result) => {
                    self.refused = Some(result);
                    return;
                }
            }
        }
        let pool = self.pools[number];
        // SAFETY: the recorder's contract; marks lie outside of render passes. The pool is not in use, because the previous frame's
        // commands have run, and it is reset before its first query.
        unsafe {
            if query == 0 {
                self.gpu.device.cmd_reset_query_pool(raw, pool, 0, Self::POOL as u32);
            }
            let stage = vk::PipelineStageFlags2::ALL_COMMANDS;
            self.gpu.device.cmd_write_timestamp2(raw, stage, pool, query as u32);
        }
        self.names.push(name);
    }

    /// Times in the order in which their names first appear. This does not wait.
    ///
    /// # Errors
    /// [`VulkanError::NotDone`] if the commands have not run, [`VulkanError::Call`] if the driver refused a query pool or the
    /// results can't be read.
    pub fn read(&self) -> Result<Vec<PassTime>, VulkanError> {
        if let Some(result) = self.refused {
            return Err(VulkanError::of("vkCreateQueryPool")(result));
        }
        let mut stamps = vec![0_u64; self.names.len()];
        for (pool, stamps) in self.pools.iter().zip(stamps.chunks_mut(Self::POOL)) {
            let flags = vk::QueryResultFlags::TYPE_64;
            // SAFETY: the pool belongs to the device and has at least this many queries. They were reset when the
            // names were recorded; after that, results may be read at any time without waiting.
            unsafe { self.gpu.device.get_query_pool_results(*pool, 0, stamps, flags) }.map_err(
                |result| match result {
                    vk::Result::NOT_READY => VulkanError::NotDone,
                    result => VulkanError::of("vkGetQueryPoolResults")(result),
                },
            )?;
        }
        let period = f64::from(self.gpu.limits().timestamp_period) * 1e-6;
        Ok(by_name(&stamps, &self.names, period))
    }
}

/// Times of parts, from one stamp to the next. The later stamp has the part's name; parts without a name are left out,
/// and the times of equal names are added up. A tick of the stamps is `period` milliseconds.
fn by_name(stamps: &[u64], names: &[Option<&'static str>], period: f64) -> Vec<PassTime> {
    let mut times: Vec<PassTime> = Vec::new();
    for (pair, name) in stamps.windows(2).zip(names.iter().skip(1)) {
        let (Some(pass), &[before, after]) = (*name, pair) else {
            continue;
        };
        let ms = after.saturating_sub(before) as f64 * period;
        match times.iter_mut().find(|time| time.pass == pass) {
            Some(time) => time.ms += ms,
            None => times.push(PassTime { pass, ms }),
        }
    }
    times
}

impl Drop for Timings {
    fn drop(&mut self) {
        for pool in &self.pools {
            // SAFETY: owners drop timings only after the frames that use them have run.
            unsafe { self.gpu.device.destroy_query_pool(*pool, None) };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_takes_from_the_stamp_before_to_its_own() {
        let names = [None, Some("bin"), Some("sort"), None, Some("bin")];
        let times = by_name(&[10, 12, 20, 50, 51], &names, 0.5);
        assert_eq!(times, [PassTime { pass: "bin", ms: 1.5 }, PassTime { pass: "sort", ms: 4.0 }]);
    }

    #[test]
    fn stamps_that_run_backwards_take_no_time() {
        assert_eq!(by_name(&[10, 9], &[None, Some("bin")], 1.0), [PassTime { pass: "bin", ms: 0.0 }]);
    }
}

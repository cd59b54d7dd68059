//! What the device counted over a frame, once its commands are done.

use super::Frame;
use super::recording::Run;
use crate::engine::sampler::statistics::Shortfall;
use crate::passes::Counter;
use crate::render::{PassTime, RenderError, Statistics};

impl Frame {
    /// What the last frame could not finish.
    pub(in crate::render) fn shortfall(&self) -> Result<Shortfall, RenderError> {
        self.completion.check()?;
        let unlisted = self.plan.capacity.unlisted;
        let mut shortfall = Shortfall::default();
        let room = self.plan.sizes.survivor_capacity;
        for (tiles, run, counters) in self.counted()? {
            if self.records(run) {
                shortfall.add(counters, (tiles, room), unlisted);
            }
        }
        let slots = Run::slots(self.plan.regions.len());
        let words: &[u32] = self.counters.read(slots * Counter::COUNT)?;
        shortfall.add_subgroups(words.rchunks_exact(Counter::COUNT).next().unwrap_or(&[]));
        if let Some(shadows) = &self.shadows {
            shadows.add_shortfall(&mut shortfall)?;
        }
        Ok(shortfall)
    }

    /// Whether recordings have such a run.
    fn records(&self, run: Run) -> bool {
        let superpixels = self.passes.superpixels.as_ref();
        match run {
            Run::Blended => self.passes.blended.is_some(),
            Run::Superpixels => superpixels.is_some(),
            Run::Grown => superpixels.is_some_and(|engine| engine.growths() > 0),
            Run::GrownAgain => superpixels.is_some_and(|engine| engine.growths() > 1),
        }
    }

    /// For each run over each region: the region's tiles, the run, and what the last frame counted.
    fn counted(&self) -> Result<impl Iterator<Item = (u32, Run, &[u32])>, RenderError> {
        let regions = &self.plan.regions;
        let words: &[u32] = self
            .counters
            .read(regions.len() * Run::ALL.len() * Counter::COUNT)?;
        let runs = regions.iter().flat_map(|region| {
            let [width, height] = region.outer().map(|side| side * self.settings.side());
            let tiles = width.div_ceil(8) * height.div_ceil(4);
            Run::ALL.map(|run| (tiles, run))
        });
        let counters = words.chunks_exact(Counter::COUNT);
        Ok(runs
            .zip(counters)
            .map(|((tiles, run), counters)| (tiles, run, counters)))
    }

    /// Figures of the last recording, once its commands are done, until the next one. It waits for nothing.
    ///
    /// # Errors
    /// [`RenderError::Unfinished`] if records did not fit in memory, [`RenderError::Vulkan`] if the last recording is not done
    /// or what was counted or timed can't be read.
    pub fn statistics(&self) -> Result<Statistics, RenderError> {
        let mut statistics = Statistics {
            regions: self.plan.regions.len() as u64,
            memory_bytes: self.memory.used() + self.scene.memory_bytes(),
            ..Statistics::default()
        };
        statistics.triangles.total = self.scene.triangle_count();
        self.shortfall()?.check(self.plan.sizes.lanes)?;
        for (tiles, run, counters) in self.counted()? {
            if !self.records(run) || run == Run::Blended {
                continue;
            }
            statistics.add(counters);
            if run == Run::Superpixels {
                statistics.add_scene(counters, tiles);
            }
        }
        if self.passes.blended.is_none() {
            statistics.skipped_passes.push("blend");
        }
        if self.passes.superpixels.is_some() && statistics.superpixels == 0 {
            statistics
                .skipped_passes
                .extend(["cull", "bin", "sample", "resolve"]);
        }
        statistics.passes = self
            .timings
            .read()?
            .into_iter()
            .map(|(pass, ms)| PassTime { pass, ms })
            .collect();
        Ok(statistics)
    }
}

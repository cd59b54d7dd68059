//! What the device counted over a frame, once its commands are done.

use super::Frame;
use crate::passes::Counter;
use crate::render::statistics::Shortfall;
use crate::render::{PassTime, RenderError, Statistics};

impl Frame {
    /// What the last frame could not finish.
    pub(in crate::render) fn shortfall(&self) -> Result<Shortfall, RenderError> {
        let unlisted = self.plan.effort.unlisted;
        let mut shortfall = Shortfall::default();
        for (tiles, blended, superpixels) in self.counted()? {
            if self.passes.blended.is_some() {
                shortfall.add(blended, tiles, unlisted);
            }
            if self.passes.superpixels.is_some() {
                shortfall.add(superpixels, tiles, unlisted);
            }
        }
        Ok(shortfall)
    }

    /// Tiles of each region, and what the last frame counted over them for BLEND pixels and for superpixels.
    fn counted(&self) -> Result<impl Iterator<Item = (u32, &[u32], &[u32])>, RenderError> {
        let regions = &self.plan.regions;
        let words: &[u32] = self.counters.read(regions.len() * 2 * Counter::COUNT)?;
        let runs = words.chunks_exact(2 * Counter::COUNT);
        Ok(regions.iter().zip(runs).map(|(region, runs)| {
            let [width, height] = region.outer().map(|side| side * self.settings.side());
            let (blended, superpixels) = runs.split_at(Counter::COUNT);
            (width.div_ceil(8) * height.div_ceil(4), blended, superpixels)
        }))
    }

    /// Figures of the last frame. Call it when its commands are done.
    ///
    /// # Errors
    /// [`RenderError::Unfinished`] if records did not fit in memory in all rounds, [`RenderError::Vulkan`] if
    /// what was counted or timed can't be read.
    pub fn statistics(&self) -> Result<Statistics, RenderError> {
        let mut statistics = Statistics {
            regions: self.plan.regions.len() as u64,
            memory_bytes: self.memory.used() + self.scene.memory_bytes(),
            ..Statistics::default()
        };
        statistics.triangles.total = u64::from(self.scene.triangle_count());
        self.shortfall()?.check()?;
        for (tiles, _, superpixels) in self.counted()? {
            if self.passes.superpixels.is_some() {
                statistics.tiles += u64::from(tiles);
                statistics.add(superpixels);
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

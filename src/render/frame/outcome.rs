//! Counters of a frame, read once its commands have run.

use super::Frame;
use crate::engine::data::tiles::tiles;
use crate::engine::sampler::Shortfall;
use crate::engine::spirv;
use crate::render::{RenderError, Statistics};
use crate::vulkan::Specialized;

impl Frame {
    /// Work that the last recording could not finish.
    pub(in crate::render) fn shortfall(&self) -> Result<Shortfall, RenderError> {
        self.completion.check()?;
        let mut shortfall = Shortfall::default();
        let samplers = [&self.passes.blended, &self.passes.superpixels];
        for sampler in samplers.into_iter().flatten() {
            sampler.add_shortfall(self.tiles(), &mut shortfall)?;
        }
        if let Some(shadows) = &self.shadows {
            shadows.add_shortfall(&mut shortfall)?;
        }
        Ok(shortfall)
    }

    /// Number of tiles of each region.
    fn tiles(&self) -> impl Iterator<Item = u32> {
        let side = self.settings.method.side();
        self.plan.regions.iter().map(move |region| {
            let [columns, rows] = tiles(region.outer().map(|pixels| pixels * side));
            columns * rows
        })
    }

    /// Statistics of the last recording, available from the end of its commands until the next recording. The call does
    /// not wait for the commands.
    ///
    /// # Errors
    /// [`EngineError::Unfinished`](crate::render::EngineError::Unfinished) if visibility samples did not fit into memory;
    /// [`EngineError::Vulkan`](crate::render::EngineError::Vulkan) if the last recording has not been executed, or its
    /// counters or times can't be read.
    pub fn statistics(&self) -> Result<Statistics, RenderError> {
        let mut statistics = Statistics {
            regions: self.plan.regions.len() as u64,
            memory_bytes: self.memory.used() + self.scene.memory_bytes(),
            ..Statistics::default()
        };
        statistics.triangles.total = self.scene.triangle_count();
        self.shortfall()?.check()?;
        if let Some(superpixels) = &self.passes.superpixels {
            superpixels.add_statistics(self.tiles(), &mut statistics)?;
        }
        if self.passes.blended.is_none() {
            statistics.skipped_passes.push(Statistics::BLEND);
        }
        if self.passes.superpixels.is_some() && statistics.superpixels == 0 {
            let of_superpixels =
                [spirv::Cull::INTERFACE, spirv::Bin::INTERFACE, spirv::Sample::INTERFACE, spirv::Resolve::INTERFACE];
            let names = of_superpixels.map(|shader| shader.pass());
            statistics.skipped_passes.extend(names);
        }
        statistics.passes = self.timings.read()?;
        Ok(statistics)
    }
}

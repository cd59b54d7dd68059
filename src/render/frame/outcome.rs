//! Counters of a frame, read once its commands have run.

use super::SceneFrame;
use crate::engine::data::tiles::tile_count;
use crate::engine::sampler::Shortfall;
use crate::engine::sampler::plan::Region;
use crate::engine::spirv;
use crate::render::{RenderError, Statistics};
use crate::vulkan::Specialized;

impl SceneFrame {
    /// Work that the last recording could not finish.
    pub(in crate::render) fn shortfall(&self) -> Result<Shortfall, RenderError> {
        let samplers = [&self.passes.blended, &self.passes.superpixels];
        let mut shortfall = self.job.shortfall(samplers.into_iter().flatten(), &self.tiles())?;
        if let Some(shadows) = &self.shadows {
            shadows.add_shortfall(&mut shortfall)?;
        }
        Ok(shortfall)
    }

    /// Number of tiles of each region.
    fn tiles(&self) -> Vec<u32> {
        let side = self.settings.method.side();
        let tiles_of = |region: &Region| tile_count(region.outer().map(|pixels| pixels * side)) as u32;
        self.plan.regions.iter().map(tiles_of).collect()
    }

    /// Statistics of the last recording, available from the end of its commands until the next recording. The call does
    /// not wait for the commands.
    ///
    /// # Errors
    /// [`EngineError::Unfinished`](crate::render::EngineError::Unfinished) if visibility samples did not fit into memory;
    /// [`EngineError::Vulkan`](crate::render::EngineError::Vulkan) if the last recording has not been executed, or its
    /// counters or times can't be read.
    pub fn statistics(&self) -> Result<Statistics, RenderError> {
        self.shortfall()?.check()?;
        let superpixels = self.passes.superpixels.as_ref();
        let (triangles, of_scene) = (self.scene.geometry.triangle_count, self.scene.memory_bytes());
        let mut statistics = self.job.statistics(superpixels, &self.tiles(), triangles, of_scene)?;
        statistics.regions = self.plan.regions.len() as u64;
        if self.passes.blended.is_none() {
            statistics.skipped_passes.push(Statistics::BLEND);
        }
        if self.passes.superpixels.is_some() && statistics.superpixels == 0 {
            let of_superpixels =
                [spirv::Cull::INTERFACE, spirv::Bin::INTERFACE, spirv::Sample::INTERFACE, spirv::Resolve::INTERFACE];
            let names = of_superpixels.map(|shader| shader.pass());
            statistics.skipped_passes.extend(names);
        }
        Ok(statistics)
    }
}

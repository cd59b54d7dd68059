//! Search for thin triangles that cross the cells of locations without covering any location, run by run.

use super::ListSettings;
use super::plan::LocationPlan;
use super::run::{ListRun, RunMemory};
use crate::camera::Pinhole;
use crate::engine::data::{CellSizes, Cells, Counter, ListedLocation, Offsets};
use crate::engine::passes::cull::{self, CullFilter};
use crate::engine::passes::{Distribute, bin};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::sampler::{CountedRoom, CounterLog, SamplerRun, Shortfall};
use crate::render::passes::{MarkedOutput, SeenLocation, crossings};
use crate::render::plane::PlaneWindow;
use crate::render::{PreparedScene, RenderError, Statistics};
use crate::vulkan::{Buffer, MemoryUse, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Pipelines and memory for the search in runs of locations of one scene.
pub(super) struct CrossingFinder {
    distribute: Distribute,
    cull: Pass,
    bin: Pass,
    crossings: Pass,
    seen: Buffer,
    counters: CounterLog,
    run: RunMemory,
}

impl CrossingFinder {
    /// Makes the pipelines, and memory for the runs of a plan. Cells of `output` that are crossed are marked in `marks`; with
    /// `folds` also those in which a thin triangle lies at an angle to the surface that the location sees.
    ///
    /// # Safety
    /// `marks` outlives the execution of what is recorded, and has two words for each tile of the output.
    pub unsafe fn new(
        layout: &Arc<FrameLayout>,
        prepared: &PreparedScene,
        settings: &ListSettings,
        plan: &LocationPlan,
        output: MarkedOutput,
        marks: &Buffer,
        folds: bool,
    ) -> Result<Self, RenderError> {
        let scene = &*prepared.gpu_scene;
        let offsets = Offsets { all: &[[0.0; 2]], count: 1 };
        let run = RunMemory::new(layout, prepared, settings, plan, offsets)?;
        let (resources, memory) = (run.job.resources(), run.job.memory());
        let count = plan.sizes.locations.map_or(0, |sizes| sizes.locations);
        let seen = memory.storage_buffer(
            "what locations see",
            u64::from(count) * size_of::<SeenLocation>() as u64,
            vk::BufferUsageFlags::STORAGE_BUFFER,
            MemoryUse::Upload,
        )?;
        let cells = Cells::Superpixels;
        let sizes = CellSizes::new(layout.gpu.limits().teams.members, cells, 1);
        Ok(Self {
            distribute: Distribute::new(layout, cells, sizes, resources)?,
            cull: cull::pass(layout, scene, CullFilter::Thin)?,
            bin: bin::pass(layout, scene)?,
            // SAFETY: `seen` lives as long as the pass and has room for all locations; the caller guarantees the
            // marks.
            crossings: unsafe { crossings::pass(layout, scene, resources, &seen, marks, output, folds) }?,
            seen,
            counters: CounterLog::new(memory, 1)?,
            run,
        })
    }

    /// Memory for a run of `count` locations and for the surfaces visible there, to be written while the device is
    /// idle.
    pub fn listed_mut(&mut self, count: usize) -> Result<(&mut [ListedLocation], &mut [SeenLocation]), VulkanError> {
        let bytes = count * size_of::<SeenLocation>();
        let seen = self.seen.bytes_mut().get_mut(..bytes).unwrap_or(&mut []);
        Ok((self.run.job.resources_mut().listed_mut(count)?, bytemuck::cast_slice_mut(seen)))
    }

    /// Records the search in a run of `count` locations within a window of the pinhole's plane. The locations must have
    /// been written before.
    ///
    /// # Safety
    /// As [`RunMemory::record`]. The written [`SeenLocation::output`] indices belong to cells of the output.
    pub unsafe fn record(
        &mut self,
        scene: &PreparedScene,
        pinhole: &Pinhole,
        window: &PlaneWindow,
        count: usize,
        commands: vk::CommandBuffer,
    ) {
        let Self { distribute, cull, bin, crossings, counters, run, .. } = self;
        let record = |recorder: &Recorder<'_>, list: &SamplerRun<'_>, _| {
            let SamplerRun { resources, set, .. } = *list;
            let region = window.region(count);
            distribute.record(recorder, resources, set, &region);
            cull.record(recorder);
            bin.record(recorder);
            crossings.record(recorder);
            counters.record(recorder, resources, 0);
        };
        let listed = ListRun { pinhole, window, cells: Cells::Superpixels, samples: 1, locations: count as u32 };
        // SAFETY: guaranteed by the caller.
        unsafe { run.record(scene, &listed, commands, record) };
    }

    /// Triangles, and pairs of triangles and tiles, for which the last run had no room.
    ///
    /// # Errors
    /// If the counters can't be read.
    pub fn shortfall(&self) -> Result<Shortfall, VulkanError> {
        self.run.job.check()?;
        let sizes = self.run.job.resources().sizes();
        let mut shortfall = Shortfall::default();
        for counters in self.counters.read(1)?.flatten() {
            let room = CountedRoom { tiles: 0, triangles: sizes.survivor_capacity, pairs: sizes.pair_capacity };
            shortfall.add(counters, room, true);
            // No other pass looks at the pairs that were left out.
            let unpaired = Counter::Pairs.of(counters).saturating_sub(sizes.pair_capacity);
            shortfall.dropped += u64::from(unpaired);
        }
        Ok(shortfall)
    }

    /// Adds the times of the last run's passes to `statistics`.
    ///
    /// # Errors
    /// If the times can't be read.
    pub fn add_statistics(&self, scene: &PreparedScene, total: &mut Statistics) -> Result<(), VulkanError> {
        let scene = &scene.gpu_scene;
        total.append(self.run.job.statistics(None, &[], scene.geometry.triangle_count, scene.memory_bytes())?);
        Ok(())
    }
}

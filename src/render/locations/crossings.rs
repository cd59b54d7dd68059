//! Thin triangles that cross the cells of locations unseen, found run by run.

use super::plan::LocationPlan;
use super::run::RunMemory;
use crate::camera::Pinhole;
use crate::engine::sampler::statistics::Shortfall;
use crate::engine::sampler::{CounterLog, SamplerRun};
use crate::passes::{
    Bin, CellSizes, Cells, Counter, Cull, CullFilter, Distribute, FrameLayout, ListLength,
    ListedLocation, Offsets,
};
use crate::render::passes::{Crossings, MarkedOutput, SeenLocation};
use crate::render::plane::Window;
use crate::render::{PreparedScene, RenderError, Settings, Statistics};
use crate::vulkan::{Buffer, MemoryUse, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Pipelines and memory to look for thin triangles in runs of locations of one scene.
pub(super) struct CrossingFinder {
    distribute: Distribute,
    cull: Cull,
    bin: Bin,
    crossings: Crossings,
    seen: Buffer,
    counters: CounterLog,
    run: RunMemory,
}

impl CrossingFinder {
    /// Makes the pipelines, and memory for the runs of a plan; cells are marked in `marks`.
    ///
    /// # Safety
    /// `marks` outlives the execution of what is recorded, and has two words for each tile of the output.
    pub unsafe fn new(
        layout: &Arc<FrameLayout>,
        prepared: &PreparedScene,
        settings: &Settings,
        plan: &LocationPlan,
        marks: &Buffer,
    ) -> Result<Self, RenderError> {
        let scene = &*prepared.gpu_scene;
        let offsets = Offsets {
            all: &[[0.0; 2]],
            count: 1,
        };
        let run = RunMemory::new(layout, prepared, settings, plan.sizes, offsets, 16)?;
        let (resources, locations) = (&run.resources, run.resources.listed()?);
        let count = plan.sizes.locations.map_or(0, |sizes| sizes.locations);
        let seen = run.memory.storage_buffer(
            "what locations see",
            u64::from(count) * size_of::<SeenLocation>() as u64,
            vk::BufferUsageFlags::STORAGE_BUFFER,
            MemoryUse::Upload,
        )?;
        let cells = Cells::Superpixels;
        let sizes = CellSizes::new(layout.gpu.limits().lanes, cells, 1);
        Ok(Self {
            // SAFETY: the list goes with the resources, and has room for as many locations.
            distribute: unsafe { Distribute::new(layout, cells, sizes, resources, locations) }?,
            cull: Cull::new(layout, scene, CullFilter::Thin)?,
            bin: Bin::new(layout, scene)?,
            // SAFETY: what is seen goes with the engine and has room for all locations; of the marks as the caller says.
            crossings: unsafe { Crossings::new(layout, scene, resources, (&seen, marks)) }?,
            seen,
            counters: CounterLog::new(&run.memory, 1)?,
            run,
        })
    }

    /// The list of a run of so many locations and what these see, to be written while the device is idle.
    pub fn listed_mut(
        &mut self,
        count: usize,
    ) -> Result<(&mut [ListedLocation], &mut [SeenLocation]), VulkanError> {
        let bytes = count * size_of::<SeenLocation>();
        let seen = self.seen.bytes_mut().get_mut(..bytes).unwrap_or(&mut []);
        Ok((self.run.listed_mut(count)?, bytemuck::cast_slice_mut(seen)))
    }

    /// Records a run of so many locations, which have been written, in a window of what a pinhole sees.
    ///
    /// # Safety
    /// As [`RunMemory::record`]; what was written as seen names cells of the output.
    pub unsafe fn record(
        &mut self,
        scene: &PreparedScene,
        (pinhole, window): (&Pinhole, &Window),
        (output, count): (&MarkedOutput, usize),
        commands: vk::CommandBuffer,
    ) {
        let Self {
            distribute,
            cull,
            bin,
            crossings,
            counters,
            run,
            ..
        } = self;
        let record = |recorder: &mut Recorder<'_>, list: &SamplerRun<'_>, _| {
            let SamplerRun { resources, set, .. } = *list;
            let region = window.region(count);
            resources.record_locations(recorder, (set, distribute), &region, ListLength::Known);
            recorder.mark("distribute");
            cull.record(recorder, &resources.arguments);
            recorder.mark("cull");
            bin.record(recorder, &resources.arguments);
            recorder.mark("bin");
            crossings.record(recorder, (resources, set), output);
            recorder.mark("crossings");
            counters.record(recorder, resources, 0);
        };
        let (looking, cells) = ((pinhole, window), (Cells::Superpixels, 1));
        // SAFETY: passed on to the caller.
        unsafe { run.record(scene, looking, (cells, count), commands, record) };
    }

    /// Fails where pairs of triangles and tiles of the last run did not fit.
    ///
    /// # Errors
    /// [`RenderError::Unfinished`], or [`RenderError::Vulkan`] if what was counted can't be read.
    pub fn check(&self) -> Result<(), RenderError> {
        let sizes = self.run.resources.sizes();
        let mut shortfall = Shortfall::default();
        for counters in self.counters.read(1)?.flatten() {
            let get = |counter: Counter| counter.of(counters);
            let survivors = get(Counter::Survivors).saturating_add(get(Counter::Large));
            let dropped = survivors.saturating_sub(sizes.survivor_capacity);
            let unpaired = get(Counter::Pairs).saturating_sub(sizes.pair_capacity);
            shortfall.dropped += u64::from(dropped) + u64::from(unpaired);
            shortfall.add_subgroups(counters);
        }
        shortfall.check(sizes.lanes)
    }

    /// Adds the times of the last run's passes.
    ///
    /// # Errors
    /// If what was timed can't be read.
    pub fn add_statistics(
        &self,
        scene: &PreparedScene,
        total: &mut Statistics,
    ) -> Result<(), VulkanError> {
        self.run.add_statistics(scene, total)
    }
}

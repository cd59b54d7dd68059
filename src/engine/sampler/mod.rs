//! Sampler: finds the colours of cells, in rounds.
//!
//! Cells come from one of two sources: the pixels of an image that `detect` marks ([`PixelCells`]), or a list of the
//! caller's sample locations ([`ListCells`]). The sampler treats all cells alike: it finds the triangles that may be visible in a tile, chooses the tiles of each round, and turns
//! visibility samples into results.
//!
//! `docs/architecture.md` has drawings of the order of passes, made from what the library records.

mod capacity;
pub(crate) mod color;
mod counter_log;
mod error;
pub(crate) mod footprint;
pub(crate) mod image_state;
mod job;
mod list_cells;
mod load;
mod method;
mod pixel_cells;
pub(crate) mod plan;
mod rounds;
mod settings;
mod statistics;
mod triangle_lists;
pub(crate) mod uniform;

pub use crate::vulkan::timings::PassTime;
pub(crate) use capacity::{Capacity, CountedRoom, PlaneRoom, Shortfall};
pub(crate) use counter_log::CounterLog;
pub use error::EngineError;
pub use image_state::ImageState;
pub(crate) use job::{Job, JobRecording};
pub(crate) use list_cells::ListCells;
pub use load::Load;
pub use method::{CellOptions, Detection, Method, MethodKind, Shading, SuperpixelOptions};
pub(crate) use pixel_cells::PixelCells;
pub(crate) use rounds::RoundPolicy;
pub use settings::{Footprint, PixelRect, Reference};
pub(crate) use settings::{ImageRequest, SamplerSettings, check_image_size};
pub use statistics::{Statistics, TriangleCounts};
pub(crate) use triangle_lists::TriangleLists;

use crate::engine::data::{
    Cells, ColorConstants, Content, Counter, Data, FrameUniform, HostImage, ResourceSizes, Resources, SampleSet,
};
use crate::engine::passes::cull::CullFilter;
use crate::engine::passes::resolve::ResolveTarget;
use crate::engine::passes::setup::ListOrder;
use crate::engine::passes::{
    Distribute, FragmentRate, ListRegion, SampleBlocks, SampleOptions, bin, composite, cull, groups, resolve, sample,
    schedule, setup, sort, tally,
};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::sampling::Pattern;
use crate::vulkan::{Memory, Recorder, VulkanError};
use std::slice::ChunksExact;
use std::sync::Arc;

/// Client of a [`Sampler`]. The client owns the surfaces that samples see, and shades them. Passes use the
/// sets of the run before each of these calls, and after it.
pub(crate) trait RecordShading {
    /// Records the shading of a round's visibility samples, which are sorted by key. The radiance of each sample is
    /// written to its place in the buffer of shaded fragments.
    fn record(&self, recorder: &Recorder<'_>, resources: &Resources);
}

/// Arguments for making a [`Sampler`].
#[derive(Clone, Copy)]
pub(crate) struct SamplerContext<'a> {
    pub layout: &'a Arc<FrameLayout>,
    pub memory: &'a Memory,
    pub scene: &'a dyn Content,
    pub settings: &'a SamplerSettings,
    /// Colour constants of `shaders/include/color.glsl`.
    pub output: ColorConstants,
    /// Sizes of the memory in which the sampler works.
    pub sizes: &'a ResourceSizes,
    pub capacity: Capacity,
    /// Number of runs of a recording.
    pub runs: usize,
}

impl SamplerContext<'_> {
    /// Options of `sample` for cells of `samples` samples. For locations that are sampled once, `samples` is the
    /// largest number of locations in a cell.
    fn sample_options(&self, cells: Cells, samples: u32) -> SampleOptions {
        let (settings, scene, points) = (self.settings, self.scene, cells.are_points());
        let options = &settings.cells;
        SampleOptions {
            cells,
            samples,
            lines: options.pattern == Pattern::Lines,
            fragments: if points { FragmentRate::Sample } else { fragment_rate(options.shading, scene) },
            one_cell: !self.layout.gpu.limits().is_cpu(),
            long_lists: self.capacity.long_lists,
            samples_unlisted: self.capacity.samples_unlisted,
            has_mask: scene.has_mask(),
            has_blend: scene.has_blend(),
            always_blends: false,
            spread: None,
        }
    }
}

/// Passes that sample cells of one kind, with their capacity and their counters. The passes know triangles and shading
/// keys, but no materials.
pub(crate) struct Sampler {
    source: Source,
    /// Passes that find the triangles which may be visible in a tile, and the needs of the tiles.
    candidates: [Pass; 3],
    /// Passes of a round up to the visibility samples.
    visibility: Vec<Pass>,
    /// Pass that sorts visibility samples, unless the client merges and sorts them.
    sort: Pass,
    /// Passes of a round that turn shaded visibility samples into colours.
    colors: Vec<Pass>,
    blocks: SampleBlocks,
    capacity: Capacity,
    /// Numbers of recorded rounds: for the cells that are found first, and for each growth.
    rounds: [u32; 2],
    counters: CounterLog,
    /// Largest numbers of triangles for `cull`, and of pairs for `bin`.
    capacities: [u32; 2],
}

/// Passes that find the cells.
enum Source {
    Pixels {
        thin: Option<Pass>,
        detect: Pass,
        /// Growth passes, in the order in which they run.
        growths: Vec<Pass>,
    },
    List(Distribute),
}

/// Run of a sampler over a region of an image or over a list. Before the run, [`Resources::record_begin`] was recorded
/// with its set and uniform block.
#[derive(Clone, Copy)]
pub(crate) struct SamplerRun<'a> {
    pub resources: &'a Resources,
    pub set: &'a SampleSet,
    pub uniform: &'a FrameUniform,
    /// Number of locations of a list; ignored for pixels.
    pub locations: u32,
    /// Index of this run in the recording, from 0.
    pub index: usize,
}

impl Sampler {
    /// Makes the passes; those of `colors` turn visibility samples in these blocks into colours.
    fn new(
        context: &SamplerContext<'_>,
        options: &SampleOptions,
        source: impl FnOnce() -> Result<Source, EngineError>,
        colors: impl FnOnce(&SampleBlocks) -> Result<Vec<Pass>, EngineError>,
    ) -> Result<Self, EngineError> {
        let SamplerContext { layout, scene, sizes, capacity, .. } = *context;
        let cells = options.cells;
        let limits = layout.gpu.limits();
        let blocks = SampleBlocks::new(limits.teams, *options);
        let load = Load::new(limits, blocks, capacity.layers);
        // Drivers take longest to compile the kernels of `sample`, so these have their own thread.
        let (sample, others) = std::thread::scope(|scope| {
            let sample = scope.spawn(|| sample::pass(layout, scene, &blocks));
            let others = (|| {
                let candidates = [
                    cull::pass(layout, scene, CullFilter::Touching)?,
                    bin::pass(layout, scene)?,
                    tally::pass(layout, cells, load.pushed())?,
                ];
                let mut visibility = vec![schedule::pass(layout, cells, load.pushed())?];
                if cells.are_locations() {
                    visibility.push(groups::pass(layout, &blocks)?);
                }
                visibility.push(setup::pass(layout, scene, ListOrder::Whole)?);
                let unsorted = scene.bin_count() == 1 || context.settings.merged.is_some();
                let sort = sort::pass(layout, scene, unsorted)?;
                Ok::<_, EngineError>((source()?, candidates, visibility, sort, colors(&blocks)?))
            })();
            let sample = sample.join();
            let sample = sample.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            (sample, others)
        });
        let (source, candidates, mut visibility, sort, colors) = others?;
        visibility.push(sample?);
        let runs = context.runs * (1 + source.growths().len());
        Ok(Self {
            candidates,
            visibility,
            sort,
            colors,
            blocks,
            capacity,
            rounds: load.rounds(sizes, scene.triangle_slots(), capacity.rounds),
            counters: CounterLog::new(context.memory, runs)?,
            capacities: [sizes.survivor_capacity, sizes.pair_capacity],
            source,
        })
    }

    /// Limits the number of recorded rounds to `most`, for the detected superpixels and for each growth.
    pub fn limit_rounds(&mut self, most: u32) {
        self.rounds = self.rounds.map(|rounds| rounds.min(most));
    }

    /// Number of rounds that a run records, with or without work.
    pub fn rounds(&self) -> u32 {
        let [first, grown] = self.rounds;
        first + grown * self.growths() as u32
    }

    /// Blocks of the samples of its cells.
    pub fn blocks(&self) -> SampleBlocks {
        self.blocks
    }

    /// Number of samples of a cell; for locations that are sampled once, the number of locations in a cell.
    pub fn samples(&self) -> u32 {
        self.blocks.options.samples
    }

    /// Number of times that superpixels grow.
    pub fn growths(&self) -> usize {
        self.source.growths().len()
    }

    /// Whether pixels become cells because they are marked, by this or by passes before it.
    pub fn takes_marked(&self) -> bool {
        matches!(&self.source, Source::Pixels { thin: Some(_), .. })
    }

    /// Records clearing the marks of pixels, if the sampler takes marked ones. Passes may then mark pixels, until
    /// [`record`](Self::record) takes them.
    pub fn record_unmarked(&self, recorder: &Recorder<'_>, resources: &Resources) {
        if self.takes_marked() {
            recorder.clear(resources.buffer(Data::Marks));
        }
    }

    /// Records a run: finding the cells, sampling and shading them, and their growth. Its marks were
    /// [cleared](Self::record_unmarked) before. `make figures` writes what a pass of a frame reads from earlier ones and what it
    /// writes.
    pub fn record(&self, recorder: &Recorder<'_>, run: &SamplerRun<'_>, shading: &dyn RecordShading) {
        let SamplerRun { resources, set, uniform, .. } = *run;
        let tiles = uniform.tiles[0] * uniform.tiles[1];
        match &self.source {
            Source::Pixels { thin, detect, .. } => {
                if let Some(thin) = thin {
                    // thin: ids, blend_ids, raster_depth ─▶ survivors, marks
                    thin.record_for(recorder, uniform.triangle_count);
                }
                // detect: ids, blend_ids, display, marks ─▶ masks
                detect.record_for(recorder, tiles);
            }
            Source::List(distribute) => {
                let region = ListRegion { tiles: uniform.tiles, count: run.locations };
                distribute.record(recorder, resources, set, &region);
            }
        }
        let growths = self.source.growths();
        if !growths.is_empty() || self.blocks.options.by_lines() {
            recorder.clear(resources.buffer(Data::Marks));
        }
        let slots = 1 + growths.len();
        let first_slot = slots * run.index;
        let [first_rounds, grown_rounds] = self.rounds;
        self.record_rounds(recorder, resources, first_rounds, shading);
        self.counters.record(recorder, resources, first_slot);
        let mut of_growth = *uniform;
        // A grown superpixel may contain colours that no centre saw, so similar centres must not reduce its shadings.
        of_growth.alike = 0;
        for (slot, grow) in (first_slot + 1..).zip(growths) {
            resources.record_begin(recorder, set, &of_growth);
            // grow: masks, marks ─▶ masks, marks
            grow.record_for(recorder, tiles);
            self.record_rounds(recorder, resources, grown_rounds, shading);
            self.counters.record(recorder, resources, slot);
        }
    }

    fn record_rounds(&self, recorder: &Recorder<'_>, resources: &Resources, rounds: u32, shading: &dyn RecordShading) {
        for pass in &self.candidates {
            // cull: masks ─▶ survivors
            // bin: masks, survivors ─▶ tiles, pairs
            // tally: masks, tiles ─▶ tiles
            pass.record(recorder);
        }
        resources.record_rounds(recorder, rounds, |recorder| {
            for pass in &self.visibility {
                // schedule: masks, tiles ─▶ tiles
                // enlist: masks, tiles ─▶ tiles, tile_lists
                // setup: tiles, pairs ─▶ candidates
                // sample_lines: ids, display, masks, tiles, tile_lists, candidates, marks ─▶ tile_lists, headers, fragments, marks
                // sample: ids, display, masks, tiles, tile_lists, candidates, marks ─▶ headers, fragments
                pass.record(recorder);
            }
            self.sort.record(recorder);
            shading.record(recorder, resources);
            for pass in &self.colors {
                // resolve: ids, display, masks, tiles, tile_lists, headers, fragments, shaded, marks ─▶ display, color, marks, spreads
                pass.record(recorder);
            }
        });
    }

    /// Adds the work that the last recording could not finish. `tiles` holds the number of tiles of each run of the
    /// recording.
    ///
    /// # Errors
    /// If the counters can't be read.
    pub fn add_shortfall(
        &self,
        tiles: impl IntoIterator<Item = u32>,
        shortfall: &mut Shortfall,
    ) -> Result<(), VulkanError> {
        for (tiles, counted) in tiles.into_iter().zip(self.counted()?) {
            for counters in counted {
                let [triangles, pairs] = self.capacities;
                let room = CountedRoom { tiles, triangles, pairs };
                shortfall.add(counters, room, self.capacity.samples_unlisted);
            }
        }
        Ok(())
    }

    /// Adds the statistics of the last recording. `tiles` holds the number of tiles of each run of the recording.
    ///
    /// # Errors
    /// If the counters can't be read.
    pub fn add_statistics(
        &self,
        tiles: impl IntoIterator<Item = u32>,
        statistics: &mut Statistics,
    ) -> Result<(), VulkanError> {
        for (tiles, counted) in tiles.into_iter().zip(self.counted()?) {
            for (growth, counters) in counted.enumerate() {
                statistics.add(counters);
                match &self.source {
                    Source::Pixels { .. } if growth == 0 => statistics.add_scene(counters),
                    _ => {}
                }
            }
            statistics.tiles += u64::from(tiles);
        }
        Ok(())
    }

    /// Number of locations in the last recording's lists that were left out, because they lay outside of their region.
    ///
    /// # Errors
    /// If the counters can't be read.
    pub fn left_out(&self) -> Result<u32, VulkanError> {
        let counters = self.counted()?.flatten();
        Ok(counters.map(|counters| Counter::LeftOut.of(counters)).sum())
    }

    /// Counters of each run of the last recording: of the detected superpixels, followed by those of each growth.
    fn counted(&self) -> Result<impl Iterator<Item = ChunksExact<'_, u32>>, VulkanError> {
        self.counters.read(1 + self.growths())
    }
}

impl Source {
    fn growths(&self) -> &[Pass] {
        match self {
            Self::Pixels { growths, .. } => growths,
            Self::List(_) => &[],
        }
    }
}

/// Passes that average shaded visibility samples, after those that blend the layers of scenes that may have some. Arguments are
/// those of [`resolve::pass`].
fn averaging(
    context: &SamplerContext<'_>,
    blocks: &SampleBlocks,
    target: ResolveTarget,
    behind: Option<&Arc<HostImage>>,
) -> Result<Vec<Pass>, EngineError> {
    let (layout, output) = (context.layout, &context.output);
    let resolve = resolve::pass(layout, blocks, target, output, behind)?;
    Ok(match context.scene.has_blend() {
        true => vec![composite::pass(layout, output)?, resolve],
        false => vec![resolve],
    })
}

/// Rate of visibility samples for a rate of shading.
pub(crate) fn fragment_rate(shading: Shading, scene: &dyn Content) -> FragmentRate {
    match shading {
        Shading::Part if scene.has_high_frequency() => FragmentRate::Part,
        Shading::Triangle | Shading::Part => FragmentRate::Triangle,
        Shading::Sample => FragmentRate::Sample,
    }
}

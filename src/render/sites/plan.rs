//! How many sites are sampled at once: what memory and the device's limits allow.

use super::engine::cell_sizes;
use super::partition::{Partition, Window};
use crate::passes::{
    Cells, Content, FrameGeometry, FrameLayout, GpuScene, ResourceSizes, SiteSizes,
};
use crate::render::plan::Effort;
use crate::render::{RenderError, Settings, Shading};
use std::ops::Range;

/// Most sites of a run: memory that stays at hand is used again.
const MOST_SITES: usize = 1 << 18;
/// Most samples of a run that may have to be stopped.
const MOST_STOPPABLE: usize = 1 << 20;
/// Fewest sites of a run, to which runs are cut where memory is bounded.
const FEWEST_SITES: usize = 1 << 10;
/// Most visibility records and candidates of a round.
const MOST_RECORDS: u64 = 6 << 20;
const MOST_CANDIDATES: u64 = 2 << 20;
/// Most pairs of a triangle and a tile.
const MOST_PAIRS: u64 = 8 << 20;

/// The runs of a set of sites and the memory that the largest of them needs.
pub(super) struct SitePlan {
    pub runs: Vec<Range<usize>>,
    pub sizes: ResourceSizes,
    /// Rounds of lists and records that a run may take.
    pub rounds: u32,
}

impl SitePlan {
    /// Plans the runs of a partition; `taken` bytes of what the settings allow are used already.
    ///
    /// # Errors
    /// [`RenderError::Memory`] if not even short runs fit.
    pub fn new(
        layout: &FrameLayout,
        scene: &GpuScene,
        settings: &Settings,
        partition: &Partition<'_>,
        taken: u64,
        may_stop: bool,
    ) -> Result<Self, RenderError> {
        let limits = layout.gpu.limits();
        let cells = partition.cells;
        let mut longest = MOST_SITES;
        if may_stop && !cells.are_points() {
            longest = (MOST_STOPPABLE / settings.samples.max(1) as usize).min(MOST_SITES);
        }
        loop {
            let runs = partition.runs(longest);
            let windows = runs.iter().map(|run| partition.window(run));
            let most = runs.iter().map(ExactSizeIterator::len).max().unwrap_or(0);
            let sizes = sizes(layout, scene, settings, cells, windows, most as u64);
            let needed = taken + sizes.bytes() + FrameGeometry::bytes(scene);
            let fits = sizes.largest_storage() <= limits.max_storage_bytes
                && sizes.largest_texels() <= limits.max_texel_elements;
            if fits && settings.max_memory.is_none_or(|allowed| needed <= allowed) {
                let samples = if cells.are_points() {
                    1
                } else {
                    settings.samples
                };
                // Tiles reserve room for as many records as samples.
                let reserved =
                    (most as u64 * u64::from(samples)).div_ceil(sizes.record_capacity.into());
                let usual = Effort::default().rounds_for(samples);
                return Ok(Self {
                    runs,
                    sizes,
                    rounds: usual.max(reserved as u32),
                });
            }
            if longest <= FEWEST_SITES {
                return Err(RenderError::Memory {
                    needed,
                    allowed: settings.max_memory.unwrap_or(limits.max_storage_bytes),
                });
            }
            longest /= 2;
        }
    }
}

fn sizes(
    layout: &FrameLayout,
    scene: &GpuScene,
    settings: &Settings,
    cells: Cells,
    windows: impl Iterator<Item = Window>,
    most: u64,
) -> ResourceSizes {
    let limits = layout.gpu.limits();
    let region = windows.fold([0; 2], |most: [u32; 2], window| {
        let [width, height] = window.size();
        // Windows share one buffer of tiles, however long and wide each is.
        if u64::from(width) * u64::from(height) > u64::from(most[0]) * u64::from(most[1]) {
            [width, height]
        } else {
            most
        }
    });
    let tiles = u64::from(region[0] / 8) * u64::from(region[1] / 4);
    let cell_sizes = cell_sizes(layout, cells, settings.samples);
    let [in_cell, in_group] = [cell_sizes.in_cell, cell_sizes.in_group].map(|size| size as u64);
    let cell_count = most.min(most / in_cell + tiles);
    let group_count = cell_count.min(cell_count / in_group + tiles);
    let samples = u64::from(settings.samples);
    let records = match cells {
        Cells::Points if scene.has_blend() => 4 * most,
        Cells::Points | Cells::Occluders => most,
        _ if settings.shading == Shading::Sample || scene.has_blend() => most * samples.min(64),
        _ => most * (6 * samples.div_ceil(64)).min(samples).max(2),
    };
    let triangles = scene.triangle_count();
    let pairs = (triangles * 4 + tiles * 16).clamp(1 << 14, MOST_PAIRS);
    let candidates = (triangles * 3 + tiles * 8).clamp(1 << 14, MOST_CANDIDATES);
    ResourceSizes {
        region,
        lanes: limits.lanes,
        sites: Some(SiteSizes {
            sites: most as u32,
            cells: cell_count as u32,
            groups: group_count as u32,
        }),
        survivor_capacity: scene.index_count(),
        pair_capacity: pairs.min(ResourceSizes::most_pairs(limits)) as u32,
        list_capacity: candidates.min(ResourceSizes::most_candidates(limits)) as u32,
        record_capacity: records.clamp(1 << 16, MOST_RECORDS) as u32,
        filtered: 0,
        attributes: cells.are_points(),
        encoded: 0,
    }
}

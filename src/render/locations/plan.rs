//! How many locations are sampled at once: what memory and the device's limits allow.

use super::engine::{Sampling, cell_sizes};
use super::partition::{Partition, Window};
use crate::passes::{
    Cells, Content, FrameGeometry, FrameLayout, GpuScene, LocationSizes, ResourceSizes,
};
use crate::render::plan::Capacity;
use crate::render::{RenderError, Settings, Shading};
use std::ops::Range;

/// Most locations of a run: memory that stays at hand is used again.
const MOST_LOCATIONS: usize = 1 << 18;
/// Most samples of a run that may have to be stopped.
const MOST_STOPPABLE: usize = 1 << 20;
/// Most records of a run that the host is given.
const MOST_HANDED: usize = 1 << 18;
/// Fewest locations of a run, or records that the host is given, to which runs are cut where memory is bounded.
const FEWEST_LOCATIONS: usize = 1 << 10;
/// Most visibility samples and candidates of a round.
const MOST_RECORDS: u64 = 6 << 20;
const MOST_CANDIDATES: u64 = 2 << 20;
/// Most pairs of a triangle and a tile.
const MOST_PAIRS: u64 = 8 << 20;

/// The runs of a set of locations and the memory that the largest of them needs.
pub(super) struct LocationPlan {
    pub runs: Vec<Range<usize>>,
    pub sizes: ResourceSizes,
    /// Rounds of lists and records that a run may take.
    pub rounds: u32,
    /// Most records of a run that the host is given.
    pub handed: u32,
}

impl LocationPlan {
    /// Plans the runs of a partition; `taken` bytes of what the settings allow are used already.
    ///
    /// # Errors
    /// [`RenderError::Memory`] if not even short runs fit.
    pub fn new(
        layout: &FrameLayout,
        scene: &GpuScene,
        settings: &Settings,
        (partition, sampling): (&Partition<'_>, Sampling),
        taken: u64,
        may_stop: bool,
    ) -> Result<Self, RenderError> {
        let limits = layout.gpu.limits();
        let handed = sampling.hands_over_records();
        let samples = match sampling.cells.are_points() {
            true => 1,
            false => settings.samples.max(1) as usize,
        };
        let mut longest = if handed {
            MOST_HANDED / samples
        } else if may_stop && samples > 1 {
            (MOST_STOPPABLE / samples).min(MOST_LOCATIONS)
        } else {
            MOST_LOCATIONS
        };
        loop {
            let runs = partition.runs(longest);
            let windows = runs.iter().map(|run| partition.window(run));
            let most = runs.iter().map(ExactSizeIterator::len).max().unwrap_or(0);
            let sizes = sizes(layout, scene, settings, sampling, windows, most as u64);
            let records = u64::from(sizes.record_capacity);
            let most_handed = match (handed, scene.has_blend()) {
                (false, _) => 0,
                (true, true) => records,
                (true, false) => records.min((most * samples) as u64),
            };
            let copied = 16 * most_handed;
            let held = copied + sizes.bytes() + FrameGeometry::bytes(scene);
            // As much is left for what lights see of a run.
            let needed = taken + if sampling.shadows { 2 * held } else { held };
            let fits = sizes.largest_storage() <= limits.max_storage_bytes
                && sizes.largest_texels() <= limits.max_texel_elements;
            if fits && settings.max_memory.is_none_or(|allowed| needed <= allowed) {
                // Tiles reserve room for as many records as samples.
                let reserved = ((most * samples) as u64).div_ceil(records) as u32;
                let usual = Capacity::default().rounds_for(samples as u32);
                return Ok(Self {
                    runs,
                    sizes,
                    rounds: if handed { 1 } else { usual.max(reserved) },
                    handed: most_handed as u32,
                });
            }
            let fewest = if handed {
                FEWEST_LOCATIONS / samples
            } else {
                FEWEST_LOCATIONS
            };
            if longest <= fewest.max(1) {
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
    sampling: Sampling,
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
    let Sampling { cells, shadows } = sampling;
    let cell_sizes = cell_sizes(layout, cells, settings.samples);
    let [in_cell, in_group] = [cell_sizes.in_cell, cell_sizes.in_group].map(|size| size as u64);
    let cell_count = most.min(most / in_cell + tiles);
    let group_count = cell_count.min(cell_count / in_group + tiles);
    let samples = u64::from(settings.samples);
    let handed = sampling.hands_over_records();
    // Where one round holds all, tiles reserve room for as many as samples, or for lists of layers.
    let in_sample = if scene.has_blend() { 6 } else { 1 };
    let records = match cells {
        Cells::Superpixels if handed => most * samples * in_sample,
        Cells::Points if handed => most * in_sample,
        Cells::Points if scene.has_blend() => 4 * most,
        Cells::Points | Cells::Occluders => most,
        _ if settings.shading == Shading::Sample || scene.has_blend() => most * samples.min(64),
        _ => most * (6 * samples.div_ceil(64)).min(samples).max(2),
    };
    let triangles = scene.triangle_count();
    let pairs = (triangles * 4 + tiles * 16).clamp(1 << 14, MOST_PAIRS);
    let candidates = if handed {
        pairs.min(MOST_CANDIDATES)
    } else {
        (triangles * 3 + tiles * 8).clamp(1 << 14, MOST_CANDIDATES)
    };
    ResourceSizes {
        region,
        lanes: limits.lanes,
        locations: Some(LocationSizes {
            locations: most as u32,
            cells: cell_count as u32,
            groups: group_count as u32,
        }),
        survivor_capacity: scene.index_count(),
        pair_capacity: pairs.min(ResourceSizes::most_pairs(limits)) as u32,
        list_capacity: candidates.min(ResourceSizes::most_candidates(limits)) as u32,
        record_capacity: records.clamp(1 << 16, MOST_RECORDS) as u32,
        filtered: 0,
        shadows,
        attributes: cells == Cells::Points,
        encoded: 0,
    }
}

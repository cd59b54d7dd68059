//! How many locations are sampled at once: what memory and the device's limits allow.

use super::engine::Sampling;
use super::partition::{Partition, Window};
use crate::passes::{Content, FrameGeometry, FrameLayout, GpuScene, ResourceSizes};
use crate::render::plan::Capacity;
use crate::render::{RenderError, Settings};
use std::ops::Range;

/// Most locations of a run: memory that stays at hand is used again.
const MOST_LOCATIONS: usize = 1 << 18;
/// Most samples of a run that may have to be stopped.
const MOST_STOPPABLE: usize = 1 << 20;
/// Most records of a run that the host is given.
const MOST_HANDED: usize = 1 << 18;
/// Fewest locations of a run, or records that the host is given, to which runs are cut where memory is bounded.
const FEWEST_LOCATIONS: usize = 1 << 10;

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
                let kind = sampling.kind(false);
                let usual = kind.rounds(&sizes, settings, Capacity::default());
                return Ok(Self {
                    runs,
                    sizes,
                    rounds: if handed { 1 } else { usual },
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
    let region = windows.fold([0; 2], |most: [u32; 2], window| {
        let [width, height] = window.size();
        // Windows share one buffer of tiles, however long and wide each is.
        if u64::from(width) * u64::from(height) > u64::from(most[0]) * u64::from(most[1]) {
            [width, height]
        } else {
            most
        }
    });
    let room = (most as u32, region);
    let kind = sampling.kind(false);
    let at_once = sampling.hands_over_records();
    ResourceSizes {
        shadows: sampling.shadows,
        ..kind.sizes(layout, scene, settings, room, 1, at_once)
    }
}

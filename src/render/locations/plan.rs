//! Number of locations that are sampled at once, by memory and the device's limits.

use super::ListSettings;
use super::partition::Partition;
use super::sampler::list_cells;
use crate::engine::data::{Cells, ResourceSizes};
use crate::engine::pipelines::FrameLayout;
use crate::engine::sampler::Capacity;
use crate::render::data::FrameGeometry;
use crate::render::plane::PlaneWindow;
use crate::render::{EngineError, PreparedScene, RenderError, Shadows};
use std::ops::Range;
use std::sync::Arc;

/// Largest number of locations of a run; more would not make sampling faster.
const MOST_LOCATIONS: usize = 1 << 18;
/// Largest number of samples of a superpixel run if [`Headless::stop_when`](crate::render::Headless::stop_when) is
/// used.
const MOST_STOPPABLE: usize = 1 << 20;
/// Number of locations below which runs are not cut further when memory is limited.
const FEWEST_LOCATIONS: usize = 1 << 10;

/// Runs of a list of locations, and the memory that the largest run needs.
pub(super) struct LocationPlan {
    pub cells: Cells,
    /// Number of places for which lights are looked up.
    pub places: u64,
    pub runs: Vec<Range<usize>>,
    pub sizes: ResourceSizes,
    /// Capacity for which the plan was made.
    pub capacity: Capacity,
}

impl LocationPlan {
    /// Plans the runs of a partition.
    ///
    /// # Errors
    /// [`EngineError::Memory`](crate::render::EngineError::Memory) if not even short runs fit, [`VulkanError::TooLarge`] if these
    /// exceed a limit of the device, [`RenderError::NoCasters`] if shadows are asked for and the scene was not prepared for them.
    pub fn new(
        layout: &Arc<FrameLayout>,
        prepared: &PreparedScene,
        settings: &ListSettings,
        partition: &Partition<'_>,
        may_stop: bool,
        capacity: Capacity,
    ) -> Result<Self, RenderError> {
        let (limits, scene) = (layout.gpu.limits(), &*prepared.gpu_scene);
        let casters = match settings.scene.shadows {
            Shadows::None => None,
            Shadows::Exact => Some(prepared.casters.as_ref().ok_or(RenderError::NoCasters)?),
        };
        let cells = partition.cells;
        let samples = match cells.are_points() {
            true => 1,
            false => settings.sampler.cells.samples as usize,
        };
        let places = partition.places();
        let mut longest =
            if may_stop && samples > 1 { (MOST_STOPPABLE / samples).min(MOST_LOCATIONS) } else { MOST_LOCATIONS };
        loop {
            let runs = partition.runs(longest);
            let windows = runs.iter().map(|run| partition.window(run));
            let most = runs.iter().map(ExactSizeIterator::len).max().unwrap_or(0);
            let region = region(windows);
            let words = casters.map_or(0, |casters| casters.shadow_words());
            let sizes = list_cells(cells, words, settings.spread).sizes(
                layout,
                scene,
                &settings.sampler.cells,
                most as u32,
                region,
                capacity,
            );
            let shadows = |casters| settings.shadows(layout, casters, capacity, places);
            let of_shadows = casters.map_or(0, |casters| shadows(casters).bytes());
            let held = sizes.planned_bytes() + FrameGeometry::bytes(scene) + of_shadows;
            let needed = prepared.memory_bytes() + held;
            let checked = sizes.check(limits);
            if checked.is_ok() && settings.scene.max_memory.is_none_or(|allowed| needed <= allowed) {
                return Ok(Self { cells, places, runs, sizes, capacity });
            }
            if longest <= FEWEST_LOCATIONS {
                checked?;
                return Err(RenderError::Engine(EngineError::Memory {
                    needed,
                    allowed: settings.scene.max_memory.unwrap_or(limits.max_storage_bytes),
                }));
            }
            longest /= 2;
        }
    }
}

/// Size in pixels of the largest window. All windows share one buffer of tiles, whatever their proportions.
fn region(windows: impl Iterator<Item = PlaneWindow>) -> [u32; 2] {
    let area = |[width, height]: [u32; 2]| u64::from(width) * u64::from(height);
    let sizes = windows.map(|window| window.size());
    sizes.max_by_key(|size| area(*size)).unwrap_or_default()
}

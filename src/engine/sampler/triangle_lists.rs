//! Lists of the triangles that may touch the tiles of a plane, for passes that look places up in them.

use super::{Capacity, CellOptions, ListCells};
use crate::engine::data::tiles::tile_count;
use crate::engine::data::{Cells, Content, FrameUniform, ResourceSizes, Resources, SampleSet};
use crate::engine::passes::cull::CullFilter;
use crate::engine::passes::setup::ListOrder;
use crate::engine::passes::{bin, cull, refine, schedule, setup, tally};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::sampler::plan::MOST_CANDIDATES;
use crate::engine::spirv;
use crate::vulkan::{Recorder, VulkanError};

/// Passes that list the triangles of all tiles of a plane, in one round.
pub(crate) struct TriangleLists([Pass; 6]);

/// Numbers of pairs of a triangle and a tile for which a plane usually has room: for each triangle, for each tile, and at
/// least.
const PAIRS_OF_TRIANGLE: u64 = 4;
const PAIRS_OF_TILE: u64 = 8;
const FEWEST_PAIRS: u64 = 1 << 14;

/// Kind of the cells for which the passes are made. A tile has one cell, which stands for all places that are looked up.
const PLACES: ListCells =
    ListCells { cells: Cells::Points, attributes: false, shadow_words: 0, lent: true, spread: None };

/// Load of a tile: see `shaders/include/load.glsl`. A list may have any length.
const LOAD: spirv::SchedulePush = spirv::SchedulePush {
    block: 1,
    per_sample: 1,
    layers: 0,
    parts: 1,
    teams_first: 1,
    teams_unlisted: 1,
    longest_list: u32::MAX,
    longest_layered: u32::MAX,
    more_fragments: 0,
};

impl TriangleLists {
    /// Sizes of the memory for a plane of `region` pixels, whose sides are whole tiles.
    pub fn sizes(
        layout: &FrameLayout,
        scene: &dyn Content,
        options: &CellOptions,
        region: [u32; 2],
        capacity: Capacity,
    ) -> ResourceSizes {
        let sizes = PLACES.sizes(layout, scene, options, 1, region, capacity);
        let [triangles, tiles] = [scene.triangle_slots().into(), tile_count(region)];
        let usual = (PAIRS_OF_TRIANGLE * triangles + PAIRS_OF_TILE * tiles).clamp(FEWEST_PAIRS, MOST_CANDIDATES);
        // All lists are in memory at once.
        let pairs = capacity.planes.pairs.max(usual as u32);
        ResourceSizes { pair_capacity: pairs, list_capacity: pairs, has_refined: true, fragment_capacity: 0, ..sizes }
    }

    /// Makes the passes.
    ///
    /// # Errors
    /// If the driver refuses a pipeline.
    pub fn new(layout: &FrameLayout, scene: &dyn Content) -> Result<Self, VulkanError> {
        Ok(Self([
            cull::pass(layout, scene, CullFilter::Touching)?,
            bin::pass(layout, scene)?,
            tally::pass(layout, PLACES.cells, LOAD)?,
            schedule::pass(layout, PLACES.cells, LOAD)?,
            setup::pass(layout, scene, ListOrder::Scanned)?,
            refine::pass(layout)?,
        ]))
    }

    /// Records the passes for a plane with this uniform block. Passes use the set `set` from here on.
    pub fn record(&self, recorder: &Recorder<'_>, resources: &Resources, set: &SampleSet, uniform: FrameUniform) {
        /// Room for visibility samples that no round exceeds: none are made.
        const ANY_NUMBER: u32 = 1 << 30;
        let uniform = FrameUniform { fragment_capacity: ANY_NUMBER, ..uniform };
        resources.record_begin(recorder, set, &uniform);
        resources.record_all_tiles(recorder);
        for pass in &self.0 {
            pass.record(recorder);
        }
    }
}

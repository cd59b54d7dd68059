//! Lists of the triangles that may touch the tiles of a plane, for passes that look places up in them.

use super::{Capacity, CellOptions, ListCells, Load, SamplerContext};
use crate::engine::data::tiles::tile_count;
use crate::engine::data::{Cells, Content, FrameUniform, ResourceSizes, Resources, SampleSet};
use crate::engine::passes::cull::CullFilter;
use crate::engine::passes::setup::ListOrder;
use crate::engine::passes::{SampleBlocks, bin, cull, schedule, setup, tally};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::sampler::plan::MOST_CANDIDATES;
use crate::vulkan::{Recorder, VulkanError};

/// Passes that list the triangles of all tiles of a plane. Tiles with too many triangles get no list.
pub(crate) struct TileLists([Pass; 5]);

/// Numbers of pairs of a triangle and a tile for which a plane has room: for each triangle, for each tile, and at least.
const PAIRS_OF_TRIANGLE: u64 = 4;
const PAIRS_OF_TILE: u64 = 8;
const FEWEST_PAIRS: u64 = 1 << 14;

/// Kind of the cells for which the passes are made. A tile has one cell, which stands for all places that are looked up.
const PLACES: ListCells = ListCells { cells: Cells::Occluders, attributes: false, shadow_words: 0, lent: true };

impl TileLists {
    /// Sizes of the memory for a plane of `region` pixels, whose sides are whole tiles.
    pub fn sizes(
        layout: &FrameLayout,
        scene: &dyn Content,
        options: &CellOptions,
        region: [u32; 2],
        capacity: Capacity,
    ) -> ResourceSizes {
        let sizes = PLACES.sizes(layout, scene, options, (1, region), capacity);
        let [triangles, tiles] = [scene.triangle_slots().into(), tile_count(region)];
        // All lists are in memory at once.
        let pairs = (PAIRS_OF_TRIANGLE * triangles + PAIRS_OF_TILE * tiles).clamp(FEWEST_PAIRS, MOST_CANDIDATES) as u32;
        ResourceSizes {
            pair_capacity: pairs,
            list_capacity: pairs,
            record_capacity: sizes.record_capacity.max(tiles as u32),
            ..sizes
        }
    }

    /// Makes the passes, for memory of the context's sizes.
    ///
    /// # Errors
    /// If the driver refuses a pipeline.
    pub fn new(context: &SamplerContext<'_>) -> Result<Self, VulkanError> {
        let (layout, scene) = (context.layout, context.scene);
        let limits = layout.gpu.limits();
        let options = context.sample_options(Cells::Occluders, 1);
        let blocks = SampleBlocks::new(limits.teams, options);
        let load = Load::new(limits, blocks, context.capacity.layers);
        Ok(Self([
            cull::pass(layout, scene, CullFilter::Touching)?,
            bin::pass(layout, scene)?,
            tally::pass(layout, Cells::Occluders, load.pushed())?,
            schedule::pass(layout, Cells::Occluders, load.pushed())?,
            setup::pass(layout, scene, ListOrder::Scanned)?,
        ]))
    }

    /// Records the passes. Passes use the set `set` from here on.
    pub fn record(&self, recorder: &Recorder<'_>, (resources, set): (&Resources, &SampleSet), uniform: &FrameUniform) {
        resources.record_begin(recorder, set, uniform);
        resources.record_all_tiles(recorder);
        for pass in &self.0 {
            pass.record(recorder);
        }
    }
}

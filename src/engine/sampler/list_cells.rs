//! Cells that are locations of a list.

use super::{Sampler, SamplerContext, Source, averaging};
use crate::engine::data::tiles::tile_count;
use crate::engine::data::{CellSizes, Cells, Content, LocationSizes, ResourceSizes, Resources};
use crate::engine::passes::resolve::ResolveTarget;
use crate::engine::passes::{Distribute, SampleOptions, points};
use crate::engine::pipelines::FrameLayout;
use crate::engine::sampler::plan::{
    MOST_CANDIDATES, MOST_FRAGMENTS, MOST_PAIRS, fragments_of_superpixel, most_fragments,
};
use crate::engine::sampler::{Capacity, CellOptions, EngineError};
use crate::sampling::Bend;
use crate::vulkan::Descriptor;

/// Kind of the cells of a list, and the results that are computed for them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ListCells {
    pub cells: Cells,
    /// Whether attributes are written, for locations that are sampled once.
    pub attributes: bool,
    /// Number of shadow words of each place; their bits say which lights reach it.
    pub shadow_words: u32,
    /// Whether an application lends the list and takes the colours on the device.
    pub lent: bool,
    /// For a pixel filter, the function by which the spread of cells is described; `None` if it is not stored.
    pub spread: Option<Bend>,
}

impl ListCells {
    /// Offsets of a cell's samples, and the number of samples.
    ///
    /// # Errors
    /// If the pattern can't have this number of samples.
    pub fn offsets(&self, layout: &FrameLayout, options: &CellOptions) -> Result<(Vec<[f32; 2]>, u32), EngineError> {
        let (own, count) = if self.cells.are_points() {
            (vec![[0.0; 2]], self.cell_sizes(layout, options).in_cell)
        } else {
            let own = options.pattern.offsets(options.samples)?;
            (own, options.samples)
        };
        Ok((own, count))
    }

    fn cell_sizes(&self, layout: &FrameLayout, options: &CellOptions) -> CellSizes {
        CellSizes::new(layout.gpu.limits().teams.members, self.cells, options.samples)
    }

    /// Sizes of the memory for `locations` locations in a region of `region` pixels, whose sides are whole tiles.
    pub fn sizes(
        &self,
        layout: &FrameLayout,
        scene: &dyn Content,
        options: &CellOptions,
        locations: u32,
        region: [u32; 2],
        capacity: Capacity,
    ) -> ResourceSizes {
        let limits = layout.gpu.limits();
        let tiles = tile_count(region);
        let most = u64::from(locations);
        let fragments = match self.cells {
            Cells::Points if scene.has_blend() => u64::from(Capacity::LAYERS) * most,
            Cells::Points => most,
            Cells::Superpixels | Cells::Pixels => most * fragments_of_superpixel(options, scene),
        };
        let triangles = u64::from(scene.triangle_slots());
        let pairs = (triangles * 4 + tiles * 16).clamp(1 << 14, MOST_PAIRS);
        let candidates = (triangles * 3 + tiles * 8).clamp(1 << 14, MOST_CANDIDATES);
        let cell_sizes = self.cell_sizes(layout, options);
        let locations = LocationSizes { lent: self.lent, ..LocationSizes::new(locations, tiles as u32, &cell_sizes) };
        // The memory of candidates has room for all points, because all of them may lie in tiles without a list.
        let points =
            if self.cells.are_points() { u64::from(locations.places) / ResourceSizes::CANDIDATE_TEXELS } else { 0 };
        let candidates = candidates.max(if scene.has_blend() { 2 * points } else { points });
        let at_most = |room: u64, most: u64| (room * u64::from(capacity.lists)).min(most) as u32;
        // If the device turned out to need more layers, each location has room for all layers of its samples.
        let of_location = match self.cells {
            Cells::Points => 1,
            Cells::Superpixels | Cells::Pixels => u64::from(options.samples),
        };
        let most_fragments = most_fragments(limits) / if self.spread.is_some() { 2 } else { 1 };
        let layered = if scene.has_blend() { capacity.layered(of_location).min(most_fragments) } else { 0 };
        ResourceSizes {
            locations: Some(locations),
            survivor_capacity: scene.triangle_slots(),
            pair_capacity: at_most(pairs, ResourceSizes::most_pairs(limits)),
            list_capacity: at_most(candidates, ResourceSizes::most_candidates(limits)),
            fragment_capacity: fragments.clamp(1 << 16, MOST_FRAGMENTS).max(layered) as u32,
            shadow_words: self.shadow_words,
            attributes: self.attributes,
            spreads: self.spread.is_some(),
            ..ResourceSizes::new(region, scene.bin_count(), limits)
        }
    }

    /// Makes a sampler for the locations in the view `locations`.
    ///
    /// # Errors
    /// If the driver refuses a pipeline, or memory runs out.
    ///
    /// # Safety
    /// The view `locations` outlives the sampler, and has as many locations as the resources have room for.
    pub unsafe fn sampler(
        &self,
        context: &SamplerContext<'_>,
        resources: &Resources,
        locations: Descriptor,
    ) -> Result<Sampler, EngineError> {
        let SamplerContext { layout, scene, settings, ref output, .. } = *context;
        let sizes = self.cell_sizes(layout, &settings.cells);
        let samples = if self.cells.are_points() { sizes.in_cell } else { settings.cells.samples };
        let options = SampleOptions { spread: self.spread, ..context.sample_options(self.cells, samples) };
        let source = || {
            // SAFETY: guaranteed by the caller.
            let distribute = unsafe { Distribute::of_lent(layout, self.cells, sizes, resources, locations) }?;
            Ok(Source::List(distribute))
        };
        Sampler::new(context, &options, source, |blocks| match self.cells {
            Cells::Points => Ok(vec![points::pass(layout, scene, output, self.attributes, self.shadow_words)?]),
            Cells::Superpixels | Cells::Pixels => averaging(context, blocks, ResolveTarget::Nothing, None),
        })
    }
}

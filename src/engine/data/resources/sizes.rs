//! Sizes of a frame's memory.

use super::table::Data;
use crate::engine::data::tiles::tiles;
use crate::engine::data::{LocationSizes, STRETCH};
use crate::engine::spirv::{FILTER_TRIANGLES, SHADOW_POINTS, TILE_LISTS};
use crate::vulkan::{Limits, VulkanError};

/// Number of bytes of what comes with the buffers of a frame.
const BESIDE: u64 = 64 << 10;

/// Sizes of a frame's memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResourceSizes {
    /// Width and height of the largest region, in pixels.
    pub region: [u32; 2],
    /// Number of members of a team; an entry of a work list has as many cells.
    pub team: u32,
    /// Whether the device can skip rounds.
    pub skips_rounds: bool,
    /// Number of shading keys.
    pub bins: u32,
    /// Sizes for locations, if cells are locations instead of pixels.
    pub locations: Option<LocationSizes>,
    /// Largest number of triangles that may touch a cell, or that are thin.
    pub survivor_capacity: u32,
    /// Number of triangle slots of which `filter` lists some; 0 if it does not run.
    pub filtered_triangles: u32,
    /// Largest number of pairs of a triangle and a tile, over all rounds.
    pub pair_capacity: u32,
    /// Largest number of candidates in all lists of a round.
    pub list_capacity: u32,
    /// Whether there is room for refined lists of crowded tiles, see `shaders/refine.comp`: a vector for each candidate.
    pub has_refined: bool,
    /// Largest number of visibility samples of a round; 0 if no cell is ever sampled.
    pub fragment_capacity: u32,
    /// Number of pixels of a region after a filter; 0 without one.
    pub filtered: u32,
    /// Whether the spread of visibility samples and of superpixels is stored, for a pixel filter.
    pub spreads: bool,
    /// Number of weights of a pixel filter for supersampled pixels; 0 without one.
    pub filter_weights: u32,
    /// Number of shadow words of each shaded place; their bits say which lights reach it. 0 without shadows. See
    /// `shaders/include/shadows.glsl`.
    pub shadow_words: u32,
    /// Whether attributes are written.
    pub attributes: bool,
    /// Number of bytes of a region that is encoded, and of the thresholds before it; 0 without encoding.
    pub encoded: u64,
}

impl ResourceSizes {
    /// Number of elements of a candidate in a texel buffer.
    pub const CANDIDATE_TEXELS: u64 = 4;

    /// Sizes for regions of `region` pixels and `bins` shading keys on a device with these limits, without room for
    /// anything else.
    #[must_use]
    pub fn new(region: [u32; 2], bins: u32, limits: &Limits) -> Self {
        Self {
            region,
            team: limits.teams.members,
            skips_rounds: limits.conditional_rendering,
            bins,
            locations: None,
            survivor_capacity: 0,
            filtered_triangles: 0,
            pair_capacity: 0,
            list_capacity: 0,
            has_refined: false,
            fragment_capacity: 0,
            filtered: 0,
            spreads: false,
            filter_weights: 0,
            shadow_words: 0,
            attributes: false,
            encoded: 0,
        }
    }

    /// Largest number of pairs in a buffer of the device.
    #[must_use]
    pub fn most_pairs(limits: &Limits) -> u64 {
        (limits.max_storage_bytes / 8).min(limits.max_texel_elements)
    }

    /// Largest number of candidates in a buffer of the device.
    #[must_use]
    pub fn most_candidates(limits: &Limits) -> u64 {
        (limits.max_storage_bytes / 16).min(limits.max_texel_elements) / Self::CANDIDATE_TEXELS
    }

    /// Whether memory of these sizes suffices for a region of pixels with the sizes `others`.
    pub(crate) fn suffice(&self, others: &Self) -> bool {
        let is_of_pixels = self.locations.is_none() && others.locations.is_none();
        let has_room = |data: Data| data.row(self).bytes() >= data.row(others).bytes();
        is_of_pixels && self.team == others.team && Data::ALL.into_iter().all(has_room)
    }

    /// Checks that no buffer of these sizes exceeds a limit of the device.
    ///
    /// # Errors
    /// [`VulkanError::TooLarge`] names the first buffer that does.
    pub fn check(&self, limits: &Limits) -> Result<(), VulkanError> {
        Data::ALL.into_iter().try_for_each(|data| data.row(self).check(limits))
    }

    /// Number of bytes of all buffers of these sizes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        Data::ALL.into_iter().map(|data| data.row(self).bytes()).sum()
    }

    /// Number of bytes that plans take for memory of these sizes: those of the buffers, and of what comes with them. That is
    /// alignment, uniform blocks, sample offsets and copies of counters.
    #[must_use]
    pub fn planned_bytes(&self) -> u64 {
        self.bytes() + BESIDE
    }

    /// Number of pixels of a region.
    #[must_use]
    pub fn pixels(&self) -> u32 {
        self.region[0] * self.region[1]
    }

    /// Number of colours of a region: one for each pixel or location.
    #[must_use]
    pub fn colors(&self) -> u64 {
        self.locations.map_or(u64::from(self.pixels()), |locations| u64::from(locations.locations))
    }

    /// Largest number of surfaces for which light is searched at once, in whole workgroups of 64; 0 without shadows. If pixels may
    /// become superpixels, each has several surfaces.
    #[must_use]
    pub fn receivers(&self) -> u64 {
        let pixels = self.locations.map_or(self.pixels(), |_| 0);
        let points = if self.fragment_capacity == 0 { 1 } else { SHADOW_POINTS };
        match self.shadow_words {
            0 => 0,
            _ => (u64::from(points) * u64::from(pixels)).max(self.fragment_capacity.into()).next_multiple_of(64),
        }
    }

    /// Number of shadow words of all places: of visibility samples and, if cells are pixels, of the pixels.
    pub(super) fn all_shadow_words(&self) -> u64 {
        let pixels = self.locations.map_or(self.pixels(), |_| 0);
        u64::from(self.shadow_words) * (u64::from(pixels) + u64::from(self.fragment_capacity))
    }

    /// Number of vectors of the buffer of visibility samples: one for each, and another one for its spread.
    pub(super) fn fragment_vectors(&self) -> u64 {
        u64::from(self.fragment_capacity) * if self.spreads { 2 } else { 1 }
    }

    /// Number of work items: tiles or, if there are more, groups of locations.
    pub(super) fn work_items(&self) -> u64 {
        let groups = self.locations.map_or(0, |locations| locations.groups);
        self.tiles().max(groups).into()
    }

    /// Number of entries of the work lists: one for each kind of tile, and one for each kind but the last of the cells that a first run
    /// leaves. Each has room for all entries that the cells of the work items may fill.
    pub(super) fn work_entries(&self) -> u64 {
        let of_item = if self.locations.is_some() { 1 } else { 32 / self.team };
        self.work_items() * u64::from((2 * TILE_LISTS - 1) * of_item)
    }

    /// Number of tiles of 8 x 4 pixels of a region.
    #[must_use]
    pub fn tiles(&self) -> u32 {
        let [columns, rows] = tiles(self.region);
        columns * rows
    }

    /// Number of vectors of the buffer of tiles: one for each tile, and two for each stretch of tiles.
    pub(super) fn tile_vectors(&self) -> u64 {
        let stretches = self.tiles().div_ceil(STRETCH);
        u64::from(self.tiles()) + 2 * u64::from(stretches)
    }

    /// Number of draws that `filter` makes. It makes a draw of every [`FILTER_TRIANGLES`] triangles of a run, and one of its
    /// last triangles; no run has fewer triangles.
    pub(super) fn indexed_draws(&self) -> u64 {
        2 * u64::from(self.filtered_triangles.div_ceil(FILTER_TRIANGLES))
    }
}

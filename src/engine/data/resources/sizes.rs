//! Sizes of a frame's memory.

use crate::engine::data::tiles::tiles;
use crate::engine::data::{LocationSizes, STRETCH};
use crate::engine::spirv::{FILTER_TRIANGLES, TILE_LISTS};
use crate::vulkan::{Limits, VulkanError};
use ash::vk;

/// Sizes of a frame's memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResourceSizes {
    /// Width and height of the largest region, in pixels.
    pub region: [u32; 2],
    /// Number of members of a team; an entry of a work list has as many cells.
    pub team: u32,
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
    /// Largest number of visibility samples of a round; 0 if no cell is ever sampled.
    pub record_capacity: u32,
    /// Number of pixels of a region after the box filter; 0 without the filter.
    pub filtered: u32,
    /// Number of shadow words of each shaded place; their bits say which lights reach it. 0 without shadows. See
    /// `shaders/include/shadows.glsl`.
    pub shadow_words: u32,
    /// Whether attributes are written.
    pub attributes: bool,
    /// Number of bytes of a region that is encoded, and of the thresholds before it; 0 without encoding.
    pub encoded: u64,
}

impl ResourceSizes {
    /// Number of bytes of a pair.
    pub const PAIR_BYTES: u64 = 8;
    /// Number of elements of a candidate in a texel buffer.
    pub const CANDIDATE_TEXELS: u64 = 4;
    /// Number of bytes of a candidate.
    pub const CANDIDATE_BYTES: u64 = 16 * Self::CANDIDATE_TEXELS;
    /// Number of bytes of the marks of a tile or group of locations: three words.
    pub const MARK_BYTES: u64 = 12;

    /// Largest number of pairs in a buffer of the device.
    #[must_use]
    pub fn most_pairs(limits: &Limits) -> u64 {
        (limits.max_storage_bytes / Self::PAIR_BYTES).min(limits.max_texel_elements)
    }

    /// Largest number of candidates in a buffer of the device.
    #[must_use]
    pub fn most_candidates(limits: &Limits) -> u64 {
        let texels = limits.max_texel_elements / Self::CANDIDATE_TEXELS;
        (limits.max_storage_bytes / Self::CANDIDATE_BYTES).min(texels)
    }

    /// Whether memory of these sizes suffices for a region of pixels with the sizes `others`.
    pub(crate) fn suffice(&self, others: &Self) -> bool {
        let of = |sizes: &Self| {
            let [records, lists, pairs, survivors] =
                [sizes.record_capacity, sizes.list_capacity, sizes.pair_capacity, sizes.survivor_capacity]
                    .map(u64::from);
            [
                sizes.colors(),
                sizes.tiles().into(),
                records,
                lists,
                pairs,
                survivors,
                sizes.filtered_triangles.into(),
                sizes.filtered.into(),
                sizes.all_shadow_words(),
                sizes.attributes.into(),
                sizes.encoded,
            ]
        };
        let is_of_pixels = self.locations.is_none() && others.locations.is_none();
        let mut pairs = of(self).into_iter().zip(of(others));
        is_of_pixels && self.team == others.team && pairs.all(|(room, needed)| room >= needed)
    }

    /// Number of bytes of the largest storage buffer.
    #[must_use]
    pub fn largest_storage(&self) -> u64 {
        let colors = self.colors() * 16;
        let records = u64::from(self.record_capacity) * 16;
        let candidates = u64::from(self.list_capacity) * Self::CANDIDATE_BYTES;
        let attributes = if self.attributes { 2 * colors } else { 0 };
        let pairs = u64::from(self.pair_capacity) * Self::PAIR_BYTES;
        let work = self.work_bytes();
        let receivers = u64::from(self.receivers()) * 32;
        let shadows = self.all_shadow_words() * 4;
        [attributes, colors, records, candidates, pairs, work, receivers, shadows, self.corner_bytes()]
            .into_iter()
            .fold(0, u64::max)
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

    /// Largest number of places that are shaded at once with shadows; 0 without shadows.
    #[must_use]
    pub fn receivers(&self) -> u32 {
        let pixels = self.locations.map_or(self.pixels(), |_| 0);
        match self.shadow_words {
            0 => 0,
            _ => pixels.max(self.record_capacity),
        }
    }

    /// Number of shadow words of all places: of visibility samples and, if cells are pixels, of the pixels.
    #[must_use]
    pub fn all_shadow_words(&self) -> u64 {
        let pixels = self.locations.map_or(self.pixels(), |_| 0);
        u64::from(self.shadow_words) * (u64::from(pixels) + u64::from(self.record_capacity))
    }

    /// Number of work items: tiles or, if there are more, groups of locations.
    pub(crate) fn work_items(&self) -> u64 {
        let groups = self.locations.map_or(0, |locations| locations.groups);
        self.tiles().max(groups).into()
    }

    /// Number of bytes of the work lists: one for each kind of tile, and one for each kind but the last of the cells that a first run
    /// leaves. Each has room for all entries that the cells of the work items may fill.
    pub(crate) fn work_bytes(&self) -> u64 {
        let entries = if self.locations.is_some() { 1 } else { 32 / self.team };
        let lists = 2 * TILE_LISTS - 1;
        self.work_items() * u64::from(4 * lists * entries)
    }

    /// Number of elements of the largest texel buffer.
    #[must_use]
    pub fn largest_texels(&self) -> u64 {
        let [records, pairs, candidates] =
            [self.record_capacity, self.pair_capacity, self.list_capacity].map(u64::from);
        let [locations, cells, places] =
            self.locations.map_or([0; 3], |sizes| [sizes.locations, sizes.cells, sizes.places]).map(u64::from);
        [
            self.colors(),
            records,
            self.all_shadow_words(),
            2 * u64::from(self.receivers()),
            pairs,
            candidates * Self::CANDIDATE_TEXELS,
            2 * locations,
            2 * cells,
            places,
        ]
        .into_iter()
        .fold(0, u64::max)
    }

    /// Number of tiles of 8 x 4 pixels of a region.
    #[must_use]
    pub fn tiles(&self) -> u32 {
        let [columns, rows] = tiles(self.region);
        columns * rows
    }

    /// Number of bytes of the buffer of tiles: a vector for each tile, and two for each stretch of tiles.
    pub(crate) fn tile_bytes(&self) -> u64 {
        let stretches = self.tiles().div_ceil(STRETCH);
        16 * (u64::from(self.tiles()) + 2 * u64::from(stretches))
    }

    /// Number of bytes of the corners that `filter` lists.
    pub(crate) fn corner_bytes(&self) -> u64 {
        u64::from(self.filtered_triangles) * 12
    }

    /// Number of bytes of the draws that `filter` makes. It makes a draw of every [`FILTER_TRIANGLES`] triangles of a run,
    /// and one of its last triangles; no run has fewer triangles.
    pub(crate) fn indexed_draw_bytes(&self) -> u64 {
        let draws = u64::from(self.filtered_triangles.div_ceil(FILTER_TRIANGLES)) * 2;
        draws * size_of::<vk::DrawIndexedIndirectCommand>() as u64
    }

    /// Checks that no buffer of these sizes exceeds a limit of the device; `what` describes the largest one in the
    /// error.
    ///
    /// # Errors
    /// [`VulkanError::TooLarge`] if one does.
    pub(crate) fn check(&self, what: &'static str, limits: &Limits) -> Result<(), VulkanError> {
        let (bytes, texels) = (self.largest_storage(), self.largest_texels());
        VulkanError::check_limit(what, bytes, "bytes", limits.max_storage_bytes)?;
        VulkanError::check_limit(what, texels, "elements", limits.max_texel_elements)
    }

    /// Approximate number of bytes of [`super::Resources`] with these sizes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let pixels = self.colors();
        let tiles = u64::from(self.tiles());
        let records = u64::from(self.record_capacity);
        pixels * (16 + 4 + 4 + 4)
            + tiles * 4
            + self.tile_bytes()
            + self.work_items() * Self::MARK_BYTES
            + self.work_bytes()
            + u64::from(self.list_capacity) * Self::CANDIDATE_BYTES
            + u64::from(self.pair_capacity) * Self::PAIR_BYTES
            + records * 40
            + records.max(pixels) * 4
            + u64::from(self.survivor_capacity) * 4
            + self.corner_bytes()
            + self.indexed_draw_bytes()
            + u64::from(self.filtered) * 16
            + if self.attributes { pixels * 32 } else { 0 }
            + self.all_shadow_words() * 4
            + self.encoded
            + self.locations.map_or(0, |locations| locations.bytes(tiles))
    }
}

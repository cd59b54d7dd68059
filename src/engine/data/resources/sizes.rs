//! How much room a frame needs.

use crate::engine::data::{LocationSizes, STRETCH};
use crate::vulkan::{Limits, VulkanError};

/// How much room a frame needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResourceSizes {
    /// Largest region, in pixels.
    pub region: [u32; 2],
    /// Invocations of a subgroup: an entry of a work list is as many cells.
    pub lanes: u32,
    /// Locations of a region, where cells are these instead of pixels.
    pub locations: Option<LocationSizes>,
    /// Triangles that may touch a cell, or are thin.
    pub survivor_capacity: u32,
    /// Pairs of a triangle and a tile of all rounds.
    pub pair_capacity: u32,
    /// Candidates of all lists of a round.
    pub list_capacity: u32,
    /// Visibility samples of a round; 0 where no cell is ever sampled.
    pub record_capacity: u32,
    /// Pixels of a region after the box filter; 0 without one.
    pub filtered: u32,
    /// Words of each place that is shaded, which say what lights reach it; 0 where that is not asked. See
    /// `shaders/include/shadows.glsl`.
    pub shadow_words: u32,
    /// Whether attributes are asked for.
    pub attributes: bool,
    /// Bytes of a region encoded for a host's image; 0 without one.
    pub encoded: u64,
}

impl ResourceSizes {
    /// Bytes of a pair.
    pub const PAIR_BYTES: u64 = 8;
    /// Elements of a candidate in a texel buffer.
    pub const CANDIDATE_TEXELS: u64 = 4;
    /// Bytes of a candidate.
    pub const CANDIDATE_BYTES: u64 = 16 * Self::CANDIDATE_TEXELS;
    /// Bytes of the marks of a tile or group of locations: three words.
    pub const MARK_BYTES: u64 = 12;

    /// Most pairs that a buffer of the device holds.
    #[must_use]
    pub fn most_pairs(limits: &Limits) -> u64 {
        (limits.max_storage_bytes / Self::PAIR_BYTES).min(limits.max_texel_elements)
    }

    /// Most candidates that a buffer of the device holds.
    #[must_use]
    pub fn most_candidates(limits: &Limits) -> u64 {
        let texels = limits.max_texel_elements / Self::CANDIDATE_TEXELS;
        (limits.max_storage_bytes / Self::CANDIDATE_BYTES).min(texels)
    }

    /// Bytes of the largest storage buffer.
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
        [
            attributes, colors, records, candidates, pairs, work, receivers, shadows,
        ]
        .into_iter()
        .fold(0, u64::max)
    }

    /// Pixels of a region.
    #[must_use]
    pub fn pixels(&self) -> u32 {
        self.region[0] * self.region[1]
    }

    /// Colours of a region.
    #[must_use]
    pub fn colors(&self) -> u64 {
        self.locations
            .map_or(u64::from(self.pixels()), |locations| {
                u64::from(locations.locations)
            })
    }

    /// Most places that are shaded at once, where it is asked which lights reach them; otherwise 0.
    #[must_use]
    pub fn receivers(&self) -> u32 {
        let pixels = self.locations.map_or(self.pixels(), |_| 0);
        match self.shadow_words {
            0 => 0,
            _ => pixels.max(self.record_capacity),
        }
    }

    /// Words of all places: of the pixels, where cells are these, and of visibility samples.
    #[must_use]
    pub fn all_shadow_words(&self) -> u64 {
        let pixels = self.locations.map_or(self.pixels(), |_| 0);
        u64::from(self.shadow_words) * (u64::from(pixels) + u64::from(self.record_capacity))
    }

    /// Work items: tiles or, where there are more, groups of locations.
    pub(crate) fn work_items(&self) -> u64 {
        let groups = self.locations.map_or(0, |locations| locations.groups);
        self.tiles().max(groups).into()
    }

    /// Bytes of the work lists: six of them, with as many entries for a work item as its cells may fill.
    pub(crate) fn work_bytes(&self) -> u64 {
        let entries = if self.locations.is_some() {
            1
        } else {
            32 / self.lanes
        };
        self.work_items() * 6 * 4 * u64::from(entries)
    }

    /// Elements of the largest texel buffer.
    #[must_use]
    pub fn largest_texels(&self) -> u64 {
        let [records, pairs, candidates] =
            [self.record_capacity, self.pair_capacity, self.list_capacity].map(u64::from);
        let [locations, cells, places] = self
            .locations
            .map_or([0; 3], |sizes| [sizes.locations, sizes.cells, sizes.places])
            .map(u64::from);
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

    /// Tiles of 8 x 4 pixels of a region.
    #[must_use]
    pub fn tiles(&self) -> u32 {
        self.region[0].div_ceil(8) * self.region[1].div_ceil(4)
    }

    /// Bytes of the buffer of tiles: a vector a tile, and two a stretch of them.
    pub(crate) fn tile_bytes(&self) -> u64 {
        let stretches = self.tiles().div_ceil(STRETCH);
        16 * (u64::from(self.tiles()) + 2 * u64::from(stretches))
    }

    /// Fails where a buffer of these sizes is larger than the device's can be; `what` names the largest.
    ///
    /// # Errors
    /// [`VulkanError::TooLarge`].
    pub(crate) fn check(&self, what: &'static str, limits: &Limits) -> Result<(), VulkanError> {
        let (bytes, texels) = (self.largest_storage(), self.largest_texels());
        VulkanError::check_limit(what, bytes, "bytes", limits.max_storage_bytes)?;
        VulkanError::check_limit(what, texels, "elements", limits.max_texel_elements)
    }

    /// About how many bytes [`super::Resources`] of this size take.
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
            + u64::from(self.filtered) * 16
            + if self.attributes { pixels * 32 } else { 0 }
            + self.all_shadow_words() * 4
            + self.encoded
            + self.locations.map_or(0, |locations| locations.bytes(tiles))
    }
}

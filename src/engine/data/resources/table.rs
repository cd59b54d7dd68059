//! The table of a frame's buffers. Their creation, the limits that they must keep, their descriptors and the bytes that they
//! take follow from it.

use super::ResourceSizes;
use crate::engine::data::{Argument, Counter};
use crate::engine::spirv::{LOAD_WORDS, SPREAD_VECTORS, frame_set};
use crate::vulkan::{Binding, Limits, MemoryUse, VulkanError};
use ash::vk;

/// A buffer of a frame's memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Data {
    /// A word for each [`Counter`].
    Counters,
    /// Colours as detection compares them.
    Display,
    /// Colours of pixels or locations.
    Color,
    /// A word for each tile, a bit for each superpixel.
    Masks,
    /// Marks of tiles, or of groups of locations.
    Marks,
    /// A vector for each tile, and two for each stretch: see `shaders/include/frame.glsl`.
    Tiles,
    /// The work lists, see `shaders/include/work.glsl`.
    TileLists,
    /// Triangles that may touch a cell, or that are thin.
    Survivors,
    /// Corners of triangles that `filter` lists.
    Corners,
    /// Draws that `filter` makes.
    IndexedDraws,
    /// Pairs of a triangle and a tile.
    Pairs,
    /// Lists of candidates.
    Candidates,
    /// First visibility sample of each block.
    Headers,
    /// Visibility samples.
    Fragments,
    /// Radiance of visibility samples.
    Shaded,
    /// Words that say which lights reach a place.
    ShadowWords,
    /// Surfaces that light may reach.
    Surfaces,
    /// Pixels or visibility samples in the order in which they are shaded.
    ShadeOrder,
    /// Counts of the shading keys.
    Bins,
    /// A vector for each [`Argument`].
    Arguments,
    /// Word for conditional rendering: not 0 if another round has work.
    AnotherRound,
    /// Pixels after a filter.
    Filtered,
    /// How the light of superpixels is spread: see `shaders/include/spread.glsl`.
    Spreads,
    /// Weights of a pixel filter, for supersampled pixels.
    FilterWeights,
    /// Attributes of pixels or locations.
    Attributes,
    /// Encoded pixels, and the thresholds before them.
    Encoded,
    /// A list's locations, unless an application lends them.
    Locations,
    /// Indices of the locations that are sampled once each, cell by cell.
    LocationOrder,
    /// Two vectors for each cell.
    LocationCells,
    /// A vector for each group.
    LocationGroups,
    /// For each tile: number of cells, number of samples, and index of the first cell.
    TileLoads,
    /// Words with which `distribute` counts, for each tile: see `shaders/include/tile_locations.glsl`.
    Loads,
}

/// Element of a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Element {
    /// This number of bytes.
    Bytes(u64),
    /// A texel of this format, which has this number of bytes.
    Texel(vk::Format, u64),
}

const WORD: Element = Element::Bytes(4);
const VECTOR: Element = Element::Bytes(16);
const UINT: Element = Element::Texel(vk::Format::R32_UINT, 4);
const UINT2: Element = Element::Texel(vk::Format::R32G32_UINT, 8);
const UINT4: Element = Element::Texel(vk::Format::R32G32B32A32_UINT, 16);
const FLOAT4: Element = Element::Texel(vk::Format::R32G32B32A32_SFLOAT, 16);

/// What the table says of a buffer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// Name in messages and debuggers.
    pub name: &'static str,
    pub element: Element,
    /// Number of elements.
    pub count: u64,
    /// Bindings of the frame's sets: of the texels, and of the buffer as a whole.
    pub bindings: [Option<Binding>; 2],
    /// Use besides that of all buffers.
    pub usage: vk::BufferUsageFlags,
    pub memory: MemoryUse,
}

impl Row {
    fn new(name: &'static str, element: Element, count: impl Into<u64>) -> Self {
        Self {
            name,
            element,
            count: count.into(),
            bindings: [None; 2],
            usage: vk::BufferUsageFlags::empty(),
            memory: MemoryUse::Device,
        }
    }

    fn texels_at(self, binding: Binding) -> Self {
        Self { bindings: [Some(binding), self.bindings[1]], ..self }
    }

    fn at(self, binding: Binding) -> Self {
        Self { bindings: [self.bindings[0], Some(binding)], ..self }
    }

    fn with(self, usage: vk::BufferUsageFlags) -> Self {
        Self { usage, ..self }
    }

    fn within(self, memory: MemoryUse) -> Self {
        Self { memory, ..self }
    }

    /// Number of bytes of the buffer. [`crate::vulkan::Memory::buffer`] makes none smaller than 16.
    pub fn bytes(&self) -> u64 {
        let (Element::Bytes(of_element) | Element::Texel(_, of_element)) = self.element;
        (self.count * of_element).max(16)
    }

    /// Checks that the buffer exceeds no limit of the device.
    pub fn check(&self, limits: &Limits) -> Result<(), VulkanError> {
        if let Element::Texel(..) = self.element {
            VulkanError::check_limit(self.name, self.count, "elements", limits.max_texel_elements)?;
        }
        VulkanError::check_limit(self.name, self.bytes(), "bytes", limits.max_storage_bytes)
    }
}

impl Data {
    /// All buffers, in the order of their declaration.
    pub const ALL: [Self; 32] = [
        Self::Counters,
        Self::Display,
        Self::Color,
        Self::Masks,
        Self::Marks,
        Self::Tiles,
        Self::TileLists,
        Self::Survivors,
        Self::Corners,
        Self::IndexedDraws,
        Self::Pairs,
        Self::Candidates,
        Self::Headers,
        Self::Fragments,
        Self::Shaded,
        Self::ShadowWords,
        Self::Surfaces,
        Self::ShadeOrder,
        Self::Bins,
        Self::Arguments,
        Self::AnotherRound,
        Self::Filtered,
        Self::Spreads,
        Self::FilterWeights,
        Self::Attributes,
        Self::Encoded,
        Self::Locations,
        Self::LocationOrder,
        Self::LocationCells,
        Self::LocationGroups,
        Self::TileLoads,
        Self::Loads,
    ];

    /// The buffer's row of the table, for memory of these sizes.
    pub(super) fn row(self, sizes: &ResourceSizes) -> Row {
        let colors = sizes.colors();
        let fragments = u64::from(sizes.fragment_capacity);
        let list = sizes.locations.unwrap_or_default();
        let tiles = u64::from(sizes.tiles());
        let tiles_of_list = if sizes.locations.is_some() { tiles } else { 0 };
        // The host reads the colours and spreads of its own locations after each run.
        let is_read = sizes.locations.is_some_and(|list| !list.lent);
        let output = if is_read { MemoryUse::Readback } else { MemoryUse::Device };
        let conditional = match sizes.skips_rounds {
            true => vk::BufferUsageFlags::CONDITIONAL_RENDERING_EXT,
            false => vk::BufferUsageFlags::empty(),
        };
        match self {
            Self::Counters => Row::new("counters", WORD, Counter::COUNT as u64).at(frame_set::COUNTERS),
            Self::Display => {
                Row::new("display codes", UINT, colors).texels_at(frame_set::DISPLAY).at(frame_set::DISPLAY_OUT)
            }
            Self::Color => Row::new("colour", FLOAT4, colors)
                .texels_at(frame_set::PIXEL_COLORS)
                .at(frame_set::COLOR)
                .within(output),
            Self::Masks => Row::new("superpixel mask", WORD, tiles).at(frame_set::MASKS),
            Self::Marks => Row::new("marks of pixels", Element::Bytes(12), sizes.work_items()).at(frame_set::MARKS),
            Self::Tiles => Row::new("tiles", VECTOR, sizes.tile_vectors()).at(frame_set::TILES),
            Self::TileLists => Row::new("tile lists", WORD, sizes.work_entries()).at(frame_set::TILE_LISTS),
            Self::Survivors => Row::new("survivors", WORD, sizes.survivor_capacity).at(frame_set::SURVIVORS),
            Self::Corners => Row::new("corners of triangles", Element::Bytes(12), sizes.filtered_triangles)
                .at(frame_set::CORNERS_OUT)
                .with(vk::BufferUsageFlags::INDEX_BUFFER),
            Self::IndexedDraws => {
                let draw = Element::Bytes(size_of::<vk::DrawIndexedIndirectCommand>() as u64);
                Row::new("indirect draws", draw, sizes.indexed_draws())
                    .at(frame_set::INDEXED_DRAWS_OUT)
                    .with(vk::BufferUsageFlags::INDIRECT_BUFFER)
            }
            Self::Pairs => {
                Row::new("pairs", UINT2, sizes.pair_capacity).texels_at(frame_set::PAIRS).at(frame_set::PAIRS_OUT)
            }
            Self::Candidates => {
                let of_candidate = ResourceSizes::CANDIDATE_TEXELS + u64::from(sizes.has_refined);
                let texels = of_candidate * u64::from(sizes.list_capacity);
                Row::new("candidates", UINT4, texels).texels_at(frame_set::CANDIDATES).at(frame_set::CANDIDATES_OUT)
            }
            Self::Headers => Row::new("fragment headers", Element::Bytes(8), fragments).at(frame_set::HEADERS),
            Self::Fragments => Row::new("visibility samples", UINT4, sizes.fragment_vectors())
                .texels_at(frame_set::FRAGMENTS)
                .at(frame_set::FRAGMENTS_OUT),
            Self::Shaded => {
                Row::new("shaded fragments", FLOAT4, fragments).texels_at(frame_set::SHADED).at(frame_set::SHADED_OUT)
            }
            Self::ShadowWords => Row::new("shadows", UINT, sizes.all_shadow_words()).texels_at(frame_set::SHADOW_WORDS),
            Self::Surfaces => Row::new("receivers of light", UINT4, 2 * sizes.receivers()),
            Self::ShadeOrder => Row::new("shading order", WORD, fragments.max(colors)).at(frame_set::SHADE_ORDER),
            Self::Bins => Row::new("material bins", VECTOR, sizes.bins).at(frame_set::BINS),
            Self::Arguments => Row::new("indirect dispatches", VECTOR, Argument::Shade as u32 + sizes.bins)
                .at(frame_set::ARGUMENTS)
                .with(vk::BufferUsageFlags::INDIRECT_BUFFER),
            Self::AnotherRound => Row::new("another round", WORD, 1_u64).with(conditional),
            Self::Filtered => Row::new("filtered colour", FLOAT4, sizes.filtered)
                .texels_at(frame_set::FILTERED)
                .with(vk::BufferUsageFlags::STORAGE_TEXEL_BUFFER),
            Self::Spreads => {
                let pixels = if sizes.spreads { colors } else { 0 };
                Row::new("spread of superpixels", UINT4, u64::from(SPREAD_VECTORS) * pixels)
                    .texels_at(frame_set::SPREADS)
                    .at(frame_set::SPREADS_OUT)
                    .within(output)
            }
            Self::FilterWeights => {
                Row::new("weights of a pixel filter", WORD, sizes.filter_weights).at(frame_set::FILTER_WEIGHTS)
            }
            Self::Attributes => {
                let count = if sizes.attributes { colors } else { 0 };
                Row::new("attributes", Element::Bytes(32), count).at(frame_set::ATTRIBUTES_OUT).within(output)
            }
            Self::Encoded => Row::new("encoded colour", Element::Bytes(1), sizes.encoded).at(frame_set::ENCODED),
            // An application shows the locations that it lends.
            Self::Locations if list.lent => Row::new("locations", UINT4, 0_u64),
            Self::Locations => Row::new("locations", UINT4, 2 * u64::from(list.locations))
                .texels_at(frame_set::LOCATIONS)
                .within(MemoryUse::Upload),
            Self::LocationOrder => {
                Row::new("order of locations", UINT, list.places).texels_at(frame_set::LOCATION_ORDER)
            }
            Self::LocationCells => {
                Row::new("cells of locations", UINT4, 2 * u64::from(list.cells)).texels_at(frame_set::LOCATION_CELLS)
            }
            Self::LocationGroups => {
                Row::new("groups of cells", UINT4, list.groups).texels_at(frame_set::LOCATION_GROUPS)
            }
            Self::TileLoads => Row::new("cells and samples of tiles", VECTOR, tiles_of_list).at(frame_set::TILE_LOADS),
            Self::Loads => Row::new("loads of tiles", WORD, u64::from(LOAD_WORDS) * tiles_of_list),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_of_all_has_the_order_of_the_declaration() {
        for (index, data) in Data::ALL.into_iter().enumerate() {
            assert_eq!(data as usize, index);
        }
        assert_eq!(Data::Loads as usize + 1, Data::ALL.len());
    }
}

//! Lists of sampling locations on the device; they are sampled instead of pixels.

use super::Resources;
use crate::engine::spirv::{LOAD_WORDS, distribute_set};
use crate::vulkan::{BoundDescriptor, Buffer, Memory, MemoryUse, TexelBuffer, Texels, VulkanError};
use ash::vk;

/// Kind of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    /// A pixel that the mask marks, with its samples.
    Pixels,
    /// A location, with samples around it that its Jacobian places.
    Superpixels,
    /// Several locations of a tile, each sampled once.
    Points,
}

impl Cells {
    /// Whether locations are sampled once each.
    #[must_use]
    pub fn are_points(self) -> bool {
        self == Self::Points
    }

    /// Whether cells consist of sampling locations.
    pub(crate) fn are_locations(self) -> bool {
        self != Self::Pixels
    }
}

/// Largest numbers of locations, cells and groups of cells in a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LocationSizes {
    /// Number of locations.
    pub locations: u32,
    /// Number of cells.
    pub cells: u32,
    /// Number of places in the order of locations: each cell has places for its largest number of locations.
    pub places: u32,
    /// Number of groups of cells; a team samples one.
    pub groups: u32,
    /// Whether an application lends the list and takes the colours on the device.
    pub lent: bool,
}

impl LocationSizes {
    /// Sizes for `locations` locations in a region of `tiles` tiles.
    #[must_use]
    pub fn new(locations: u32, tiles: u32, cells: &CellSizes) -> Self {
        let cell_count = cells.most_cells(locations, tiles);
        Self {
            locations,
            cells: cell_count,
            places: cell_count.saturating_mul(cells.in_cell),
            groups: most_parts(cell_count, cells.in_group, tiles),
            lent: false,
        }
    }

    /// Number of bytes of the buffers that locations need in addition to those of pixels, over `tiles` tiles.
    #[must_use]
    pub fn bytes(&self, tiles: u64) -> u64 {
        let [locations, cells, places, groups] = [self.locations, self.cells, self.places, self.groups].map(u64::from);
        let listed = if self.lent { 0 } else { locations };
        32 * (listed + cells) + 4 * places + 16 * groups + (16 + 4 * LocationBuffers::LOAD) * tiles
    }
}

/// A sampling location, laid out as in `shaders/include/locations.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct ListedLocation {
    /// Column and row of the pixel that contains the location, on the plane.
    pub pixel: [i32; 2],
    /// Position in that pixel, x and y from 0 to 1.
    pub within: [f32; 2],
    /// Columns of its Jacobian: changes of x and y per column and per row of the output.
    pub jacobian: [[f32; 2]; 2],
}

/// Numbers of locations in a cell, and of cells in a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellSizes {
    /// Largest number of locations of a cell.
    pub in_cell: u32,
    /// Largest number of cells of a group.
    pub in_group: u32,
    /// Number of samples of a cell that consists of one location.
    pub samples: u32,
}

impl CellSizes {
    /// Smallest value of [`Self::in_cell`] for locations that are sampled once each; rounded up to a multiple of the
    /// number of members of a team.
    const POINTS_IN_CELL: u32 = 16;

    /// Sizes for teams of `members` invocations.
    #[must_use]
    pub fn new(members: u32, cells: Cells, samples: u32) -> Self {
        let in_cell = match cells {
            Cells::Points => Self::POINTS_IN_CELL.next_multiple_of(members),
            Cells::Superpixels | Cells::Pixels => 1,
        };
        Self { in_cell, in_group: members, samples }
    }

    /// Largest number of cells that `locations` locations make in a region of `tiles` tiles.
    pub(crate) fn most_cells(&self, locations: u32, tiles: u32) -> u32 {
        most_parts(locations, self.in_cell, tiles)
    }
}

/// Largest number of groups that `count` items form, if a group holds at most `size` items of a single tile.
fn most_parts(count: u32, size: u32, tiles: u32) -> u32 {
    count.min((count / size).saturating_add(tiles))
}

/// Buffers of a list: see `shaders/include/locations.glsl`.
pub struct LocationBuffers {
    /// The list; `None` if an application lends it.
    pub locations: Option<TexelBuffer>,
    /// Indices of the locations that are sampled once each, cell by cell.
    pub order: TexelBuffer,
    /// Two vectors for each cell.
    pub cells: TexelBuffer,
    /// A vector for each group.
    pub groups: TexelBuffer,
    /// For each tile: number of cells, number of samples, and index of the first cell.
    pub tile_loads: Buffer,
    /// Words with which `distribute` counts, for each tile: see `shaders/include/tile_locations.glsl`.
    pub(crate) loads: Buffer,
}

impl LocationBuffers {
    /// Number of words of a tile in `loads`: see `shaders/include/tile_locations.glsl`.
    const LOAD: u64 = LOAD_WORDS as u64;

    pub(crate) fn new(memory: &Memory, sizes: &LocationSizes, tiles: u64) -> Result<Self, VulkanError> {
        let storage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_SRC;
        let texels = |name, count: u32, format, place| {
            let usage = vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER | storage;
            memory.texel_buffer(name, count.into(), format, usage, place)
        };
        let uint4 = vk::Format::R32G32B32A32_UINT;
        let vectors = |name, count| texels(name, count, uint4, MemoryUse::Device);
        let listed = || texels("locations", 2 * sizes.locations, uint4, MemoryUse::Upload);
        let tiles = if sizes.locations == 0 { 0 } else { tiles };
        let words = |name, count: u64| {
            let usage = storage | vk::BufferUsageFlags::TRANSFER_DST;
            memory.buffer(name, 4 * count, usage, MemoryUse::Device)
        };
        Ok(Self {
            locations: (!sizes.lent).then(listed).transpose()?,
            order: texels("order of locations", sizes.places, vk::Format::R32_UINT, MemoryUse::Device)?,
            cells: vectors("cells of locations", 2 * sizes.cells)?,
            groups: vectors("groups of cells", sizes.groups)?,
            tile_loads: words("cells and samples of tiles", 4 * tiles)?,
            loads: words("loads of tiles", Self::LOAD * tiles)?,
        })
    }
}

impl Resources {
    /// First `count` locations of the list, to be written while the device is idle.
    ///
    /// # Errors
    /// If there is no room for them, or the driver did not map the buffer.
    pub fn listed_mut(&mut self, count: usize) -> Result<&mut [ListedLocation], VulkanError> {
        let bytes = count * size_of::<ListedLocation>();
        let scratch = self.own_scratch().ok_or(UNMAPPED)?;
        let listed = scratch.locations.locations.as_mut().ok_or(UNMAPPED)?;
        Ok(bytemuck::cast_slice_mut(mapped(&mut listed.buffer, bytes)?))
    }

    /// View of the whole list.
    ///
    /// # Errors
    /// If an application lends the list.
    pub fn listed(&self) -> Result<Texels, VulkanError> {
        let listed = self.locations.locations.as_ref().ok_or(UNMAPPED)?;
        Ok(listed.texels())
    }

    /// Buffers that `distribute` reads and writes.
    pub(crate) fn location_buffers(&self, locations: Texels) -> [BoundDescriptor; 10] {
        let LocationBuffers { order, cells, groups, tile_loads, loads, .. } = &self.locations;
        [
            (distribute_set::LOADS, loads.into()),
            // The buffer is free, because nothing has been shaded yet.
            (distribute_set::RANKS, (&self.shade_order).into()),
            (distribute_set::ORDER_OUT, (&order.buffer).into()),
            (distribute_set::CELLS_OUT, (&cells.buffer).into()),
            (distribute_set::GROUPS_OUT, (&groups.buffer).into()),
            (distribute_set::TILE_LOADS, tile_loads.into()),
            (distribute_set::MASKS, (&self.masks).into()),
            (distribute_set::COUNTERS, (&self.counters).into()),
            (distribute_set::LOCATIONS, locations.into()),
            (distribute_set::ORDER, order.texels().into()),
        ]
    }
}

const UNMAPPED: VulkanError =
    VulkanError::Call { call: "mapping locations", result: vk::Result::ERROR_MEMORY_MAP_FAILED };

fn mapped(buffer: &mut Buffer, bytes: usize) -> Result<&mut [u8], VulkanError> {
    buffer.bytes_mut().get_mut(..bytes).ok_or(UNMAPPED)
}

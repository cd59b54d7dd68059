//! Lists of sampling locations on the device; they are sampled instead of pixels.

use super::{Data, Resources};
use crate::engine::spirv::distribute_set;
use crate::vulkan::{BoundDescriptor, Descriptor, VulkanError};
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

impl Resources {
    /// First `count` locations of the list, to be written while the device is idle.
    ///
    /// # Errors
    /// If there is no room for them, or the driver did not map the buffer.
    pub fn listed_mut(&mut self, count: usize) -> Result<&mut [ListedLocation], VulkanError> {
        let bytes = count * size_of::<ListedLocation>();
        let listed = self.buffer_mut(Data::Locations).ok_or(UNMAPPED)?;
        let listed = listed.bytes_mut().get_mut(..bytes).ok_or(UNMAPPED)?;
        Ok(bytemuck::cast_slice_mut(listed))
    }

    /// Buffers that `distribute` reads and writes.
    pub(crate) fn location_buffers(&self, locations: Descriptor) -> [BoundDescriptor; 10] {
        let whole = |data| self.buffer(data).into();
        [
            (distribute_set::LOADS, whole(Data::Loads)),
            // The buffer is free, because nothing has been shaded yet.
            (distribute_set::RANKS, whole(Data::ShadeOrder)),
            (distribute_set::ORDER_OUT, whole(Data::LocationOrder)),
            (distribute_set::CELLS_OUT, whole(Data::LocationCells)),
            (distribute_set::GROUPS_OUT, whole(Data::LocationGroups)),
            (distribute_set::TILE_LOADS, whole(Data::TileLoads)),
            (distribute_set::MASKS, whole(Data::Masks)),
            (distribute_set::COUNTERS, whole(Data::Counters)),
            (distribute_set::LOCATIONS, locations),
            (distribute_set::ORDER, self.texels(Data::LocationOrder)),
        ]
    }
}

const UNMAPPED: VulkanError =
    VulkanError::Call { call: "mapping locations", result: vk::Result::ERROR_MEMORY_MAP_FAILED };

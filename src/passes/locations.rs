//! Sample locations of the caller's own on the device, in the place of pixels.

use super::Resources;
use crate::vulkan::{Buffer, BufferView, Constants, Memory, MemoryUse, VulkanError};
use ash::vk;

/// What a cell is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    /// A pixel of the mask, with sub-samples.
    Pixels,
    /// A location, with sub-samples that its Jacobian places.
    Superpixels,
    /// A few locations of a tile, each sampled once, where it is.
    Points,
    /// The same, for surfaces that a light's pinhole sees: which triangle lies before theirs.
    Occluders,
}

impl Cells {
    /// Whether its locations are sampled once each.
    #[must_use]
    pub fn are_points(self) -> bool {
        matches!(self, Self::Points | Self::Occluders)
    }

    /// Adds the constants of `shaders/include/locations.glsl`.
    pub(crate) fn constants(self, constants: Constants) -> Constants {
        constants
            .flag(20, self != Self::Pixels)
            .flag(21, self.are_points())
            .flag(22, self == Self::Occluders)
    }
}

/// How many locations, cells and groups of cells a run has at the most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LocationSizes {
    /// Locations.
    pub locations: u32,
    /// Cells.
    pub cells: u32,
    /// Groups of cells that a subgroup takes.
    pub groups: u32,
}

impl LocationSizes {
    /// Bytes of the buffers that locations need beside those of pixels, over `tiles` tiles.
    #[must_use]
    pub fn bytes(&self, tiles: u64) -> u64 {
        let [locations, cells, groups] = [self.locations, self.cells, self.groups].map(u64::from);
        32 * (locations + cells) + 16 * groups + 8 * tiles
    }
}

/// One run's locations, as `shaders/include/locations.glsl` lays them out, and the tiles that they lie in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LocationData {
    /// Two vectors a location.
    pub locations: Vec<[[u32; 4]; 2]>,
    /// Two vectors a cell.
    pub cells: Vec<[[u32; 4]; 2]>,
    /// Tile, first cell, cells, number of the first cell within the tile.
    pub groups: Vec<[u32; 4]>,
    /// A bit for each pixel of a tile of 8 x 4 that holds a location.
    pub masks: Vec<u32>,
    /// Cells and samples of each tile.
    pub loads: Vec<[u32; 2]>,
}

/// A visibility sample of locations, see `shaders/sample.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub struct VisibilitySample([u32; 4]);

impl VisibilitySample {
    /// Its location's place in the run.
    pub(crate) fn location(self) -> usize {
        (self.0[0] & 0x7fff_ffff) as usize
    }

    /// ID of its triangle; 0 where there is none.
    pub(crate) fn id(self) -> u32 {
        self.0[1]
    }

    /// Where it is shaded, from the middle of its cell in sides of that: `place_location` of `shaders/include/place.glsl`.
    pub(crate) fn offset(self) -> [f64; 2] {
        [20, 8].map(|shift| f64::from((self.0[2] << shift) as i32 >> 20) / 4096.0)
    }
}

/// The buffers; the host writes them before each run.
pub(crate) struct LocationBuffers {
    pub locations: BufferView,
    pub cells: BufferView,
    pub groups: BufferView,
    pub loads: Buffer,
}

impl LocationBuffers {
    pub fn new(memory: &Memory, sizes: &LocationSizes, tiles: u64) -> Result<Self, VulkanError> {
        let vectors = |name, count: u32| {
            memory.texel_buffer(
                name,
                count.into(),
                vk::Format::R32G32B32A32_UINT,
                vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER,
                MemoryUse::Upload,
            )
        };
        let tiles = if sizes.locations == 0 { 0 } else { tiles };
        Ok(Self {
            locations: vectors("locations", 2 * sizes.locations)?,
            cells: vectors("cells of locations", 2 * sizes.cells)?,
            groups: vectors("groups of cells", sizes.groups)?,
            loads: memory.buffer(
                "loads of tiles",
                tiles * 8,
                vk::BufferUsageFlags::STORAGE_BUFFER,
                MemoryUse::Upload,
            )?,
        })
    }
}

impl Resources {
    /// Writes a word for each record of the round: a bit for each light that it lies in the shadow of.
    ///
    /// # Errors
    /// If they do not fit, or the driver did not map the buffer.
    pub(crate) fn write_shadows(&mut self, words: &[u32]) -> Result<(), VulkanError> {
        put(&mut self.record_shadows.buffer, bytemuck::cast_slice(words))
    }

    /// Writes a run's locations, which [`LocationSizes`] must have room for, while the device is idle.
    ///
    /// # Errors
    /// If they do not fit, or the driver did not map the buffers.
    pub(crate) fn write_locations(&mut self, data: &LocationData) -> Result<(), VulkanError> {
        put(
            &mut self.locations.locations.buffer,
            bytemuck::cast_slice(&data.locations),
        )?;
        put(
            &mut self.locations.cells.buffer,
            bytemuck::cast_slice(&data.cells),
        )?;
        put(
            &mut self.locations.groups.buffer,
            bytemuck::cast_slice(&data.groups),
        )?;
        put(&mut self.locations.loads, bytemuck::cast_slice(&data.loads))?;
        put(&mut self.masks, bytemuck::cast_slice(&data.masks))
    }
}

fn put(buffer: &mut Buffer, bytes: &[u8]) -> Result<(), VulkanError> {
    let place = buffer.bytes_mut().get_mut(..bytes.len());
    let place = place.ok_or(VulkanError::Call {
        call: "mapping locations",
        result: vk::Result::ERROR_MEMORY_MAP_FAILED,
    })?;
    place.copy_from_slice(bytes);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_say_which_location_sees_what_where() {
        // As `pack_place` of `shaders/include/place.glsl` packs (-1 / 4096, 2047 / 4096), wide and with a share.
        let place = 1 << 31 | 9 << 24 | 2047 << 12 | 0xfff;
        let record = VisibilitySample([0x8000_0007, 5, place, 0]);
        assert_eq!((record.location(), record.id()), (7, 5));
        assert_eq!(record.offset(), [-1.0 / 4096.0, 2047.0 / 4096.0]);
    }
}

//! Sites on the device: sampling locations of the caller's own, in the place of pixels.

use super::Resources;
use crate::vulkan::{Buffer, BufferView, Constants, Memory, MemoryUse, VulkanError};
use ash::vk;

/// What a cell is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    /// A pixel of the mask, with sub-samples.
    Pixels,
    /// A site, with sub-samples that its Jacobian places.
    Superpixels,
    /// A few sites of a tile, each sampled once, where it is.
    Points,
    /// The same, for surfaces that a light's pinhole sees: which triangle lies before theirs.
    Occluders,
}

impl Cells {
    /// Whether its sites are sampled once each.
    #[must_use]
    pub fn are_points(self) -> bool {
        matches!(self, Self::Points | Self::Occluders)
    }

    /// Adds the constants of `shaders/include/sites.glsl`.
    pub(crate) fn constants(self, constants: Constants) -> Constants {
        constants
            .flag(20, self != Self::Pixels)
            .flag(21, self.are_points())
            .flag(22, self == Self::Occluders)
    }
}

/// How many sites, cells and groups of cells a run has at the most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SiteSizes {
    /// Sites.
    pub sites: u32,
    /// Cells.
    pub cells: u32,
    /// Groups of cells that a subgroup takes.
    pub groups: u32,
}

impl SiteSizes {
    /// Bytes of the buffers that sites need beside those of pixels, over `tiles` tiles.
    #[must_use]
    pub fn bytes(&self, tiles: u64) -> u64 {
        let [sites, cells, groups] = [self.sites, self.cells, self.groups].map(u64::from);
        32 * (sites + cells) + 16 * groups + 8 * tiles
    }
}

/// One run's sites, as `shaders/include/sites.glsl` lays them out, and the tiles that they lie in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SiteData {
    /// Two vectors a site.
    pub sites: Vec<[[u32; 4]; 2]>,
    /// Two vectors a cell.
    pub cells: Vec<[[u32; 4]; 2]>,
    /// Tile, first cell, cells, number of the first cell within the tile.
    pub groups: Vec<[u32; 4]>,
    /// A bit for each pixel of a tile of 8 x 4 that holds a site.
    pub masks: Vec<u32>,
    /// Cells and samples of each tile.
    pub loads: Vec<[u32; 2]>,
}

/// A visibility record of sites, see `shaders/sample.comp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub struct SiteRecord([u32; 4]);

impl SiteRecord {
    /// Its site's place in the run.
    pub(crate) fn site(self) -> usize {
        (self.0[0] & 0x7fff_ffff) as usize
    }

    /// ID of its triangle; 0 where there is none.
    pub(crate) fn id(self) -> u32 {
        self.0[1]
    }

    /// Where it is shaded, from the middle of its cell in sides of that: `place_location` of `shaders/include/place.glsl`.
    pub(crate) fn location(self) -> [f64; 2] {
        [20, 8].map(|shift| f64::from((self.0[2] << shift) as i32 >> 20) / 4096.0)
    }
}

/// The buffers; the host writes them before each run.
pub(crate) struct SiteBuffers {
    pub sites: BufferView,
    pub cells: BufferView,
    pub groups: BufferView,
    pub loads: Buffer,
}

impl SiteBuffers {
    pub fn new(memory: &Memory, sizes: &SiteSizes, tiles: u64) -> Result<Self, VulkanError> {
        let vectors = |name, count: u32| {
            memory.texel_buffer(
                name,
                count.into(),
                vk::Format::R32G32B32A32_UINT,
                vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER,
                MemoryUse::Upload,
            )
        };
        let tiles = if sizes.sites == 0 { 0 } else { tiles };
        Ok(Self {
            sites: vectors("sites", 2 * sizes.sites)?,
            cells: vectors("cells of sites", 2 * sizes.cells)?,
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

    /// Writes a run's sites, which [`SiteSizes`] must have room for, while the device is idle.
    ///
    /// # Errors
    /// If they do not fit, or the driver did not map the buffers.
    pub(crate) fn write_sites(&mut self, data: &SiteData) -> Result<(), VulkanError> {
        put(
            &mut self.sites.sites.buffer,
            bytemuck::cast_slice(&data.sites),
        )?;
        put(
            &mut self.sites.cells.buffer,
            bytemuck::cast_slice(&data.cells),
        )?;
        put(
            &mut self.sites.groups.buffer,
            bytemuck::cast_slice(&data.groups),
        )?;
        put(&mut self.sites.loads, bytemuck::cast_slice(&data.loads))?;
        put(&mut self.masks, bytemuck::cast_slice(&data.masks))
    }
}

fn put(buffer: &mut Buffer, bytes: &[u8]) -> Result<(), VulkanError> {
    let place = buffer.bytes_mut().get_mut(..bytes.len());
    let place = place.ok_or(VulkanError::Call {
        call: "mapping sites",
        result: vk::Result::ERROR_MEMORY_MAP_FAILED,
    })?;
    place.copy_from_slice(bytes);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_say_which_site_sees_what_where() {
        // As `pack_place` of `shaders/include/place.glsl` packs (-1 / 4096, 2047 / 4096), wide and with a share.
        let place = 1 << 31 | 9 << 24 | 2047 << 12 | 0xfff;
        let record = SiteRecord([0x8000_0007, 5, place, 0]);
        assert_eq!((record.site(), record.id()), (7, 5));
        assert_eq!(record.location(), [-1.0 / 4096.0, 2047.0 / 4096.0]);
    }
}

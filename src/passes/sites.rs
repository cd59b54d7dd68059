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
    /// Writes a run's sites, which [`SiteSizes`] must have room for, while the device is idle.
    ///
    /// # Errors
    /// If they do not fit, or the driver did not map the buffers.
    pub(crate) fn write_sites(&mut self, data: &SiteData) -> Result<(), VulkanError> {
        let unmapped = || VulkanError::Call {
            call: "mapping sites",
            result: vk::Result::ERROR_MEMORY_MAP_FAILED,
        };
        let put = |buffer: &mut Buffer, bytes: &[u8]| {
            let place = buffer.bytes_mut().get_mut(..bytes.len());
            place.ok_or_else(unmapped)?.copy_from_slice(bytes);
            Ok(())
        };
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

//! Alpha maps that a host lends.

use super::geometry::Geometry;
use super::{HostError, Member};
use crate::engine::data::alpha_flags::{
    CLAMP_TO_EDGE, MIRRORED_REPEAT, NEAREST_MAG, NEAREST_MIN, NEAREST_MIP, NO_MIP, REPEAT, TEXTURED, beyond,
};
use crate::engine::passes::alpha_map::{self, AlphaLevel};
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv;
use crate::vulkan::{DescriptorSets, Memory, MemoryUse, Recorder, Specialized, TexelBuffer, VulkanError};
use ash::vk;

/// Alpha map of draws. A surface exists where the map's alpha is at least `cutoff`. Filters and address modes should
/// equal those of the sampler with which the host's own pass reads the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlphaMap {
    /// Two-dimensional view of an image that was created with `SAMPLED` and holds floats or normalised numbers. The
    /// fourth component of the view is alpha; the view's swizzle can take alpha from any channel of the image.
    pub view: vk::ImageView,
    /// Width and height in texels, up to 65,535.
    pub size: [u32; 2],
    /// Number of mipmap levels, at least 1.
    pub levels: u32,
    /// Filter where texels are larger than pixels: `LINEAR` or `NEAREST`.
    pub mag_filter: vk::Filter,
    /// Filter where texels are smaller than pixels: `LINEAR` or `NEAREST`.
    pub min_filter: vk::Filter,
    /// Filter between mipmap levels: `LINEAR` blends two levels, `NEAREST` reads the nearest level.
    pub mipmap_mode: vk::SamplerMipmapMode,
    /// Address modes along u and v, for coordinates outside of the image: `REPEAT`, `MIRRORED_REPEAT` or
    /// `CLAMP_TO_EDGE`.
    pub address: [vk::SamplerAddressMode; 2],
    /// Smallest alpha at which the surface exists.
    pub cutoff: f32,
}

/// Number of vectors of an alpha map's row in the table that `shaders/include/material.glsl` describes, as far as the
/// alpha test reads the row.
pub(super) const ROW: usize = UV_ROWS + 2;
const BASE_COLOR: usize = spirv::MATERIAL_BASE_COLOR as usize;
const FACTORS: usize = spirv::MATERIAL_FACTORS as usize;
const ALPHA: usize = spirv::MATERIAL_ALPHA as usize;
const UV_ROWS: usize = spirv::MATERIAL_UV_ROWS as usize;
/// Largest number of alpha maps: a triangle has 16 bits for the index of its map.
pub(super) const MOST_MAPS: u32 = 1 << 16;
/// Largest width and height of an alpha map: the table has 16 bits for each.
const LONGEST: u32 = u16::MAX as u32;

impl AlphaMap {
    pub(super) fn check(&self) -> Result<(), HostError> {
        if self.view == vk::ImageView::null() {
            return Err(HostError::Null(Member::AlphaView));
        }
        let [width, height] = self.size;
        let most_levels = width.max(height).max(1).ilog2() + 1;
        HostError::check_count(Member::AlphaWidth, width, LONGEST)?;
        HostError::check_count(Member::AlphaHeight, height, LONGEST)?;
        HostError::check_count(Member::AlphaLevels, self.levels, most_levels)?;
        let unknown = self.address.into_iter().find(|mode| wrap(*mode).is_none());
        if let Some(found) = unknown {
            let possible = "REPEAT (0), MIRRORED_REPEAT (1) or CLAMP_TO_EDGE (2)";
            return Err(HostError::Choice { member: Member::Address, found: found.as_raw(), possible });
        }
        for (member, filter) in [
            (Member::MagFilter, self.mag_filter),
            (Member::MinFilter, self.min_filter),
            (Member::MipmapMode, vk::Filter::from_raw(self.mipmap_mode.as_raw())),
        ] {
            if !matches!(filter, vk::Filter::LINEAR | vk::Filter::NEAREST) {
                let possible = "NEAREST (0) or LINEAR (1)";
                return Err(HostError::Choice { member, found: filter.as_raw(), possible });
            }
        }
        if self.cutoff.is_finite() { Ok(()) } else { Err(HostError::NotFinite(Member::Cutoff)) }
    }

    fn modes(&self) -> [u32; 2] {
        self.address.map(|mode| wrap(mode).unwrap_or_default())
    }

    fn flags(&self) -> u32 {
        let optional = [
            (NEAREST_MAG, self.mag_filter == vk::Filter::NEAREST),
            (NEAREST_MIN, self.min_filter == vk::Filter::NEAREST),
            (NEAREST_MIP, self.mipmap_mode == vk::SamplerMipmapMode::NEAREST),
            (NO_MIP, self.levels == 1),
        ];
        let set = optional.into_iter().filter(|(_, set)| *set);
        set.fold(TEXTURED | beyond(self.modes()), |all, (flag, _)| all | flag)
    }

    /// Row of the map in the table of materials. `table` is the index at which the map's levels are listed in the
    /// atlas.
    fn row(&self, table: u32) -> [[u32; 4]; ROW] {
        let [width, height] = self.size;
        let mut row = [[0; 4]; ROW];
        row[BASE_COLOR] = [1.0_f32.to_bits(); 4];
        row[FACTORS][3] = self.cutoff.to_bits();
        row[ALPHA] = [table, width | height << 16, self.levels, self.flags()];
        row[UV_ROWS][0] = 1.0_f32.to_bits();
        row[UV_ROWS + 1][1] = 1.0_f32.to_bits();
        row
    }

    fn level(&self, level: u32, first: u32) -> AlphaLevel {
        let [u, v] = self.modes();
        AlphaLevel {
            size: self.size.map(|side| (side >> level).max(1)),
            level,
            first,
            repeats: u32::from(u == REPEAT) | u32::from(v == REPEAT) << 1,
        }
    }
}

fn wrap(mode: vk::SamplerAddressMode) -> Option<u32> {
    match mode {
        vk::SamplerAddressMode::REPEAT => Some(REPEAT),
        vk::SamplerAddressMode::MIRRORED_REPEAT => Some(MIRRORED_REPEAT),
        vk::SamplerAddressMode::CLAMP_TO_EDGE => Some(CLAMP_TO_EDGE),
        _ => None,
    }
}

/// Layout of the alpha maps in the atlas.
#[derive(Default)]
struct Places {
    /// Tables of levels, at the beginning of the atlas: the first word of each level.
    tables: Vec<u32>,
    /// Rows of all maps, one after the other.
    rows: Vec<[u32; 4]>,
    /// Levels of each map.
    levels: Vec<Vec<AlphaLevel>>,
    words: u64,
}

impl Places {
    fn new(maps: &[AlphaMap]) -> Self {
        let mut places = Self { words: maps.iter().map(|map| u64::from(map.levels)).sum(), ..Self::default() };
        for map in maps {
            let table = places.tables.len() as u32;
            places.rows.extend(map.row(table));
            let mut levels = Vec::new();
            for number in 0..map.levels {
                // An atlas that is too large, whose offsets may wrap here, is refused before it is used.
                let level = map.level(number, places.words as u32);
                places.tables.push(level.first);
                places.words += level.words();
                levels.push(level);
            }
            places.levels.push(levels);
        }
        places
    }
}

/// Alpha maps on the device, and the pass that reads the host's images into the atlas, once.
pub(super) struct Alpha {
    pub atlas: TexelBuffer,
    pub rows: TexelBuffer,
    /// Texture coordinates of each position in clip space.
    pub coordinates: TexelBuffer,
    places: Places,
    kernel: Kernel<spirv::AlphaMap>,
    /// Descriptor set of each map.
    sets: Vec<DescriptorSets>,
}

impl Alpha {
    /// # Safety
    /// The views of the alpha maps outlive the returned value.
    pub unsafe fn new(layout: &FrameLayout, memory: &Memory, geometry: &Geometry) -> Result<Self, VulkanError> {
        let places = Places::new(&geometry.alpha_maps);
        let usage = vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER
            | vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::TRANSFER_DST;
        let texels = |name, elements, format| memory.texel_buffer(name, elements, format, usage, MemoryUse::Device);
        let limit = memory.gpu().limits().max_storage_bytes;
        VulkanError::check_limit("alpha maps", 4 * places.words, "bytes", limit)?;
        let atlas = texels("alpha maps", places.words, vk::Format::R32_UINT)?;
        let set = |map: &AlphaMap| {
            // SAFETY: passed on to the caller.
            unsafe { alpha_map::set(layout, map.view, &atlas.buffer) }
        };
        Ok(Self {
            rows: texels("rows of alpha maps", places.rows.len() as u64, vk::Format::R32G32B32A32_UINT)?,
            coordinates: texels("texture coordinates", geometry.all_positions(), vk::Format::R32G32_SFLOAT)?,
            kernel: alpha_map::kernel(layout)?,
            sets: geometry.alpha_maps.iter().map(set).collect::<Result<_, _>>()?,
            atlas,
            places,
        })
    }

    /// Records the pass.
    pub fn record(&self, recorder: &Recorder<'_>) {
        recorder.update(&self.rows.buffer, 0, bytemuck::cast_slice(&self.places.rows));
        recorder.update(&self.atlas.buffer, 0, bytemuck::cast_slice(&self.places.tables));
        recorder.pass(spirv::AlphaMap::INTERFACE, || {
            recorder.unordered(|| {
                for (set, levels) in self.sets.iter().zip(&self.places.levels) {
                    for level in levels {
                        recorder.show(set);
                        self.kernel.record(recorder, level, level.words());
                    }
                }
            });
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ash::vk::Handle;

    fn map(size: [u32; 2], levels: u32) -> AlphaMap {
        AlphaMap {
            view: vk::ImageView::from_raw(1),
            size,
            levels,
            mag_filter: vk::Filter::LINEAR,
            min_filter: vk::Filter::LINEAR,
            mipmap_mode: vk::SamplerMipmapMode::LINEAR,
            address: [vk::SamplerAddressMode::REPEAT, vk::SamplerAddressMode::CLAMP_TO_EDGE],
            cutoff: 0.5,
        }
    }

    #[test]
    fn maps_follow_their_tables() {
        let places = Places::new(&[map([4, 2], 3), map([1, 1], 1)]);
        // Words of the levels: 5 x 3, 3 x 2 and 2 x 2 for the first map; 2 x 2 for the second.
        assert_eq!(places.tables, [4, 19, 25, 29]);
        assert_eq!(places.words, 33);
        assert_eq!(places.rows.len(), 2 * ROW);
        assert_eq!(places.rows[ALPHA], [0, 4 | 2 << 16, 3, 1 | 2 << 10]);
        assert_eq!(places.rows[ROW + ALPHA], [3, 1 | 1 << 16, 1, 9 | 2 << 10]);
        assert_eq!(places.levels[0][1].size, [2, 1]);
        assert_eq!(places.levels[0][1].repeats, 1);
    }

    #[test]
    fn maps_that_can_not_be_read_are_named() {
        let refused = |map: AlphaMap| map.check().unwrap_err().to_string();
        assert!(map([4, 4], 3).check().is_ok());
        assert_eq!(refused(map([0, 4], 1)), "AlphaMap::size[0] is 0; it can be 1 to 65535");
        assert_eq!(refused(map([4, 4], 4)), "AlphaMap::levels is 4; it can be 1 to 3");
        let border = AlphaMap { address: [vk::SamplerAddressMode::CLAMP_TO_BORDER; 2], ..map([4, 4], 1) };
        assert!(refused(border).starts_with("AlphaMap::address is 3; it can be REPEAT (0)"));
        let cubic = AlphaMap { min_filter: vk::Filter::CUBIC_EXT, ..map([4, 4], 1) };
        assert_eq!(refused(cubic), "AlphaMap::min_filter is 1000015000; it can be NEAREST (0) or LINEAR (1)");
        let broken = AlphaMap { cutoff: f32::NAN, ..map([4, 4], 1) };
        assert_eq!(refused(broken), "AlphaMap::cutoff has a number that is not finite");
    }
}

//! Triangles that a host lends.

use super::HostError;
use crate::passes::{AdoptedDraw, Content};
use crate::vulkan::{
    Buffer, BufferView, Constants, Gpu, Memory, MemoryUse, TexelView, VulkanError,
};
use ash::vk;
use std::sync::Arc;

/// How the host's clip space lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ClipSpace {
    /// Whether y points up, as with a viewport of negative height; otherwise down, as Vulkan has it.
    pub y_up: bool,
    /// Whether depth runs from 1 near to 0 far; otherwise from 0 to 1.
    pub reversed_depth: bool,
}

/// Buffers of a host. They may hold something else in every frame; the engine reads them when a recording is executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Geometry {
    /// Positions in clip space, four floats each, tightly packed: the very values that the host's vertex shader outputs.
    /// Made with `STORAGE_BUFFER` and `UNIFORM_TEXEL_BUFFER`.
    pub positions: vk::Buffer,
    /// Where they begin, in bytes.
    pub positions_offset: u64,
    /// How many there can be. Larger indices are taken for the last.
    pub vertex_capacity: u32,
    /// Indices of 32 bits, three a triangle. Made with `STORAGE_BUFFER`.
    pub indices: vk::Buffer,
    /// Where they begin, in bytes.
    pub indices_offset: u64,
    /// How many there can be.
    pub index_capacity: u32,
    /// Most triangles of all draws of a frame.
    pub triangle_capacity: u32,
    /// Most draws of a frame.
    pub draw_capacity: u32,
    /// How many shading keys there are, 1 to 16,383.
    pub keys: u32,
    /// How clip space lies.
    pub clip: ClipSpace,
}

/// A run of triangles that are shaded alike.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Draw {
    /// Its first index.
    pub first_index: u32,
    /// How many triangles it has.
    pub triangle_count: u32,
    /// Added to each of its indices.
    pub vertex_offset: i32,
    /// The shading key: which of the host's pipelines shades it.
    pub key: u32,
    /// A number of the host's, which its shaders see. Triangles of one number are taken to look alike where detection
    /// compares colours.
    pub material: u16,
    /// Whether back faces show. A front face is counter-clockwise on the screen.
    pub double_sided: bool,
    /// Whether light or paint may change within a pixel, as with a texture or a glossy surface: it is then shaded in
    /// several parts of a superpixel where the pixels around tell that it does.
    pub detailed: bool,
}

/// Most shading keys: there is one more within, and 14 bits for all.
const MOST_KEYS: u32 = (1 << 14) - 1;
/// Bits of a triangle's last word: see `shaders/include/frame.glsl`.
const KEY_SHIFT: u32 = 16;
const DETAILED: u32 = 1 << 30;
const DOUBLE_SIDED: u32 = 1 << 31;
/// Most triangles: the device counts corners in 32 bits.
const MOST_TRIANGLES: u32 = u32::MAX / 3;

impl Geometry {
    pub(super) fn check(&self, gpu: &Gpu) -> Result<(), HostError> {
        if self.positions == vk::Buffer::null() {
            return Err(HostError::NullHandle("the buffer of positions"));
        }
        if self.indices == vk::Buffer::null() {
            return Err(HostError::NullHandle("the buffer of indices"));
        }
        let limits = gpu.limits();
        let texels = limits.max_texel_elements.min(u64::from(u32::MAX)) as u32;
        for (what, found, most) in [
            ("vertex_capacity", self.vertex_capacity, texels),
            ("index_capacity", self.index_capacity, u32::MAX),
            (
                "triangle_capacity",
                self.triangle_capacity,
                texels.min(MOST_TRIANGLES),
            ),
            ("draw_capacity", self.draw_capacity, 1 << 24),
            ("keys", self.keys, MOST_KEYS),
        ] {
            if !(1..=most).contains(&found) {
                return Err(HostError::Count { what, found, most });
            }
        }
        let alignment = limits.buffer_alignment.max(16);
        for (what, offset) in [
            ("positions_offset", self.positions_offset),
            ("indices_offset", self.indices_offset),
        ] {
            if offset % alignment != 0 {
                return Err(HostError::Alignment {
                    what,
                    offset,
                    alignment,
                });
            }
        }
        Ok(())
    }

    pub(super) fn position_bytes(&self) -> u64 {
        u64::from(self.vertex_capacity) * 16
    }

    pub(super) fn positions_info(&self) -> vk::DescriptorBufferInfo {
        vk::DescriptorBufferInfo::default()
            .buffer(self.positions)
            .offset(self.positions_offset)
            .range(self.position_bytes())
    }

    pub(super) fn indices_info(&self) -> vk::DescriptorBufferInfo {
        vk::DescriptorBufferInfo::default()
            .buffer(self.indices)
            .offset(self.indices_offset)
            .range(u64::from(self.index_capacity) * 4)
    }

    /// A frame's draws as the device reads them, without empty ones, and how many triangles they have.
    ///
    /// # Errors
    /// The first draw that does not fit.
    pub(super) fn adopted(&self, draws: &[Draw]) -> Result<(Vec<AdoptedDraw>, u32), HostError> {
        let capacity = |what, found, capacity| HostError::Capacity {
            what,
            found,
            capacity,
        };
        if draws.len() > self.draw_capacity as usize {
            return Err(capacity("draws", draws.len() as u64, self.draw_capacity));
        }
        let mut triangles = 0_u64;
        let mut adopted = Vec::with_capacity(draws.len());
        for (draw, found) in draws.iter().enumerate() {
            let end = u64::from(found.first_index) + 3 * u64::from(found.triangle_count);
            if end > u64::from(self.index_capacity) {
                return Err(HostError::Indices {
                    draw,
                    end,
                    indices: self.index_capacity,
                });
            }
            if found.key >= self.keys {
                return Err(HostError::Key {
                    draw,
                    key: found.key,
                    keys: self.keys,
                });
            }
            let flag = |bit: u32, set: bool| if set { bit } else { 0 };
            if found.triangle_count > 0 {
                adopted.push(AdoptedDraw {
                    first_triangle: triangles as u32,
                    first_index: found.first_index,
                    vertex_offset: found.vertex_offset.cast_unsigned(),
                    word: u32::from(found.material)
                        | found.key << KEY_SHIFT
                        | flag(DETAILED, found.detailed)
                        | flag(DOUBLE_SIDED, found.double_sided),
                });
            }
            triangles += u64::from(found.triangle_count);
            if triangles > u64::from(self.triangle_capacity) {
                return Err(capacity("triangles", triangles, self.triangle_capacity));
            }
        }
        Ok((adopted, triangles as u32))
    }
}

/// A host's triangles as passes read them.
pub(super) struct HostContent {
    triangles: BufferView,
    positions: TexelView,
    /// Stand for attributes and materials, which no pass reads of a host's triangles.
    unread_floats: BufferView,
    unread_words: BufferView,
    unread: Buffer,
    triangle_capacity: u32,
    keys: u32,
}

impl HostContent {
    /// # Safety
    /// The host's buffer of positions is as [`Geometry`] says and outlives this.
    pub unsafe fn new(
        gpu: &Arc<Gpu>,
        memory: &Memory,
        geometry: &Geometry,
    ) -> Result<Self, VulkanError> {
        let float4 = vk::Format::R32G32B32A32_SFLOAT;
        let uint4 = vk::Format::R32G32B32A32_UINT;
        let usage =
            vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER | vk::BufferUsageFlags::STORAGE_BUFFER;
        let texels = |name, elements, format| {
            memory.texel_buffer(name, elements, format, usage, MemoryUse::Device)
        };
        let bytes = geometry.position_bytes();
        Ok(Self {
            triangles: texels("triangles", u64::from(geometry.triangle_capacity), uint4)?,
            // SAFETY: passed on to the caller.
            positions: unsafe {
                TexelView::new(
                    gpu,
                    geometry.positions,
                    float4,
                    geometry.positions_offset,
                    bytes,
                )
            }?,
            unread_floats: texels("unread vectors", 1, float4)?,
            unread_words: texels("unread words", 1, uint4)?,
            unread: memory.storage_buffer("unread", 64, usage, MemoryUse::Device)?,
            triangle_capacity: geometry.triangle_capacity,
            keys: geometry.keys,
        })
    }

    pub fn triangles(&self) -> &Buffer {
        &self.triangles.buffer
    }

    /// Stands for lights, which the engine does not read.
    pub fn lights(&self) -> &Buffer {
        &self.unread
    }

    /// The texel buffers of `shaders/include/frame.glsl` that it has, by binding.
    pub fn texels(&self) -> [(u32, vk::BufferView); 10] {
        let (floats, words) = (self.unread_floats.view, self.unread_words.view);
        [
            (1, self.positions.raw),
            (2, self.triangles.view),
            (3, floats),
            (4, floats),
            (5, floats),
            (6, floats),
            (7, words),
            (9, words),
            (10, words),
            (11, words),
        ]
    }
}

impl Content for HostContent {
    fn index_count(&self) -> u32 {
        self.triangle_capacity
    }

    fn is_instanced(&self) -> bool {
        false
    }

    fn constants(&self, constants: Constants) -> Constants {
        constants
    }

    fn has_mask(&self) -> bool {
        false
    }

    fn has_blend(&self) -> bool {
        false
    }

    fn has_high_frequency(&self) -> bool {
        true
    }

    fn is_mostly_high_frequency(&self) -> bool {
        false
    }

    fn is_tinted(&self) -> bool {
        false
    }

    /// One more than the host has, since samples of a single key would not be listed.
    fn bin_count(&self) -> u32 {
        self.keys + 1
    }

    fn environment_map(&self) -> Option<vk::DescriptorImageInfo> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ash::vk::Handle;

    fn geometry() -> Geometry {
        Geometry {
            positions: vk::Buffer::from_raw(1),
            positions_offset: 0,
            vertex_capacity: 100,
            indices: vk::Buffer::from_raw(2),
            indices_offset: 0,
            index_capacity: 60,
            triangle_capacity: 12,
            draw_capacity: 3,
            keys: 2,
            clip: ClipSpace::default(),
        }
    }

    fn draw(first_index: u32, triangle_count: u32, key: u32) -> Draw {
        Draw {
            first_index,
            triangle_count,
            key,
            ..Draw::default()
        }
    }

    #[test]
    fn draws_follow_each_other_and_empty_ones_are_left_out() {
        let draws = [draw(30, 4, 1), draw(0, 0, 0), draw(0, 7, 0)];
        let (adopted, triangles) = geometry().adopted(&draws).unwrap();
        assert_eq!(triangles, 11);
        let firsts: Vec<_> = adopted
            .iter()
            .map(|d| (d.first_triangle, d.first_index))
            .collect();
        assert_eq!(firsts, [(0, 30), (4, 0)]);
        assert_eq!(adopted[0].word, 1 << KEY_SHIFT);
    }

    #[test]
    fn flags_and_numbers_have_bits_of_their_own() {
        let all = Draw {
            material: u16::MAX,
            double_sided: true,
            detailed: true,
            vertex_offset: -1,
            ..draw(0, 1, 1)
        };
        let (adopted, _) = geometry().adopted(&[all]).unwrap();
        assert_eq!(adopted[0].word, 0xffff | 1 << 16 | 1 << 30 | 1 << 31);
        assert_eq!(adopted[0].vertex_offset, u32::MAX);
    }

    #[test]
    fn draws_that_do_not_fit_are_named() {
        let refused = |draws: &[Draw]| geometry().adopted(draws).unwrap_err().to_string();
        assert_eq!(
            refused(&[draw(0, 1, 0), draw(30, 11, 0)]),
            "draw 1 reads indices up to 63, and there are 60"
        );
        assert_eq!(
            refused(&[draw(u32::MAX, 1, 0)]),
            "draw 0 reads indices up to 4294967298, and there are 60"
        );
        assert_eq!(
            refused(&[draw(0, 1, 2)]),
            "draw 0 has shading key 2, and there are 2"
        );
        assert_eq!(
            refused(&[draw(0, 10, 0), draw(0, 3, 0)]),
            "13 triangles; the frame was prepared for 12"
        );
        assert_eq!(
            refused(&[draw(0, 1, 0); 4]),
            "4 draws; the frame was prepared for 3"
        );
    }
}

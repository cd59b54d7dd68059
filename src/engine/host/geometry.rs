//! Buffers that a host lends.

use super::HostError;
use super::alpha::{AlphaMap, MOST_MAPS};
use crate::vulkan::{Gpu, Limits, VulkanError};
use ash::vk;

/// How the host's clip space lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ClipSpace {
    /// Whether y points up, as with a viewport of negative height; otherwise down, as Vulkan has it.
    pub y_up: bool,
    /// Whether depth runs from 1 near to 0 far; otherwise from 0 to 1.
    pub reversed_depth: bool,
}

/// What positions are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PositionSpace {
    /// Four floats in clip space: the very values that the host's vertex shader outputs.
    Clip,
    /// Three floats in a space of each draw's own, from which [`Draw::to_clip`](super::Draw::to_clip) leads to clip space.
    Object {
        /// Most vertices of all draws of a frame, those that several draws have counted for each.
        capacity: u32,
    },
}

/// Texture coordinates of vertices, by which alpha maps are looked up: two floats each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinates {
    /// Made with `STORAGE_BUFFER`.
    pub buffer: vk::Buffer,
    /// Where those of the first vertex are, in bytes: a multiple of 4.
    pub offset: u64,
    /// Bytes from one vertex to the next: a multiple of 4, at least 8.
    pub stride: u32,
}

/// Buffers of a host. They may hold something else in every frame; the engine reads them when a recording is executed.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// Positions of vertices, made with `STORAGE_BUFFER`; where they lie in clip space and 16 bytes apart, with
    /// `UNIFORM_TEXEL_BUFFER` too.
    pub positions: vk::Buffer,
    /// Where the first one is, in bytes: a multiple of 4.
    pub positions_offset: u64,
    /// Bytes from one to the next: a multiple of 4, and at least those of a position.
    pub position_stride: u32,
    /// What they are.
    pub position_space: PositionSpace,
    /// How many vertices there can be. Larger indices are taken for the last, or in object space for the last of the draw.
    pub vertex_capacity: u32,
    /// Texture coordinates, where there are alpha maps.
    pub coordinates: Option<Coordinates>,
    /// What draws are tested by that are not opaque. The library reads the images, in `SHADER_READ_ONLY_OPTIMAL`, when a
    /// frame's first recording is executed, and keeps what they hold then.
    pub alpha_maps: Vec<AlphaMap>,
    /// Whether draws may be [blended](super::Draw::blended).
    pub blended: bool,
    /// Indices, three a triangle. Made with `STORAGE_BUFFER`.
    pub indices: vk::Buffer,
    /// Where they begin, in bytes: a multiple of an index's size.
    pub indices_offset: u64,
    /// `UINT16` or `UINT32`. The buffer of those of 16 bits reaches to a multiple of 4 bytes.
    pub index_type: vk::IndexType,
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

/// Most shading keys: there is one more within, and 14 bits for all.
const MOST_KEYS: u32 = (1 << 14) - 1;
/// Most triangles: the device counts corners in 32 bits.
const MOST_TRIANGLES: u32 = u32::MAX / 3;
/// Bytes of a position in clip space.
const CLIP_BYTES: u64 = 16;

/// A part of a lent buffer: from a multiple of what the device asks for on, with what lies before the first element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct LentBytes {
    buffer: vk::Buffer,
    offset: u64,
    /// Bytes before the first element.
    pub before: u32,
    /// Bytes in all.
    bytes: u64,
}

impl LentBytes {
    fn new(buffer: vk::Buffer, offset: u64, bytes: u64, alignment: u64) -> Self {
        let before = offset % alignment;
        Self {
            buffer,
            offset: offset - before,
            before: before as u32,
            bytes: before + bytes,
        }
    }

    pub fn info(&self) -> vk::DescriptorBufferInfo {
        vk::DescriptorBufferInfo::default()
            .buffer(self.buffer)
            .offset(self.offset)
            .range(self.bytes)
    }
}

impl Geometry {
    pub(super) fn check(&self, gpu: &Gpu) -> Result<(), HostError> {
        if self.positions == vk::Buffer::null() {
            return Err(HostError::NullHandle("the buffer of positions"));
        }
        if self.indices == vk::Buffer::null() {
            return Err(HostError::NullHandle("the buffer of indices"));
        }
        let limits = gpu.limits();
        let index_bytes = self.index_bytes().ok_or(HostError::IndexType {
            found: self.index_type,
        })?;
        let texels = limits.max_texel_elements.min(u64::from(u32::MAX)) as u32;
        let (vertices, made) = match self.position_space {
            PositionSpace::Clip => (texels, 1),
            PositionSpace::Object { capacity } => (u32::MAX, capacity),
        };
        for (what, found, most) in [
            ("vertex_capacity", self.vertex_capacity, vertices),
            ("the capacity of positions in object space", made, texels),
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
        let offsets = [
            ("positions_offset", self.positions_offset, 4),
            ("indices_offset", self.indices_offset, index_bytes),
        ];
        let strides = [(
            "position_stride",
            self.position_stride,
            self.position_bytes() as u32,
        )];
        let buffers = [
            ("the buffer of positions", self.lent_positions(limits)),
            ("the buffer of indices", self.lent_indices(limits)),
        ];
        check_layout(limits, &offsets, &strides, &buffers)?;
        self.check_alpha(limits)
    }

    fn check_alpha(&self, limits: &Limits) -> Result<(), HostError> {
        if self.alpha_maps.is_empty() {
            return Ok(());
        }
        if self.alpha_maps.len() > MOST_MAPS as usize {
            return Err(HostError::Count {
                what: "the number of alpha maps",
                found: u32::try_from(self.alpha_maps.len()).unwrap_or(u32::MAX),
                most: MOST_MAPS,
            });
        }
        for (number, map) in self.alpha_maps.iter().enumerate() {
            map.check(number)?;
        }
        let lent = self.coordinates.ok_or(HostError::NoCoordinates)?;
        if lent.buffer == vk::Buffer::null() {
            return Err(HostError::NullHandle("the buffer of coordinates"));
        }
        let buffers = self
            .lent_coordinates(limits)
            .map(|bytes| ("the buffer of coordinates", bytes));
        check_layout(
            limits,
            &[("coordinates_offset", lent.offset, 4)],
            &[("coordinates_stride", lent.stride, 8)],
            buffers.as_slice(),
        )
    }

    /// Where texture coordinates lie, if there are any.
    pub(super) fn lent_coordinates(&self, limits: &Limits) -> Option<LentBytes> {
        let Coordinates {
            buffer,
            offset,
            stride,
        } = self.coordinates?;
        let bytes = self.vertex_steps() * u64::from(stride) + 8;
        Some(LentBytes::new(buffer, offset, bytes, alignment(limits)))
    }

    fn vertex_steps(&self) -> u64 {
        u64::from(self.vertex_capacity.saturating_sub(1))
    }

    fn index_bytes(&self) -> Option<u64> {
        match self.index_type {
            vk::IndexType::UINT16 => Some(2),
            vk::IndexType::UINT32 => Some(4),
            _ => None,
        }
    }

    pub(super) fn has_short_indices(&self) -> bool {
        self.index_type == vk::IndexType::UINT16
    }

    fn position_bytes(&self) -> u64 {
        match self.position_space {
            PositionSpace::Clip => CLIP_BYTES,
            PositionSpace::Object { .. } => 12,
        }
    }

    /// Whether passes can read positions where they are.
    pub(super) fn is_read_in_place(&self, limits: &Limits) -> bool {
        self.position_space == PositionSpace::Clip
            && u64::from(self.position_stride) == CLIP_BYTES
            && self.positions_offset.is_multiple_of(alignment(limits))
    }

    /// How many positions in clip space there can be.
    pub(super) fn position_capacity(&self) -> u32 {
        match self.position_space {
            PositionSpace::Clip => self.vertex_capacity,
            PositionSpace::Object { capacity } => capacity,
        }
    }

    pub(super) fn lent_positions(&self, limits: &Limits) -> LentBytes {
        let bytes = self.vertex_steps() * u64::from(self.position_stride) + self.position_bytes();
        let offset = self.positions_offset;
        LentBytes::new(self.positions, offset, bytes, alignment(limits))
    }

    pub(super) fn lent_indices(&self, limits: &Limits) -> LentBytes {
        let bytes = u64::from(self.index_capacity) * self.index_bytes().unwrap_or_default();
        let offset = self.indices_offset;
        let lent = LentBytes::new(self.indices, offset, bytes, alignment(limits));
        LentBytes {
            // Shaders read words.
            bytes: lent.bytes.next_multiple_of(4),
            ..lent
        }
    }

    /// Where indices begin in [`Self::lent_indices`], in indices.
    pub(super) fn first_lent_index(&self, limits: &Limits) -> u32 {
        let size = if self.has_short_indices() { 2 } else { 4 };
        self.lent_indices(limits).before / size
    }
}

/// What descriptors of buffers may begin at.
fn alignment(limits: &Limits) -> u64 {
    limits.buffer_alignment.max(CLIP_BYTES)
}

/// Checks offsets and what they are multiples of, strides and the least that they can be, and parts of buffers.
fn check_layout(
    limits: &Limits,
    offsets: &[(&'static str, u64, u64)],
    strides: &[(&'static str, u32, u32)],
    buffers: &[(&'static str, LentBytes)],
) -> Result<(), HostError> {
    for &(what, found, least) in strides {
        if found % 4 != 0 || found < least {
            return Err(HostError::Stride { what, found, least });
        }
    }
    for &(what, offset, alignment) in offsets {
        if offset % alignment != 0 {
            return Err(HostError::Alignment {
                what,
                offset,
                alignment,
            });
        }
    }
    for (what, lent) in buffers {
        VulkanError::check_limit(what, lent.bytes, "bytes", limits.max_storage_bytes)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_lent_begins_where_the_device_can() {
        let buffer = vk::Buffer::null();
        let lent = LentBytes::new(buffer, 300, 100, 256);
        assert_eq!((lent.offset, lent.before, lent.bytes), (256, 44, 144));
        let lent = LentBytes::new(buffer, 512, 100, 256);
        assert_eq!((lent.offset, lent.before, lent.bytes), (512, 0, 100));
    }
}

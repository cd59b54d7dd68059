//! Buffers that a host's draws read.

use super::alignment::{LentBytes, check_layout, descriptor_alignment};
use super::{HostError, PositionSpace};
use crate::vulkan::Limits;
use ash::vk;

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

/// An index buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Indices {
    /// Made with `STORAGE_BUFFER`. The buffer of indices of 16 bits reaches to a multiple of 4 bytes.
    pub buffer: vk::Buffer,
    /// Where they begin, in bytes: a multiple of an index's size.
    pub offset: u64,
    /// `UINT16` or `UINT32`.
    pub index_type: vk::IndexType,
    /// How many there can be.
    pub capacity: u32,
}

/// The buffers that a draw reads, as they are bound for it: those of a mesh, or of many meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mesh {
    /// Positions of vertices, made with `STORAGE_BUFFER`; where they lie in clip space and 16 bytes apart, with
    /// `UNIFORM_TEXEL_BUFFER` too.
    pub positions: vk::Buffer,
    /// Where the first one is, in bytes: a multiple of 4.
    pub positions_offset: u64,
    /// Bytes from one to the next: a multiple of 4, and at least those of a position.
    pub position_stride: u32,
    /// How many vertices there can be. Larger indices are taken for the last, or in object space for the last of the draw.
    pub vertex_capacity: u32,
    /// Texture coordinates, for draws with alpha maps.
    pub coordinates: Option<Coordinates>,
    /// Indices. Without them, a draw takes vertices in their order, as `vkCmdDraw` does.
    pub indices: Option<Indices>,
}

/// Bytes of a position in clip space.
const CLIP_BYTES: u64 = 16;

impl PositionSpace {
    /// Bytes of a position.
    fn bytes(self) -> u64 {
        match self {
            Self::Clip => CLIP_BYTES,
            Self::Object { .. } => 12,
        }
    }
}

impl Indices {
    /// Bytes of an index, of a type that is read.
    fn bytes(&self) -> Option<u64> {
        match self.index_type {
            vk::IndexType::UINT16 => Some(2),
            vk::IndexType::UINT32 => Some(4),
            _ => None,
        }
    }

    pub(super) fn are_short(&self) -> bool {
        self.index_type == vk::IndexType::UINT16
    }

    pub(super) fn lent(&self, limits: &Limits) -> LentBytes {
        let bytes = u64::from(self.capacity) * self.bytes().unwrap_or_default();
        // Shaders read words.
        LentBytes::new(self.buffer, self.offset, bytes, limits).in_words()
    }

    /// Where indices begin in [`Self::lent`], in indices.
    pub(super) fn first_lent(&self, limits: &Limits) -> u32 {
        let size = if self.are_short() { 2 } else { 4 };
        self.lent(limits).before / size
    }

    fn check(&self, limits: &Limits) -> Result<(), HostError> {
        if self.buffer == vk::Buffer::null() {
            return Err(HostError::NullHandle("the buffer of indices"));
        }
        let size = self.bytes().ok_or(HostError::IndexType {
            found: self.index_type,
        })?;
        HostError::check_count("index_capacity", self.capacity, u32::MAX)?;
        check_layout(
            limits,
            ("indices_offset", self.offset, size),
            None,
            ("the buffer of indices", self.lent(limits)),
        )
    }
}

impl Coordinates {
    fn lent(&self, vertex_steps: u64, limits: &Limits) -> LentBytes {
        let bytes = vertex_steps * u64::from(self.stride) + 8;
        LentBytes::new(self.buffer, self.offset, bytes, limits)
    }

    fn check(&self, vertex_steps: u64, limits: &Limits) -> Result<(), HostError> {
        if self.buffer == vk::Buffer::null() {
            return Err(HostError::NullHandle("the buffer of coordinates"));
        }
        check_layout(
            limits,
            ("coordinates_offset", self.offset, 4),
            Some(("coordinates_stride", self.stride, 8)),
            ("the buffer of coordinates", self.lent(vertex_steps, limits)),
        )
    }
}

impl Mesh {
    /// Refuses what can't be read. `most_vertices` is the largest number of vertices that there can be.
    pub(super) fn check(
        &self,
        space: PositionSpace,
        most_vertices: u32,
        limits: &Limits,
    ) -> Result<(), HostError> {
        if self.positions == vk::Buffer::null() {
            return Err(HostError::NullHandle("the buffer of positions"));
        }
        HostError::check_count("vertex_capacity", self.vertex_capacity, most_vertices)?;
        check_layout(
            limits,
            ("positions_offset", self.positions_offset, 4),
            Some((
                "position_stride",
                self.position_stride,
                space.bytes() as u32,
            )),
            (
                "the buffer of positions",
                self.lent_positions(space, limits),
            ),
        )?;
        self.indices.map_or(Ok(()), |indices| indices.check(limits))
    }

    /// Refuses texture coordinates that can't be read.
    pub(super) fn check_coordinates(&self, limits: &Limits) -> Result<(), HostError> {
        let check = |lent: Coordinates| lent.check(self.vertex_steps(), limits);
        self.coordinates.map_or(Ok(()), check)
    }

    fn vertex_steps(&self) -> u64 {
        u64::from(self.vertex_capacity.saturating_sub(1))
    }

    pub(super) fn lent_positions(&self, space: PositionSpace, limits: &Limits) -> LentBytes {
        let bytes = self.vertex_steps() * u64::from(self.position_stride) + space.bytes();
        LentBytes::new(self.positions, self.positions_offset, bytes, limits)
    }

    /// Texture coordinates and the bytes that they lie in, if there are any.
    pub(super) fn lent_coordinates(&self, limits: &Limits) -> Option<(Coordinates, LentBytes)> {
        let lent = self.coordinates?;
        Some((lent, lent.lent(self.vertex_steps(), limits)))
    }

    /// Whether passes can read positions where they are, which lie in this space.
    pub(super) fn is_read_in_place(&self, space: PositionSpace, limits: &Limits) -> bool {
        space == PositionSpace::Clip
            && u64::from(self.position_stride) == CLIP_BYTES
            && self
                .positions_offset
                .is_multiple_of(descriptor_alignment(limits))
    }
}

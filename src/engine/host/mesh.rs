//! Buffers of a mesh, which a host's draws read.

use super::alignment::{LentBytes, descriptor_alignment};
use super::{HostError, Member, PositionSpace, VertexFormat};
use crate::vulkan::Limits;
use ash::vk;

/// Texture coordinates of vertices, for alpha maps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates {
    /// Buffer, created with `STORAGE_BUFFER`. With 16-bit components, its size is a multiple of 4 bytes.
    pub buffer: vk::Buffer,
    /// Offset of the first vertex's coordinates in bytes: a multiple of the size of a component.
    pub offset: u64,
    /// Distance in bytes from one vertex to the next: a multiple of the size of a component, at least two components.
    pub stride: u32,
    /// Format of the coordinates, with two components or more.
    pub format: VertexFormat,
}

/// An index buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Indices {
    /// Buffer, created with `STORAGE_BUFFER`. With 16-bit indices, its size is a multiple of 4 bytes.
    pub buffer: vk::Buffer,
    /// Offset of the first index in bytes: a multiple of the size of an index.
    pub offset: u64,
    /// Type of the indices: `UINT16` or `UINT32`.
    pub index_type: vk::IndexType,
    /// Largest number of indices.
    pub capacity: u32,
}

/// Buffers that draws read, bound together: those of one mesh, or of many meshes that share buffers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mesh {
    /// Buffer of vertex positions, created with `STORAGE_BUFFER`, and with `UNIFORM_TEXEL_BUFFER` too if positions are
    /// in clip space with a stride of 16 bytes. With 16-bit components, its size is a multiple of 4 bytes.
    pub positions: vk::Buffer,
    /// Offset of the first position in bytes: a multiple of the size of a component.
    pub positions_offset: u64,
    /// Distance in bytes from one position to the next: a multiple of the size of a component, and at least the size of a
    /// position.
    pub position_stride: u32,
    /// Format of positions in object space, with three components or more. Positions in clip space are four floats, and
    /// this is [`VertexFormat::FLOAT`].
    pub position_format: VertexFormat,
    /// Largest number of vertices. A larger index is clamped to the last vertex; in object space, to the last vertex of
    /// the draw.
    pub vertex_capacity: u32,
    /// Texture coordinates; required for draws with alpha maps.
    pub coordinates: Option<Coordinates>,
    /// Index buffer. Without indices, a draw reads consecutive vertices, as `vkCmdDraw` does.
    pub indices: Option<Indices>,
}

/// Size of a position in clip space, in bytes.
const CLIP_BYTES: u64 = 16;

impl PositionSpace {
    /// Size of a position in bytes, in a buffer with this format.
    fn bytes(self, format: VertexFormat) -> u64 {
        match self {
            Self::Clip => CLIP_BYTES,
            Self::Object { .. } => 3 * u64::from(format.component_bytes()),
        }
    }
}

impl Indices {
    /// Size of an index in bytes; `None` for an unsupported type.
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
        // Shaders read whole words.
        LentBytes::new(self.buffer, self.offset, bytes, limits).in_words()
    }

    /// Number of indices in [`Self::lent`] before the first index of the host.
    pub(super) fn first_lent(&self, limits: &Limits) -> u32 {
        let size = if self.are_short() { 2 } else { 4 };
        self.lent(limits).before / size
    }

    fn check(&self, limits: &Limits) -> Result<(), HostError> {
        if self.buffer == vk::Buffer::null() {
            return Err(HostError::Null(Member::Indices));
        }
        let size = self.bytes().ok_or(HostError::IndexType(self.index_type))?;
        HostError::check_count(Member::IndexCapacity, self.capacity, u32::MAX)?;
        HostError::check_offset(Member::IndicesOffset, self.offset, size)?;
        self.lent(limits).check(Member::Indices, limits)
    }
}

impl Coordinates {
    fn lent(&self, vertex_steps: u64, limits: &Limits) -> LentBytes {
        let bytes = vertex_steps * u64::from(self.stride) + 2 * u64::from(self.format.component_bytes());
        // Shaders read whole words.
        LentBytes::new(self.buffer, self.offset, bytes, limits).in_words()
    }

    fn check(&self, vertex_steps: u64, limits: &Limits) -> Result<(), HostError> {
        if self.buffer == vk::Buffer::null() {
            return Err(HostError::Null(Member::Coordinates));
        }
        self.format.check(Member::CoordinatesFormat, 2)?;
        let unit = self.format.component_bytes();
        HostError::check_stride(Member::CoordinatesStride, self.stride, 2 * unit, unit)?;
        HostError::check_offset(Member::CoordinatesOffset, self.offset, u64::from(unit))?;
        self.lent(vertex_steps, limits).check(Member::Coordinates, limits)
    }
}

impl Mesh {
    /// Checks that passes can read the buffers. `most_vertices` is the largest possible number of vertices.
    pub(super) fn check(&self, space: PositionSpace, most_vertices: u32, limits: &Limits) -> Result<(), HostError> {
        if self.positions == vk::Buffer::null() {
            return Err(HostError::Null(Member::Positions));
        }
        HostError::check_count(Member::VertexCapacity, self.vertex_capacity, most_vertices)?;
        let format = self.position_format;
        format.check(Member::PositionFormat, 3)?;
        if space == PositionSpace::Clip && format != VertexFormat::FLOAT {
            return Err(HostError::ClipFormat(format.format));
        }
        let unit = format.component_bytes();
        HostError::check_stride(Member::PositionStride, self.position_stride, space.bytes(format) as u32, unit)?;
        HostError::check_offset(Member::PositionsOffset, self.positions_offset, u64::from(unit))?;
        self.lent_positions(space, limits).check(Member::Positions, limits)?;
        self.indices.map_or(Ok(()), |indices| indices.check(limits))
    }

    /// Checks that passes can read the texture coordinates.
    pub(super) fn check_coordinates(&self, limits: &Limits) -> Result<(), HostError> {
        let check = |lent: Coordinates| lent.check(self.vertex_steps(), limits);
        self.coordinates.map_or(Ok(()), check)
    }

    fn vertex_steps(&self) -> u64 {
        u64::from(self.vertex_capacity.saturating_sub(1))
    }

    pub(super) fn lent_positions(&self, space: PositionSpace, limits: &Limits) -> LentBytes {
        let bytes = self.vertex_steps() * u64::from(self.position_stride) + space.bytes(self.position_format);
        // Shaders read whole words.
        LentBytes::new(self.positions, self.positions_offset, bytes, limits).in_words()
    }

    /// Texture coordinates and the range of their buffer, if there are any.
    pub(super) fn lent_coordinates(&self, limits: &Limits) -> Option<(Coordinates, LentBytes)> {
        let lent = self.coordinates?;
        Some((lent, lent.lent(self.vertex_steps(), limits)))
    }

    /// Whether passes can read positions in place, given the `space` in which they are.
    pub(super) fn is_read_in_place(&self, space: PositionSpace, limits: &Limits) -> bool {
        space == PositionSpace::Clip
            && u64::from(self.position_stride) == CLIP_BYTES
            && self.positions_offset.is_multiple_of(descriptor_alignment(limits))
    }
}

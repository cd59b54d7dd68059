//! Draws that the host's device wrote.

use super::alignment::LentBytes;
use super::draw::check_front_face;
use super::{Geometry, HostError, Member, PositionSpace, Topology};
use crate::engine::data::Draws;
use crate::engine::passes::indirect::{BoundDraws, DrawBuffers, Indirect, IndirectSizes};
use crate::engine::pipelines::FrameLayout;
use crate::engine::spirv;
use crate::vulkan::{Buffer, Limits, Memory, MemoryUse, Recorder, VulkanError};
use ash::vk;
use std::mem::offset_of;

/// A list of draws that the device writes, with the arguments of `vkCmdDrawIndexedIndirect` or, for a mesh without
/// indices, `vkCmdDrawIndirect`, and with capacities. The library reads it when a recording is executed, so that compute
/// shaders before, in the same command buffer, may decide what is drawn.
///
/// Each instance of a command is a draw. Its number, `firstInstance` and on, which is `gl_InstanceIndex` of a vertex
/// shader, is the index of its [`Instance`].
///
/// All draws of a list have the state of one pipeline, such as the culling. The draws of the CPU come first, then those of
/// the lists in their order, in each case the opaque ones before those with alpha maps, and the blended ones last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IndirectDraws {
    /// Buffer of commands, created with `STORAGE_BUFFER`.
    pub commands: vk::Buffer,
    /// Offset of the first command in bytes: a multiple of 4.
    pub commands_offset: u64,
    /// Distance in bytes from one command to the next: a multiple of 4, at least the size of a command.
    pub command_stride: u32,
    /// Largest number of commands, up to 1,048,576; the number of commands without [`Self::count`].
    pub command_capacity: u32,
    /// Buffer with the number of commands, a 32-bit word, created with `STORAGE_BUFFER`, and its offset in bytes: a
    /// multiple of 4.
    pub count: Option<(vk::Buffer, u64)>,
    /// Buffer of [`Instance`]s, created with `STORAGE_BUFFER`.
    pub instances: vk::Buffer,
    /// Offset of the first instance in bytes: a multiple of 256, or of the device's offset alignment for buffer
    /// descriptors.
    pub instances_offset: u64,
    /// Number of instances in the buffer.
    pub instance_capacity: u32,
    /// Largest number of draws: instances of all commands.
    pub draw_capacity: u32,
    /// Largest number of triangles of all draws.
    pub triangle_capacity: u32,
    /// Largest number of vertices of all draws, if positions are in object space; otherwise ignored.
    pub position_capacity: u32,
    /// Index into [`Geometry::meshes`] of the mesh whose buffers the draws read.
    pub mesh: u32,
    /// Topology of the draws.
    pub topology: Topology,
    /// Orientation of front faces in the image.
    pub front_face: vk::FrontFace,
    /// Whether back faces are visible.
    pub double_sided: bool,
    /// Whether the draws have alpha maps.
    pub alpha_tested: bool,
    /// Whether the draws are blended.
    pub blended: bool,
}

/// What a draw of an [`IndirectDraws`] has besides its command. `gpc_instance.glsl` declares the same structure.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Instance {
    /// Matrix from object space to clip space, by columns, if positions are in object space; otherwise ignored.
    pub to_clip: [[f32; 4]; 4],
    /// Number of vertices from `vertexOffset` or `firstVertex` of the command on, if positions are in object space.
    pub vertex_count: u32,
    /// Shading key.
    pub key: u32,
    /// Number of the host's choice, which its shaders can read. Triangles with the same lower 16 bits are assumed to look
    /// alike, as those with the same [`Draw::material`](super::Draw::material).
    pub material: u32,
    /// 1 + the index of the alpha map, if the draws of the list have alpha maps; otherwise 0.
    pub alpha_map: u32,
    /// 1 if the colour may vary within a pixel, otherwise 0.
    pub detailed: u32,
    /// 0.
    pub reserved: [u32; 3],
}

/// Counts of all [`IndirectDraws`] of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct IndirectCounts {
    /// Number of draws that the device wrote.
    pub draws: u64,
    /// Number of triangles that the frame shows of them.
    pub triangles: u64,
    /// Number of draws that were left out because a capacity was too small: all of a list from the first one that did not
    /// fit.
    pub left_out: u64,
    /// Number of draws that were left out because they are not possible, such as draws with vertices or indices beyond
    /// the ends of the mesh, a shading key or an alpha map that does not exist, or an instance beyond the capacity.
    pub impossible: u64,
}

/// Largest number of commands of a list: loops of the device take so many.
const MOST_COMMANDS: u32 = 1 << 20;

const _: () = {
    type Shader = spirv::GpcInstance;
    assert!(size_of::<Instance>() == 96 && size_of::<Shader>() == size_of::<Instance>());
    assert!(offset_of!(Instance, vertex_count) == offset_of!(Shader, vertex_count));
    assert!(offset_of!(Instance, key) == offset_of!(Shader, key));
    assert!(offset_of!(Instance, material) == offset_of!(Shader, material));
    assert!(offset_of!(Instance, alpha_map) == offset_of!(Shader, alpha_map));
    assert!(offset_of!(Instance, detailed) == offset_of!(Shader, detailed));
};

impl IndirectDraws {
    fn is_indexed(geometry: &Geometry, mesh: u32) -> bool {
        geometry.meshes.get(mesh as usize).is_some_and(|mesh| mesh.indices.is_some())
    }

    /// Size of a command in bytes.
    fn command_bytes(&self, geometry: &Geometry) -> u32 {
        let indexed = size_of::<vk::DrawIndexedIndirectCommand>();
        let bare = size_of::<vk::DrawIndirectCommand>();
        (if Self::is_indexed(geometry, self.mesh) { indexed } else { bare }) as u32
    }

    fn lent_commands(&self, geometry: &Geometry, limits: &Limits) -> LentBytes {
        let steps = u64::from(self.command_capacity.saturating_sub(1));
        let bytes = steps * u64::from(self.command_stride) + u64::from(self.command_bytes(geometry));
        LentBytes::new(self.commands, self.commands_offset, bytes, limits)
    }

    fn lent_count(&self, limits: &Limits) -> Option<LentBytes> {
        self.count.map(|(buffer, offset)| LentBytes::new(buffer, offset, 4, limits))
    }

    fn lent_instances(&self) -> vk::DescriptorBufferInfo {
        let bytes = u64::from(self.instance_capacity) * size_of::<Instance>() as u64;
        vk::DescriptorBufferInfo::default().buffer(self.instances).offset(self.instances_offset).range(bytes)
    }

    /// Number of positions in clip space that the list has of its own: one more than there are vertices.
    pub(super) fn positions(&self, space: PositionSpace) -> u64 {
        match space {
            PositionSpace::Clip => 0,
            PositionSpace::Object { .. } => u64::from(self.position_capacity) + 1,
        }
    }

    /// Number of places for draws: one more than there are draws.
    pub(super) fn draws(&self) -> u64 {
        u64::from(self.draw_capacity) + 1
    }

    /// Checks that the pass can read the buffers, and that the rest of the geometry has what the draws need.
    pub(super) fn check(&self, geometry: &Geometry, limits: &Limits) -> Result<(), HostError> {
        let count = self.count.map(|(buffer, _)| (Member::Count, buffer));
        let buffers = [(Member::Commands, self.commands), (Member::Instances, self.instances)];
        for (member, buffer) in buffers.into_iter().chain(count) {
            if buffer == vk::Buffer::null() {
                return Err(HostError::Null(member));
            }
        }
        let mesh = geometry.mesh(Member::IndirectMesh, self.mesh)?;
        let most_instances = (limits.max_storage_bytes / size_of::<Instance>() as u64).min(u64::from(u32::MAX));
        for (member, found, most) in [
            (Member::CommandCapacity, self.command_capacity, MOST_COMMANDS),
            (Member::InstanceCapacity, self.instance_capacity, most_instances as u32),
            (Member::IndirectDrawCapacity, self.draw_capacity, 1 << 24),
            (Member::IndirectTriangleCapacity, self.triangle_capacity, u32::MAX / 3),
        ] {
            HostError::check_count(member, found, most)?;
        }
        if geometry.position_space != PositionSpace::Clip {
            HostError::check_count(Member::IndirectPositionCapacity, self.position_capacity, u32::MAX - 1)?;
        }
        check_front_face(Member::IndirectFrontFace, self.front_face)?;
        if self.alpha_tested && self.blended {
            return Err(HostError::BlendedMap);
        }
        if self.blended && !geometry.blended {
            return Err(HostError::NotBlended);
        }
        if self.alpha_tested && geometry.alpha_maps.is_empty() {
            return Err(HostError::NoAlphaMaps);
        }
        if self.alpha_tested && mesh.coordinates.is_none() {
            return Err(HostError::DrawCoordinates { mesh: self.mesh });
        }
        HostError::check_stride(Member::CommandStride, self.command_stride, self.command_bytes(geometry), 4)?;
        HostError::check_offset(Member::CommandsOffset, self.commands_offset, 4)?;
        self.lent_commands(geometry, limits).check(Member::Commands, limits)?;
        HostError::check_offset(Member::CountOffset, self.count.map_or(0, |(_, offset)| offset), 4)?;
        HostError::check_offset(Member::InstancesOffset, self.instances_offset, limits.buffer_alignment.max(16))
    }
}

/// The part of a recording's draws, triangles and positions that a list of draws has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct IndirectPart {
    /// Index into [`Geometry::indirect`].
    pub list: usize,
    pub first_triangle: u32,
    pub first_draw: u32,
    pub first_position: u32,
}

/// Pass that places the draws of all lists, with its memory.
pub(super) struct IndirectPlacing {
    pass: Indirect,
    lists: Vec<PlacedList>,
    /// Counts of all lists, for the CPU.
    counts: Buffer,
}

struct PlacedList {
    bound: BoundDraws,
    totals: Buffer,
}

/// Number of words that the pass counts for a list.
const TOTALS: usize = spirv::TOTAL_POSITIONS as usize + 1;
const TOTAL_BYTES: u64 = 4 * TOTALS as u64;

impl IndirectPlacing {
    /// Makes the pass, if there are lists.
    ///
    /// # Safety
    /// The host's buffers are as [`IndirectDraws`] says, and outlive the returned value.
    pub unsafe fn new(
        layout: &FrameLayout,
        memory: &Memory,
        geometry: &Geometry,
        draws: &Draws,
    ) -> Result<Option<Self>, VulkanError> {
        if geometry.indirect.is_empty() {
            return Ok(None);
        }
        let limits = memory.gpu().limits();
        let list = |list: &IndirectDraws| {
            let usage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_SRC;
            let totals = memory.storage_buffer("totals of indirect draws", TOTAL_BYTES, usage, MemoryUse::Device)?;
            let sizes = IndirectSizes { commands: list.command_capacity, draws: list.draw_capacity };
            let commands = list.lent_commands(geometry, limits).info();
            let count = list.lent_count(limits).map(|count| count.info());
            let lent = DrawBuffers { commands, count, instances: list.lent_instances() };
            // SAFETY: passed on to the caller.
            let bound = unsafe { BoundDraws::new(layout, memory, sizes, lent, draws, &totals) }?;
            Ok::<_, VulkanError>(PlacedList { bound, totals })
        };
        let lists = geometry.indirect.iter().map(list).collect::<Result<Vec<_>, _>>()?;
        let bytes = lists.len() as u64 * TOTAL_BYTES;
        let usage = vk::BufferUsageFlags::TRANSFER_DST;
        Ok(Some(Self {
            pass: Indirect::new(layout)?,
            counts: memory.buffer("counts of indirect draws", bytes, usage, MemoryUse::Readback)?,
            lists,
        }))
    }

    /// Records the pass for each list, and a copy of its counts for the CPU.
    pub fn record(&self, recorder: &Recorder<'_>, geometry: &Geometry, parts: &[IndirectPart]) {
        for part in parts {
            let (list, placed) = (&geometry.indirect[part.list], &self.lists[part.list]);
            let push = push(geometry, list, part, recorder.limits());
            self.pass.record(recorder, &placed.bound, &push);
        }
        for (number, list) in self.lists.iter().enumerate() {
            recorder.copy(&list.totals, TOTAL_BYTES, &self.counts, number as u64 * TOTAL_BYTES);
        }
    }

    /// Counts of the last recording, available once its commands are done.
    ///
    /// # Errors
    /// If they can't be read.
    pub fn counts(&self) -> Result<IndirectCounts, VulkanError> {
        let words: &[u32] = self.counts.read(self.lists.len() * TOTALS)?;
        let mut sum = IndirectCounts::default();
        for totals in words.chunks_exact(TOTALS) {
            let of = |total: u32| u64::from(totals[total as usize]);
            sum.draws += of(spirv::TOTAL_FOUND);
            sum.triangles += of(spirv::TOTAL_TRIANGLES);
            sum.left_out += of(spirv::TOTAL_FOUND).saturating_sub(of(spirv::TOTAL_PLACED));
            sum.impossible += of(spirv::TOTAL_IMPOSSIBLE);
        }
        Ok(sum)
    }
}

fn push(geometry: &Geometry, list: &IndirectDraws, part: &IndirectPart, limits: &Limits) -> spirv::IndirectPush {
    let mesh = &geometry.meshes[list.mesh as usize];
    let flags = [
        (spirv::INDIRECT_COUNTED, list.count.is_some()),
        (spirv::INDIRECT_INDEXED, mesh.indices.is_some()),
        (spirv::INDIRECT_OBJECT, geometry.position_space != PositionSpace::Clip),
        (spirv::INDIRECT_ALPHA_TESTED, list.alpha_tested),
        (spirv::INDIRECT_DOUBLE_SIDED, list.double_sided),
    ];
    spirv::IndirectPush {
        first_command: list.lent_commands(geometry, limits).before / 4,
        command_stride: list.command_stride / 4,
        command_capacity: list.command_capacity,
        count_word: list.lent_count(limits).map_or(0, |count| count.before / 4),
        instance_capacity: list.instance_capacity,
        draw_capacity: list.draw_capacity,
        triangle_capacity: list.triangle_capacity,
        position_capacity: list.position_capacity,
        first_draw: part.first_draw,
        first_triangle: part.first_triangle,
        first_position: part.first_position,
        vertex_capacity: mesh.vertex_capacity,
        index_capacity: mesh.indices.map_or(0, |indices| indices.capacity),
        topology: list.topology as u32,
        keys: geometry.keys,
        alpha_maps: geometry.alpha_maps.len() as u32,
        flags: flags.into_iter().filter(|(_, set)| *set).map(|(flag, _)| flag).sum(),
    }
}

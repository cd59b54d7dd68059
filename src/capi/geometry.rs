//! Geometry that the application lends.

use super::error::{Error, GpcResult};
use super::input::{Element, array, choice, flag, init, unused};
use crate::host::{
    AlphaMap, ClipSpace, Coordinates, Draw, Geometry, Indices, IndirectDraws, Instance, Mesh, PositionSpace, Topology,
    VertexFormat,
};
use ash::vk;
use std::ffi::c_void;
use std::mem::offset_of;

/// Space and format of vertex positions.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcPositionSpace {
    /// Clip space, four floats: the same values as the vertex shader's gl_Position.
    Clip = 0,
    /// Object space of the draw, three numbers, floats unless `position_format` says otherwise; GpcDraw.to_clip transforms
    /// them to clip space.
    Object = 1,
}

/// Alpha map of draws. A surface exists where the map's alpha is at least `cutoff`. Filters and address modes should
/// equal those of the sampler with which the application's own pass reads the map.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcAlphaMap {
    /// Two-dimensional view of an image that was created with VK_IMAGE_USAGE_SAMPLED_BIT and holds floats or normalised
    /// numbers. The fourth component of the view is alpha; the view's swizzle can take alpha from any channel of the
    /// image.
    pub view: vk::ImageView,
    /// Width in texels, up to 65,535.
    pub width: u32,
    /// Height in texels, up to 65,535.
    pub height: u32,
    /// Number of mipmap levels, at least 1.
    pub levels: u32,
    /// Filter where texels are larger than pixels: VK_FILTER_LINEAR or VK_FILTER_NEAREST.
    pub mag_filter: vk::Filter,
    /// Filter where texels are smaller than pixels: VK_FILTER_LINEAR or VK_FILTER_NEAREST.
    pub min_filter: vk::Filter,
    /// Filter between mipmap levels: VK_SAMPLER_MIPMAP_MODE_LINEAR blends two levels, NEAREST reads the nearest level.
    pub mipmap_mode: vk::SamplerMipmapMode,
    /// Address mode along u, for coordinates outside of the image: VK_SAMPLER_ADDRESS_MODE_REPEAT, MIRRORED_REPEAT or
    /// CLAMP_TO_EDGE.
    pub address_u: vk::SamplerAddressMode,
    /// Address mode along v: the same possibilities as for u.
    pub address_v: vk::SamplerAddressMode,
    /// Smallest alpha at which the surface exists.
    pub cutoff: f32,
    /// 0.
    pub reserved: u32,
}

/// Buffers that draws read, bound together: those of one mesh, or of many meshes that share buffers. The members have
/// the same requirements as those of GpcGeometry.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcMesh {
    /// Buffer of vertex positions.
    pub positions: vk::Buffer,
    /// Offset of the first position in bytes.
    pub positions_offset: u64,
    /// Distance in bytes from one position to the next.
    pub position_stride: u32,
    /// Largest number of vertices.
    pub vertex_capacity: u32,
    /// Index buffer; ignored with VK_INDEX_TYPE_NONE_KHR.
    pub indices: vk::Buffer,
    /// Offset of the first index in bytes.
    pub indices_offset: u64,
    /// Type of the indices: VK_INDEX_TYPE_UINT16, VK_INDEX_TYPE_UINT32, or VK_INDEX_TYPE_NONE_KHR for none.
    pub index_type: vk::IndexType,
    /// Largest number of indices.
    pub index_capacity: u32,
    /// Buffer of the vertices' texture coordinates. VK_NULL_HANDLE if no draw of the mesh has an alpha map.
    pub coordinates: vk::Buffer,
    /// Offset of the first vertex's coordinates in bytes.
    pub coordinates_offset: u64,
    /// Distance in bytes from one vertex to the next.
    pub coordinates_stride: u32,
    /// 0.
    pub reserved: u32,
    /// Format of positions; VK_FORMAT_UNDEFINED stands for floats.
    pub position_format: vk::Format,
    /// Format of texture coordinates; VK_FORMAT_UNDEFINED stands for floats.
    pub coordinates_format: vk::Format,
    /// Factor on each component of a position; three zeros stand for 1.
    pub position_scale: [f32; 3],
    /// Summand of each component of a position.
    pub position_bias: [f32; 3],
}

/// Format of a vertex attribute. In C, 0 stands for floats, and for a scale of 1.
fn vertex_format(format: vk::Format, scale: [f32; 3], bias: [f32; 3]) -> VertexFormat {
    VertexFormat {
        format: if format == vk::Format::UNDEFINED { VertexFormat::FLOAT.format } else { format },
        scale: if scale == [0.0; 3] { [1.0; 3] } else { scale },
        bias,
    }
}

impl GpcMesh {
    fn mesh(&self) -> Result<Mesh, Error> {
        unused("GpcMesh.reserved", self.reserved)?;
        Ok(Mesh {
            positions: self.positions,
            positions_offset: self.positions_offset,
            position_stride: self.position_stride,
            position_format: vertex_format(self.position_format, self.position_scale, self.position_bias),
            vertex_capacity: self.vertex_capacity,
            coordinates: (self.coordinates != vk::Buffer::null()).then_some(Coordinates {
                buffer: self.coordinates,
                offset: self.coordinates_offset,
                stride: self.coordinates_stride,
                format: vertex_format(self.coordinates_format, [1.0; 3], [0.0; 3]),
            }),
            indices: (self.index_type != vk::IndexType::NONE_KHR).then_some(Indices {
                buffer: self.indices,
                offset: self.indices_offset,
                index_type: self.index_type,
                capacity: self.index_capacity,
            }),
        })
    }
}

/// Buffers and capacities of the application. The contents of the buffers may change in every frame: the library reads
/// them when a recording is executed.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcGeometry {
    /// sizeof(GpcGeometry).
    pub size: u32,
    /// GPC_STRUCT_TYPE_GEOMETRY.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Largest number of vertices. A larger index is clamped to the last vertex; in object space, to the last vertex of
    /// the draw.
    pub vertex_capacity: u32,
    /// Buffer of vertex positions, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, and with
    /// VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT too if positions are in clip space with a stride of 16 bytes. With 16-bit
    /// components, its size is a multiple of 4 bytes.
    pub positions: vk::Buffer,
    /// Offset of the first position in bytes: a multiple of the size of a component, 4 bytes for floats.
    pub positions_offset: u64,
    /// Distance in bytes from one position to the next: a multiple of the size of a component, and at least the size of a
    /// position.
    pub position_stride: u32,
    /// Space and format of positions: a GpcPositionSpace.
    pub position_space: u32,
    /// Largest total number of vertices of a recording's draws, with GPC_POSITION_SPACE_OBJECT; otherwise ignored. Vertices
    /// that several draws share count once for each draw.
    pub position_capacity: u32,
    /// Type of the indices: VK_INDEX_TYPE_UINT16 or VK_INDEX_TYPE_UINT32; VK_INDEX_TYPE_NONE_KHR without indices, so
    /// that draws read consecutive vertices, as vkCmdDraw does.
    pub index_type: vk::IndexType,
    /// Index buffer, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT; ignored with VK_INDEX_TYPE_NONE_KHR. With 16-bit
    /// indices, its size is a multiple of 4 bytes.
    pub indices: vk::Buffer,
    /// Offset of the first index in bytes: a multiple of the size of an index.
    pub indices_offset: u64,
    /// Largest number of indices.
    pub index_capacity: u32,
    /// Largest total number of triangles of a recording's draws. 0 is possible if there are indirect draws.
    pub triangle_capacity: u32,
    /// Largest number of draws of a recording. 0 is possible if there are indirect draws.
    pub draw_capacity: u32,
    /// Number of shading keys, 1 to 16,383.
    pub keys: u32,
    /// VK_TRUE if y points up in clip space, as with a viewport of negative height; VK_FALSE if y points down, Vulkan's
    /// default.
    pub y_up: vk::Bool32,
    /// VK_TRUE if depth is reversed: from 1 at the near plane to 0 at the far plane; VK_FALSE if it runs from 0 to 1.
    pub reversed_depth: vk::Bool32,
    /// Buffer of the vertices' texture coordinates, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT; ignored without alpha
    /// maps. With 16-bit components, its size is a multiple of 4 bytes.
    pub coordinates: vk::Buffer,
    /// Offset of the first vertex's coordinates in bytes: a multiple of the size of a component, 4 bytes for floats.
    pub coordinates_offset: u64,
    /// Distance in bytes from one vertex to the next: a multiple of the size of a component, at least two components.
    pub coordinates_stride: u32,
    /// Number of alpha maps.
    pub alpha_map_count: u32,
    /// sizeof(GpcAlphaMap), if there are alpha maps.
    pub alpha_map_stride: u32,
    /// VK_TRUE if draws may be blended.
    pub blended: vk::Bool32,
    /// Alpha maps of draws that are not opaque, read during the call only. The library reads their images when a
    /// frame's first recording is executed, in the layout VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, and keeps a copy of
    /// their alpha. May be NULL if there are none.
    pub alpha_maps: *const GpcAlphaMap,
    /// Meshes beyond the first, read during the call only; may be NULL if there are none. The members `positions` to
    /// `index_capacity` and `coordinates` to `coordinates_stride` are mesh 0, and the first element here is mesh 1: see
    /// GpcDraw.mesh.
    pub more_meshes: *const GpcMesh,
    /// Number of elements of `more_meshes`.
    pub more_mesh_count: u32,
    /// sizeof(GpcMesh), if there are further meshes.
    pub more_mesh_stride: u32,
    /// Value in the depth image for the clip-space depth 0: minDepth of the application's VkViewport. gpc_init_geometry
    /// sets 0.
    pub min_depth: f32,
    /// Value in the depth image for the clip-space depth 1: maxDepth of the application's VkViewport. gpc_init_geometry
    /// sets 1.
    pub max_depth: f32,
    /// Lists of draws that the device writes, in addition to the draws of a recording, with capacities of their own. Read
    /// during the call only; may be NULL if there are none.
    pub indirect_draws: *const GpcIndirectDraws,
    /// Number of elements of `indirect_draws`.
    pub indirect_draws_count: u32,
    /// sizeof(GpcIndirectDraws), if there are lists of indirect draws.
    pub indirect_draws_stride: u32,
    /// Format of positions with GPC_POSITION_SPACE_OBJECT: three components or more, of 32-bit SFLOAT, or of 16-bit SFLOAT,
    /// UNORM or SNORM. VK_FORMAT_UNDEFINED, as gpc_init_geometry sets it, stands for floats.
    pub position_format: vk::Format,
    /// Format of texture coordinates: two components or more, of these types. VK_FORMAT_UNDEFINED stands for floats.
    pub coordinates_format: vk::Format,
    /// Factor on each component of a position; three zeros, as gpc_init_geometry sets them, stand for 1. A component is
    /// bias + scale * number, where UNORM and SNORM divide the integer by 65,535 and 32,767.
    pub position_scale: [f32; 3],
    /// Summand of each component of a position.
    pub position_bias: [f32; 3],
}

/// Fills a GpcGeometry of `size` bytes, which is sizeof(GpcGeometry): without buffers, with one shading
/// key, positions in clip space, 16-bit indices, and depth from 0 to 1.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_geometry(geometry: *mut GpcGeometry, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(geometry, size) }
}

impl GpcAlphaMap {
    fn alpha_map(&self) -> Result<AlphaMap, Error> {
        unused("GpcAlphaMap.reserved", self.reserved)?;
        Ok(AlphaMap {
            view: self.view,
            size: [self.width, self.height],
            levels: self.levels,
            mag_filter: self.mag_filter,
            min_filter: self.min_filter,
            mipmap_mode: self.mipmap_mode,
            address: [self.address_u, self.address_v],
            cutoff: self.cutoff,
        })
    }
}

impl GpcGeometry {
    /// What gpc_init_geometry sets.
    pub(super) fn initial() -> Self {
        Self { keys: 1, max_depth: 1.0, ..Self::zeroed() }
    }

    /// Mesh 0, from the members of this struct.
    fn own_mesh(&self) -> Result<Mesh, Error> {
        let mesh = GpcMesh {
            positions: self.positions,
            positions_offset: self.positions_offset,
            position_stride: self.position_stride,
            vertex_capacity: self.vertex_capacity,
            indices: self.indices,
            indices_offset: self.indices_offset,
            index_type: self.index_type,
            index_capacity: self.index_capacity,
            coordinates: self.coordinates,
            coordinates_offset: self.coordinates_offset,
            coordinates_stride: self.coordinates_stride,
            reserved: 0,
            position_format: self.position_format,
            coordinates_format: self.coordinates_format,
            position_scale: self.position_scale,
            position_bias: self.position_bias,
        };
        mesh.mesh()
    }

    /// # Safety
    /// `alpha_maps`, `more_meshes` and `indirect_draws` point to as many elements as their counts say.
    pub(super) unsafe fn geometry(&self) -> Result<Geometry, Error> {
        // SAFETY: passed on to the caller.
        let maps = unsafe { array!(self, GpcGeometry, alpha_maps, alpha_map_count, alpha_map_stride) }?;
        let spaces = [
            (GpcPositionSpace::Clip as u32, "GPC_POSITION_SPACE_CLIP", PositionSpace::Clip),
            (
                GpcPositionSpace::Object as u32,
                "GPC_POSITION_SPACE_OBJECT",
                PositionSpace::Object { capacity: self.position_capacity },
            ),
        ];
        // SAFETY: passed on to the caller.
        let more_meshes = unsafe { array!(self, GpcGeometry, more_meshes, more_mesh_count, more_mesh_stride) }?;
        // SAFETY: passed on to the caller.
        let indirect =
            unsafe { array!(self, GpcGeometry, indirect_draws, indirect_draws_count, indirect_draws_stride) }?;
        Ok(Geometry {
            meshes: std::iter::once(self.own_mesh())
                .chain(more_meshes.iter().map(GpcMesh::mesh))
                .collect::<Result<_, _>>()?,
            position_space: choice("GpcGeometry.position_space", self.position_space, &spaces)?,
            indirect: indirect.iter().map(GpcIndirectDraws::list).collect::<Result<_, _>>()?,
            triangle_capacity: self.triangle_capacity,
            draw_capacity: self.draw_capacity,
            keys: self.keys,
            alpha_maps: maps.iter().map(GpcAlphaMap::alpha_map).collect::<Result<_, _>>()?,
            blended: flag("GpcGeometry.blended", self.blended)?,
            clip: ClipSpace {
                y_up: flag("GpcGeometry.y_up", self.y_up)?,
                reversed_depth: flag("GpcGeometry.reversed_depth", self.reversed_depth)?,
                depth_range: [self.min_depth, self.max_depth],
            },
        })
    }
}

/// Primitive topology of a draw: how consecutive corners (indices, or vertices without indices) form triangles.
/// Primitive restart is not supported: a draw is a single strip or fan.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcTopology {
    /// As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST: every three corners form a triangle.
    List = 0,
    /// As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP: each corner from the third on forms a triangle with the two before it.
    Strip = 1,
    /// As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN: each corner from the third on forms a triangle with the one before it and
    /// the first.
    Fan = 2,
}

/// Topology for its number in C, which the member `name` has.
fn topology(name: &'static str, found: u32) -> Result<Topology, Error> {
    let topologies = [
        (GpcTopology::List as u32, "GPC_TOPOLOGY_LIST", Topology::List),
        (GpcTopology::Strip as u32, "GPC_TOPOLOGY_STRIP", Topology::Strip),
        (GpcTopology::Fan as u32, "GPC_TOPOLOGY_FAN", Topology::Fan),
    ];
    choice(name, found, &topologies)
}

/// List of draws that the device writes, with the arguments of vkCmdDrawIndexedIndirect or, for a mesh without indices, of
/// vkCmdDrawIndirect, and with capacities. The library reads the list when a recording is executed, so that compute shaders
/// before, in the same command buffer, may decide what is drawn.
///
/// Each instance of a command is a draw. Its number, firstInstance and on, which is gl_InstanceIndex of a vertex shader, is
/// the index of its GpcInstance. All draws of a list have the state of one pipeline. Set members that are not used to 0.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcIndirectDraws {
    /// Buffer of commands, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT.
    pub commands: vk::Buffer,
    /// Offset of the first command in bytes: a multiple of 4.
    pub commands_offset: u64,
    /// Buffer with the number of commands, a 32-bit word, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT. With
    /// VK_NULL_HANDLE the number is `command_capacity`.
    pub count: vk::Buffer,
    /// Offset of the number of commands in bytes: a multiple of 4.
    pub count_offset: u64,
    /// Buffer of the instances, an array of GpcInstance, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT.
    pub instances: vk::Buffer,
    /// Offset of the first instance in bytes: a multiple of 256, or of the device's minStorageBufferOffsetAlignment and 16.
    pub instances_offset: u64,
    /// Distance in bytes from one command to the next: a multiple of 4, at least the size of a command.
    pub command_stride: u32,
    /// Largest number of commands, up to 1,048,576.
    pub command_capacity: u32,
    /// Number of instances in the buffer.
    pub instance_capacity: u32,
    /// Largest number of draws: instances of all commands.
    pub draw_capacity: u32,
    /// Largest number of triangles of all draws.
    pub triangle_capacity: u32,
    /// Largest number of vertices of all draws, with GPC_POSITION_SPACE_OBJECT; otherwise ignored.
    pub position_capacity: u32,
    /// Mesh whose buffers the draws read: see GpcDraw.mesh.
    pub mesh: u32,
    /// Topology of the draws: a GpcTopology.
    pub topology: u32,
    /// Orientation of front faces in the image: see GpcDraw.front_face.
    pub front_face: vk::FrontFace,
    /// VK_TRUE if back faces are visible.
    pub double_sided: vk::Bool32,
    /// VK_TRUE if the draws have alpha maps.
    pub alpha_tested: vk::Bool32,
    /// VK_TRUE if the draws are blended.
    pub blended: vk::Bool32,
}

/// What a draw of a GpcIndirectDraws has besides its command: an element of a buffer that the device reads, and never
/// changes. gpc_instance.glsl declares the same structure for shaders.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcInstance {
    /// Matrix from object space to clip space, by columns, with GPC_POSITION_SPACE_OBJECT; otherwise ignored.
    pub to_clip: [[f32; 4]; 4],
    /// Number of vertices from the command's vertexOffset or firstVertex on, with GPC_POSITION_SPACE_OBJECT.
    pub vertex_count: u32,
    /// Shading key.
    pub key: u32,
    /// Number of the application's choice, which its shaders can read. Triangles with the same lower 16 bits are assumed to
    /// look alike: see GpcDraw.material.
    pub material: u32,
    /// 1 + the index of the alpha map, if the draws of the list have alpha maps; otherwise 0.
    pub alpha_map: u32,
    /// 1 if the colour may vary within a pixel, otherwise 0.
    pub detailed: u32,
    /// 0.
    pub reserved: [u32; 3],
}

// Buffers of both hold the same.
const _: () = {
    assert!(size_of::<GpcInstance>() == size_of::<Instance>());
    assert!(offset_of!(GpcInstance, to_clip) == offset_of!(Instance, to_clip));
    assert!(offset_of!(GpcInstance, vertex_count) == offset_of!(Instance, vertex_count));
    assert!(offset_of!(GpcInstance, key) == offset_of!(Instance, key));
    assert!(offset_of!(GpcInstance, material) == offset_of!(Instance, material));
    assert!(offset_of!(GpcInstance, alpha_map) == offset_of!(Instance, alpha_map));
    assert!(offset_of!(GpcInstance, detailed) == offset_of!(Instance, detailed));
    assert!(offset_of!(GpcInstance, reserved) == offset_of!(Instance, reserved));
};

impl GpcIndirectDraws {
    fn list(&self) -> Result<IndirectDraws, Error> {
        Ok(IndirectDraws {
            commands: self.commands,
            commands_offset: self.commands_offset,
            command_stride: self.command_stride,
            command_capacity: self.command_capacity,
            count: (self.count != vk::Buffer::null()).then_some((self.count, self.count_offset)),
            instances: self.instances,
            instances_offset: self.instances_offset,
            instance_capacity: self.instance_capacity,
            draw_capacity: self.draw_capacity,
            triangle_capacity: self.triangle_capacity,
            position_capacity: self.position_capacity,
            mesh: self.mesh,
            topology: topology("GpcIndirectDraws.topology", self.topology)?,
            front_face: self.front_face,
            double_sided: flag("GpcIndirectDraws.double_sided", self.double_sided)?,
            alpha_tested: flag("GpcIndirectDraws.alpha_tested", self.alpha_tested)?,
            blended: flag("GpcIndirectDraws.blended", self.blended)?,
        })
    }
}

/// A run of triangles that are shaded alike.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcDraw {
    /// First index of the draw. For a mesh without indices: its first vertex, counted from `vertex_offset`.
    pub first_index: u32,
    /// Number of triangles.
    pub triangle_count: u32,
    /// Offset that is added to each index.
    pub vertex_offset: i32,
    /// Number of vertices from `vertex_offset` on, with GPC_POSITION_SPACE_OBJECT; otherwise ignored. An index beyond
    /// the last of these vertices is clamped to the last one.
    pub vertex_count: u32,
    /// Matrix from object space to clip space, by columns, with GPC_POSITION_SPACE_OBJECT; otherwise ignored.
    pub to_clip: [[f32; 4]; 4],
    /// 1 + the index of the alpha map of the alpha test; 0 for a surface without holes. Draws with alpha maps come
    /// after those without.
    pub alpha_map: u32,
    /// Shading key: the number of the application's pipeline that shades the draw, from 0.
    pub key: u32,
    /// Material number of the application's choice, up to 65,535, which its shaders can read. Triangles with the same
    /// number are assumed to look alike where the surrounding colours decide in how many parts `detailed` ones are
    /// shaded. Draws with alpha maps are told apart by their maps instead.
    pub material: u32,
    /// VK_TRUE if back faces are visible. `front_face` says which faces these are.
    pub double_sided: vk::Bool32,
    /// VK_TRUE if the colour may vary within a pixel, for example because of a texture or a glossy surface. If so, the
    /// draw is shaded in several parts of a superpixel wherever the surrounding pixels vary in colour.
    pub detailed: vk::Bool32,
    /// VK_TRUE if the draw is translucent. The application's shaders then store an opacity, with which the draw is
    /// composited over the surfaces behind it. Blended draws have no alpha map and come after all others. They require
    /// GpcGeometry.blended.
    pub blended: vk::Bool32,
    /// Mesh whose buffers the draw reads: 0 for the buffers of GpcGeometry itself, n for GpcGeometry.more_meshes[n -
    /// 1].
    pub mesh: u32,
    /// Topology: how indices, or vertices without indices, form triangles: a GpcTopology.
    pub topology: u32,
    /// Orientation of front faces in the image: frontFace of the application's pipeline. 0 is
    /// VK_FRONT_FACE_COUNTER_CLOCKWISE.
    pub front_face: vk::FrontFace,
}

impl GpcDraw {
    pub(super) fn draw(&self) -> Result<Draw, Error> {
        Ok(Draw {
            mesh: self.mesh,
            first_index: self.first_index,
            triangle_count: self.triangle_count,
            topology: topology("GpcDraw.topology", self.topology)?,
            vertex_offset: self.vertex_offset,
            vertex_count: self.vertex_count,
            to_clip: self.to_clip,
            alpha_map: match self.alpha_map {
                0 => None,
                number => Some(u16::try_from(number - 1).map_err(|_| Error::Value {
                    name: "GpcDraw.alpha_map",
                    found: number,
                    possible: "0 to 65536".to_owned(),
                })?),
            },
            key: self.key,
            material: u16::try_from(self.material).map_err(|_| Error::Value {
                name: "GpcDraw.material",
                found: self.material,
                possible: "0 to 65535".to_owned(),
            })?,
            double_sided: flag("GpcDraw.double_sided", self.double_sided)?,
            front_face: self.front_face,
            detailed: flag("GpcDraw.detailed", self.detailed)?,
            blended: flag("GpcDraw.blended", self.blended)?,
        })
    }
}

//! Triangles that the application lends.

use super::error::{Error, GpcResult};
use super::input::{Element, GpcStructType, Struct, choice, elements, flag, init, sizes};
use crate::host::{
    AlphaMap, ClipSpace, Coordinates, Draw, Geometry, Indices, Mesh, PositionSpace, Topology,
};
use ash::vk;
use std::ffi::c_void;

/// What positions are.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcPositionSpace {
    /// Four floats in clip space: the very values of the vertex shader's gl_Position.
    Clip = 0,
    /// Three floats in a space of each draw's own, from which GpcDraw.to_clip leads to clip space.
    Object = 1,
}

/// What a draw's alpha is tested by: a surface is there where the map's alpha is at least the cutoff. Filters and address
/// modes are best those of the sampler that the application's own pass reads the map with.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcAlphaMap {
    /// A two-dimensional view of an image made with VK_IMAGE_USAGE_SAMPLED_BIT, of floats or normalised numbers. Its fourth
    /// component is alpha; that of a view may be any of the image.
    pub view: vk::ImageView,
    /// Width in texels, up to 65,535.
    pub width: u32,
    /// Height in texels, up to 65,535.
    pub height: u32,
    /// How many mipmap levels there are; 1 for none.
    pub levels: u32,
    /// How alpha lies between texels that are larger than pixels: VK_FILTER_LINEAR or NEAREST.
    pub mag_filter: vk::Filter,
    /// The same where texels are smaller.
    pub min_filter: vk::Filter,
    /// Whether alpha is that of two levels, blended (VK_SAMPLER_MIPMAP_MODE_LINEAR), or of the nearest one (NEAREST).
    pub mipmap_mode: vk::SamplerMipmapMode,
    /// What is beyond the image along u: VK_SAMPLER_ADDRESS_MODE_REPEAT, MIRRORED_REPEAT or CLAMP_TO_EDGE.
    pub address_u: vk::SamplerAddressMode,
    /// The same along v.
    pub address_v: vk::SamplerAddressMode,
    /// The least alpha that is there.
    pub cutoff: f32,
    /// 0.
    pub reserved: u32,
}

// SAFETY: `repr(C)`; numbers and raw handles may have any bytes.
unsafe impl Element for GpcAlphaMap {
    const NAME: &'static str = "GpcAlphaMap";
    const SIZES: &'static [usize] = sizes!(GpcAlphaMap, reserved);
}

/// Buffers that draws read, as they are bound for them: those of a mesh, or of many meshes. Members are as those of GpcGeometry.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcMesh {
    /// Positions of vertices.
    pub positions: vk::Buffer,
    /// Where the first one is, in bytes.
    pub positions_offset: u64,
    /// Bytes from one to the next.
    pub position_stride: u32,
    /// How many vertices there can be.
    pub vertex_capacity: u32,
    /// Indices; ignored with VK_INDEX_TYPE_NONE_KHR.
    pub indices: vk::Buffer,
    /// Where they begin, in bytes.
    pub indices_offset: u64,
    /// VK_INDEX_TYPE_UINT16, VK_INDEX_TYPE_UINT32, or VK_INDEX_TYPE_NONE_KHR.
    pub index_type: vk::IndexType,
    /// How many indices there can be.
    pub index_capacity: u32,
    /// Texture coordinates of the vertices. VK_NULL_HANDLE where no draw of them has an alpha map.
    pub coordinates: vk::Buffer,
    /// Where those of the first vertex are, in bytes.
    pub coordinates_offset: u64,
    /// Bytes from one vertex to the next.
    pub coordinates_stride: u32,
    /// 0.
    pub reserved: u32,
}

// SAFETY: `repr(C)`; numbers and raw handles may have any bytes.
unsafe impl Element for GpcMesh {
    const NAME: &'static str = "GpcMesh";
    const SIZES: &'static [usize] = sizes!(GpcMesh, reserved);
}

impl GpcMesh {
    fn mesh(&self) -> Mesh {
        Mesh {
            positions: self.positions,
            positions_offset: self.positions_offset,
            position_stride: self.position_stride,
            vertex_capacity: self.vertex_capacity,
            coordinates: (self.coordinates != vk::Buffer::null()).then_some(Coordinates {
                buffer: self.coordinates,
                offset: self.coordinates_offset,
                stride: self.coordinates_stride,
            }),
            indices: (self.index_type != vk::IndexType::NONE_KHR).then_some(Indices {
                buffer: self.indices,
                offset: self.indices_offset,
                index_type: self.index_type,
                capacity: self.index_capacity,
            }),
        }
    }
}

/// Buffers of the application. They may hold something else in every frame; the library reads them when a recording is
/// executed.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcGeometry {
    /// sizeof(GpcGeometry).
    pub size: u32,
    /// GPC_STRUCT_TYPE_GEOMETRY.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// How many vertices there can be. Larger indices are taken for the last, or in object space for the last of the draw.
    pub vertex_capacity: u32,
    /// Positions of vertices, made with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT; where they lie in clip space and 16 bytes apart,
    /// with VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT too.
    pub positions: vk::Buffer,
    /// Where the first one is, in bytes: a multiple of 4.
    pub positions_offset: u64,
    /// Bytes from one to the next: a multiple of 4, and at least those of a position.
    pub position_stride: u32,
    /// What they are: a GpcPositionSpace.
    pub position_space: u32,
    /// With GPC_POSITION_SPACE_OBJECT, most vertices of all draws of a frame, those that several draws have counted for each.
    /// Otherwise ignored.
    pub position_capacity: u32,
    /// VK_INDEX_TYPE_UINT16 or VK_INDEX_TYPE_UINT32; VK_INDEX_TYPE_NONE_KHR if there are no indices, so that draws take vertices in
    /// their order, as vkCmdDraw does.
    pub index_type: vk::IndexType,
    /// Indices. Made with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT. The buffer of those of 16 bits reaches to a multiple of 4 bytes.
    /// Ignored with VK_INDEX_TYPE_NONE_KHR.
    pub indices: vk::Buffer,
    /// Where they begin, in bytes: a multiple of an index's size.
    pub indices_offset: u64,
    /// How many indices there can be.
    pub index_capacity: u32,
    /// Most triangles of all draws of a frame.
    pub triangle_capacity: u32,
    /// Most draws of a frame.
    pub draw_capacity: u32,
    /// How many shading keys there are, 1 to 16,383.
    pub keys: u32,
    /// VK_TRUE if y points up in clip space, as with a viewport of negative height; VK_FALSE if down, as Vulkan has it.
    pub y_up: vk::Bool32,
    /// VK_TRUE if depth runs from 1 near to 0 far; VK_FALSE if from 0 to 1.
    pub reversed_depth: vk::Bool32,
    /// Where there are alpha maps, texture coordinates of the vertices, two floats each. Made with
    /// VK_BUFFER_USAGE_STORAGE_BUFFER_BIT. Otherwise ignored.
    pub coordinates: vk::Buffer,
    /// Where those of the first vertex are, in bytes: a multiple of 4.
    pub coordinates_offset: u64,
    /// Bytes from one vertex to the next: a multiple of 4, at least 8.
    pub coordinates_stride: u32,
    /// How many alpha maps there are.
    pub alpha_map_count: u32,
    /// sizeof(GpcAlphaMap), where there are some.
    pub alpha_map_stride: u32,
    /// VK_TRUE if draws may be blended.
    pub blended: vk::Bool32,
    /// What draws are tested by that are not opaque, read during the call alone. The library reads the images, in
    /// VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, when a frame's first recording is executed, and keeps what they hold then. May
    /// be NULL where there are none.
    pub alpha_maps: *const GpcAlphaMap,
    /// Further buffers that draws may read, read during the call alone. The members `positions` to `index_capacity` and
    /// `coordinates` to `coordinates_stride` are mesh 0, the first of these is mesh 1: see GpcDraw.mesh. May be NULL where there are
    /// none.
    pub more_meshes: *const GpcMesh,
    /// How many there are.
    pub more_mesh_count: u32,
    /// sizeof(GpcMesh), where there are some.
    pub more_mesh_stride: u32,
    /// What the image of depth holds where depth in clip space is 0: minDepth of the application's VkViewport. gpc_init_geometry
    /// gives 0.
    pub min_depth: f32,
    /// The same where it is 1: maxDepth. gpc_init_geometry gives 1.
    pub max_depth: f32,
}

// SAFETY: `repr(C)`; integers, raw handles and pointers may have any bytes.
unsafe impl Element for GpcGeometry {
    const NAME: &'static str = "GpcGeometry";
    const SIZES: &'static [usize] = sizes!(GpcGeometry, alpha_maps, max_depth);

    fn defaults() -> Self {
        Self {
            keys: 1,
            max_depth: 1.0,
            // SAFETY: any bytes are a value of it.
            ..unsafe { std::mem::zeroed() }
        }
    }
}

// SAFETY: it begins with size, type and next.
unsafe impl Struct for GpcGeometry {
    const TYPE: GpcStructType = GpcStructType::Geometry;
}

/// Fills a GpcGeometry of `size` bytes, which is sizeof(GpcGeometry): nothing is lent, and there is one
/// shading key.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_geometry(geometry: *mut GpcGeometry, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(geometry, size) }
}

impl GpcAlphaMap {
    fn alpha_map(&self) -> AlphaMap {
        AlphaMap {
            view: self.view,
            size: [self.width, self.height],
            levels: self.levels,
            mag_filter: self.mag_filter,
            min_filter: self.min_filter,
            mipmap_mode: self.mipmap_mode,
            address: [self.address_u, self.address_v],
            cutoff: self.cutoff,
        }
    }
}

impl GpcGeometry {
    /// Mesh 0.
    fn own_mesh(&self) -> Mesh {
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
        };
        mesh.mesh()
    }

    /// # Safety
    /// `alpha_maps` and `more_meshes` show as many as are counted.
    pub(super) unsafe fn geometry(&self) -> Result<Geometry, Error> {
        // SAFETY: passed on to the caller.
        let maps = unsafe {
            elements(
                self.alpha_maps,
                (self.alpha_map_count, self.alpha_map_stride),
                ("GpcGeometry.alpha_maps", "GpcGeometry.alpha_map_stride"),
            )
        }?;
        let spaces = [
            (
                GpcPositionSpace::Clip as u32,
                "GPC_POSITION_SPACE_CLIP",
                PositionSpace::Clip,
            ),
            (
                GpcPositionSpace::Object as u32,
                "GPC_POSITION_SPACE_OBJECT",
                PositionSpace::Object {
                    capacity: self.position_capacity,
                },
            ),
        ];
        // SAFETY: passed on to the caller.
        let more_meshes = unsafe {
            elements(
                self.more_meshes,
                (self.more_mesh_count, self.more_mesh_stride),
                ("GpcGeometry.more_meshes", "GpcGeometry.more_mesh_stride"),
            )
        }?;
        Ok(Geometry {
            meshes: std::iter::once(self.own_mesh())
                .chain(more_meshes.iter().map(GpcMesh::mesh))
                .collect(),
            position_space: choice("GpcGeometry.position_space", self.position_space, &spaces)?,
            triangle_capacity: self.triangle_capacity,
            draw_capacity: self.draw_capacity,
            keys: self.keys,
            alpha_maps: maps.iter().map(GpcAlphaMap::alpha_map).collect(),
            blended: flag("GpcGeometry.blended", self.blended)?,
            clip: ClipSpace {
                y_up: flag("GpcGeometry.y_up", self.y_up)?,
                reversed_depth: flag("GpcGeometry.reversed_depth", self.reversed_depth)?,
                depth_range: [self.min_depth, self.max_depth],
            },
        })
    }
}

/// How the corners of a draw make triangles: which of its indices, or of its vertices where there are none, belong to which.
/// Primitive restart is not known: a draw is one strip or fan.
#[derive(Clone, Copy)]
#[repr(u32)]
pub enum GpcTopology {
    /// As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST: each three make one.
    List = 0,
    /// As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP: each one from the third on makes one with the two before it.
    Strip = 1,
    /// As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN: each one from the third on makes one with the one before it and the first.
    Fan = 2,
}

/// A run of triangles that are shaded alike.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcDraw {
    /// Its first index; of a mesh without indices, its first vertex, counted from `vertex_offset`.
    pub first_index: u32,
    /// How many triangles it has.
    pub triangle_count: u32,
    /// Added to each of its indices.
    pub vertex_offset: i32,
    /// With GPC_POSITION_SPACE_OBJECT, how many vertices it has, from `vertex_offset` on. Larger indices are taken for the
    /// last. Otherwise ignored.
    pub vertex_count: u32,
    /// With GPC_POSITION_SPACE_OBJECT, the matrix that leads from there to clip space, in columns. Otherwise ignored.
    pub to_clip: [[f32; 4]; 4],
    /// 1 + the index of the alpha map that says where it is, 0 where it is everywhere. Draws with alpha maps come after those
    /// without.
    pub alpha_map: u32,
    /// The shading key, from 0: which of the application's pipelines shades it.
    pub key: u32,
    /// A number of the application's, up to 65,535, which its shaders see. Triangles of one number are taken to look alike
    /// where detection compares colours.
    pub material: u32,
    /// VK_TRUE if back faces show. A front face is counter-clockwise on the screen.
    pub double_sided: vk::Bool32,
    /// VK_TRUE if light or paint may change within a pixel, as with a texture or a glossy surface: it is then shaded in
    /// several parts of a superpixel where the pixels around tell that it does.
    pub detailed: vk::Bool32,
    /// VK_TRUE if it is seen through: what the application's shading stores has an opacity then, and is composited over what
    /// lies behind. Such draws have no alpha map and come after all others; GpcGeometry.blended says that there may be some.
    pub blended: vk::Bool32,
    /// The buffers that it reads: 0 for those of GpcGeometry itself, n for GpcGeometry.more_meshes[n - 1].
    pub mesh: u32,
    /// How its indices, or its vertices, make triangles: a GpcTopology.
    pub topology: u32,
}

// SAFETY: `repr(C)`; numbers may have any bytes.
unsafe impl Element for GpcDraw {
    const NAME: &'static str = "GpcDraw";
    const SIZES: &'static [usize] = sizes!(GpcDraw, blended, topology);
}

impl GpcDraw {
    /// Draws that the member `draws` of a struct shows; `names` are that member and its stride.
    ///
    /// # Safety
    /// The pointer is null, or shows so many draws of so many bytes.
    pub(super) unsafe fn all(
        draws: *const Self,
        counts: (u32, u32),
        names: (&'static str, &'static str),
    ) -> Result<Vec<Draw>, Error> {
        // SAFETY: passed on to the caller.
        let draws = unsafe { elements(draws, counts, names) }?;
        draws.iter().map(Self::draw).collect()
    }

    fn draw(&self) -> Result<Draw, Error> {
        let topologies = [
            (
                GpcTopology::List as u32,
                "GPC_TOPOLOGY_LIST",
                Topology::List,
            ),
            (
                GpcTopology::Strip as u32,
                "GPC_TOPOLOGY_STRIP",
                Topology::Strip,
            ),
            (GpcTopology::Fan as u32, "GPC_TOPOLOGY_FAN", Topology::Fan),
        ];
        Ok(Draw {
            mesh: self.mesh,
            first_index: self.first_index,
            triangle_count: self.triangle_count,
            topology: choice("GpcDraw.topology", self.topology, &topologies)?,
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
            detailed: flag("GpcDraw.detailed", self.detailed)?,
            blended: flag("GpcDraw.blended", self.blended)?,
        })
    }
}

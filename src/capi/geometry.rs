//! Triangles that the application lends.

use super::error::Error;
use super::input::{Struct, flag};
use crate::host::{ClipSpace, Draw, Geometry};
use ash::vk;

/// Buffers of the application. They may hold something else in every frame; the library reads them when a recording is
/// executed.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcGeometry {
    /// sizeof(GpcGeometry).
    pub size: u32,
    /// How many positions there can be. Larger indices are taken for the last.
    pub vertex_capacity: u32,
    /// Positions in clip space, four floats each, tightly packed: the very values of the vertex shader's gl_Position. Made
    /// with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT and VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT.
    pub positions: vk::Buffer,
    /// Where they begin, in bytes: a multiple of 16 and of the device's minStorageBufferOffsetAlignment and
    /// minTexelBufferOffsetAlignment.
    pub positions_offset: u64,
    /// Indices of 32 bits, three a triangle. Made with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT.
    pub indices: vk::Buffer,
    /// Where they begin, in bytes: a multiple as above.
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
}

// SAFETY: `repr(C)`, its size first; integers and raw handles may have any bytes.
unsafe impl Struct for GpcGeometry {
    const NAME: &'static str = "GpcGeometry";
}

impl GpcGeometry {
    pub(super) fn geometry(&self) -> Result<Geometry, Error> {
        Ok(Geometry {
            positions: self.positions,
            positions_offset: self.positions_offset,
            vertex_capacity: self.vertex_capacity,
            indices: self.indices,
            indices_offset: self.indices_offset,
            index_capacity: self.index_capacity,
            triangle_capacity: self.triangle_capacity,
            draw_capacity: self.draw_capacity,
            keys: self.keys,
            clip: ClipSpace {
                y_up: flag("GpcGeometry.y_up", self.y_up)?,
                reversed_depth: flag("GpcGeometry.reversed_depth", self.reversed_depth)?,
            },
        })
    }
}

/// A run of triangles that are shaded alike.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcDraw {
    /// Its first index.
    pub first_index: u32,
    /// How many triangles it has.
    pub triangle_count: u32,
    /// Added to each of its indices.
    pub vertex_offset: i32,
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
}

impl GpcDraw {
    pub(super) fn draw(&self) -> Result<Draw, Error> {
        Ok(Draw {
            first_index: self.first_index,
            triangle_count: self.triangle_count,
            vertex_offset: self.vertex_offset,
            key: self.key,
            material: u16::try_from(self.material).map_err(|_| Error::Value {
                name: "GpcDraw.material",
                found: self.material,
                possible: "0 to 65535".to_owned(),
            })?,
            double_sided: flag("GpcDraw.double_sided", self.double_sided)?,
            detailed: flag("GpcDraw.detailed", self.detailed)?,
        })
    }
}

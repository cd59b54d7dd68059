//! Triangles of a host in the form that passes read.

use super::Geometry;
use super::alpha::Alpha;
use crate::engine::data::Content;
use crate::engine::pipelines::FrameLayout;
use crate::engine::spirv::frame_set;
use crate::vulkan::{BoundDescriptor, Buffer, Memory, MemoryUse, TexelBuffer, TexelView, VulkanError};
use ash::vk;

/// Positions in clip space.
enum Positions {
    /// Positions in the host's buffer, read in place.
    Lent { texels: TexelView, info: vk::DescriptorBufferInfo },
    /// Positions that `transform` writes.
    Made(TexelBuffer),
}

/// A host's triangles, with placeholders for data that hosts don't have.
pub(super) struct HostContent {
    triangles: TexelBuffer,
    draw_of: Buffer,
    positions: Positions,
    alpha: Option<Alpha>,
    /// Placeholders for attributes and materials, which no pass reads for a host's triangles.
    unread_floats: TexelBuffer,
    unread_words: TexelBuffer,
    triangle_capacity: u32,
    keys: u32,
    blended: bool,
}

impl HostContent {
    /// # Safety
    /// The host's buffer of positions and the views of its alpha maps are as [`Geometry`] says, and outlive the returned value.
    pub unsafe fn new(layout: &FrameLayout, memory: &Memory, geometry: &Geometry) -> Result<Self, VulkanError> {
        let float4 = vk::Format::R32G32B32A32_SFLOAT;
        let uint4 = vk::Format::R32G32B32A32_UINT;
        let usage = vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER | vk::BufferUsageFlags::STORAGE_BUFFER;
        let texels = |name, elements, format| memory.texel_buffer(name, elements, format, usage, MemoryUse::Device);
        let triangles = geometry.all_triangles();
        let (gpu, limits) = (&layout.gpu, layout.gpu.limits());
        let read_in_place = geometry.meshes.first();
        let read_in_place = read_in_place.filter(|_| geometry.is_read_in_place(limits));
        let positions = if let Some(mesh) = read_in_place {
            let info = mesh.lent_positions(geometry.position_space, limits).info();
            let (buffer, offset, bytes) = (info.buffer, info.offset, info.range);
            Positions::Lent {
                // SAFETY: passed on to the caller.
                texels: unsafe { TexelView::new(gpu, buffer, float4, offset, bytes) }?,
                info,
            }
        } else {
            let positions = geometry.all_positions();
            Positions::Made(texels("positions", positions, float4)?)
        };
        // SAFETY: passed on to the caller.
        let alpha = || unsafe { Alpha::new(layout, memory, geometry) };
        Ok(Self {
            triangles: texels("triangles", triangles, uint4)?,
            draw_of: memory.storage_buffer("draws of triangles", 4 * triangles, usage, MemoryUse::Device)?,
            positions,
            alpha: (!geometry.alpha_maps.is_empty()).then(alpha).transpose()?,
            unread_floats: texels("unread vectors", 1, float4)?,
            unread_words: texels("unread words", 1, uint4)?,
            triangle_capacity: triangles as u32,
            keys: geometry.keys,
            blended: geometry.blended,
        })
    }

    pub fn triangles(&self) -> &Buffer {
        &self.triangles.buffer
    }

    /// Index of each triangle's draw.
    pub fn draw_of(&self) -> &Buffer {
        &self.draw_of
    }

    /// Alpha maps, if there are any.
    pub fn alpha(&self) -> Option<&Alpha> {
        self.alpha.as_ref()
    }

    /// Positions in clip space.
    pub fn positions_info(&self) -> vk::DescriptorBufferInfo {
        match &self.positions {
            Positions::Lent { info, .. } => *info,
            Positions::Made(made) => {
                vk::DescriptorBufferInfo::default().buffer(made.buffer.handle()).range(vk::WHOLE_SIZE)
            }
        }
    }

    /// Buffer into which `transform` writes positions; `None` if positions are read in place.
    pub fn made_positions(&self) -> Option<&Buffer> {
        match &self.positions {
            Positions::Lent { .. } => None,
            Positions::Made(made) => Some(&made.buffer),
        }
    }

    /// Bindings of `shaders/include/frame.glsl` that show a host's triangles to the passes.
    pub fn shown(&self) -> Vec<BoundDescriptor> {
        let positions = match &self.positions {
            Positions::Lent { texels, .. } => texels.texels(),
            Positions::Made(made) => made.texels(),
        };
        let (floats, words) = (self.unread_floats.texels(), self.unread_words.texels());
        let alpha = self.alpha.as_ref();
        let coordinates = alpha.map_or(floats, |alpha| alpha.coordinates.texels());
        [
            (frame_set::POSITIONS, positions),
            (frame_set::TRIANGLES, self.triangles.texels()),
            (frame_set::NORMALS, floats),
            (frame_set::UVS, coordinates),
            (frame_set::COLORS, coordinates),
            (frame_set::MATERIALS, alpha.map_or(words, |alpha| alpha.rows.texels())),
            (frame_set::ALPHA_ATLAS, alpha.map_or(words, |alpha| alpha.atlas.texels())),
            (frame_set::INSTANCE_OF, words),
            (frame_set::INSTANCES, words),
        ]
        .map(|(binding, texels)| (binding, texels.into()))
        .to_vec()
    }
}

impl Content for HostContent {
    fn triangle_slots(&self) -> u32 {
        self.triangle_capacity
    }

    fn is_instanced(&self) -> bool {
        false
    }

    fn has_mask(&self) -> bool {
        self.alpha.is_some()
    }

    fn has_blend(&self) -> bool {
        self.blended
    }

    fn has_high_frequency(&self) -> bool {
        true
    }

    fn is_tinted(&self) -> bool {
        false
    }

    /// Number of shading keys: the host's, and one more, because visibility samples with a single key would not be
    /// sorted into lists.
    fn bin_count(&self) -> u32 {
        self.keys + 1
    }
}

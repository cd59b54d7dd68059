//! Moving vertices. Their positions at rest belong to the scene; their positions at a moment, or for a camera, belong
//! to a frame.

use super::GpuGeometry;
use crate::engine::data::upload::Uploader;
use crate::engine::spirv;
use crate::scene::{Edge, Moment, Motion, MotionPart, Stroke};
use crate::vulkan::{Memory, MemoryUse, Recorder, TexelBuffer, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Input of `pose` that belongs to the scene.
pub(in crate::render) struct GpuMotion {
    /// Position, normal and tangent of each vertex at rest.
    pub(in crate::render) resting: TexelBuffer,
    pub(in crate::render) influences: TexelBuffer,
    pub(in crate::render) displacements: TexelBuffer,
    pub(in crate::render) parts: Vec<MotionPart>,
    vector_count: u64,
    identity: Arc<()>,
}

impl GpuMotion {
    /// Allocates and fills the buffers.
    pub(in crate::render) fn new(uploader: &mut Uploader<'_>, motion: &Motion) -> Result<Self, VulkanError> {
        let float4 = vk::Format::R32G32B32A32_SFLOAT;
        let uint4 = vk::Format::R32G32B32A32_UINT;
        Ok(Self {
            resting: uploader.texels("resting vertices", float4, motion.vertices.as_flattened())?,
            influences: uploader.texels("influences", uint4, motion.influences.as_flattened())?,
            displacements: uploader.texels("displacements", float4, &motion.displacements)?,
            parts: motion.parts.clone(),
            vector_count: motion.vector_count(),
            identity: motion.identity.clone(),
        })
    }
}

impl GpuMotion {
    /// Whether a moment belongs to this motion.
    pub(in crate::render) fn has(&self, moment: &Moment) -> bool {
        Arc::ptr_eq(&self.identity, &moment.identity)
    }
}

/// Input of `stroke` that belongs to the scene.
pub(in crate::render) struct GpuStrokes {
    /// Records: two vectors for each corner of points and lines, then two for each edge.
    pub(in crate::render) words: TexelBuffer,
    /// Number of corners of points and lines.
    pub(in crate::render) corner_count: u32,
    pub(in crate::render) edge_count: u32,
}

impl GpuStrokes {
    /// Allocates and fills the buffer.
    pub(in crate::render) fn new(
        uploader: &mut Uploader<'_>,
        strokes: &[Stroke],
        edges: &[Edge],
    ) -> Result<Self, VulkanError> {
        let flag = |bit: u32, set: bool| if set { bit } else { 0 };
        let of_corner = |stroke: &Stroke| {
            let [x, y] = stroke.part.offset().map(f32::to_bits);
            let shape = stroke.part.code() | flag(spirv::CORNER_FACES_CAMERA, stroke.faces_camera);
            [[stroke.vertex, stroke.at, stroke.other, stroke.beyond], [shape, x, y, 0]]
        };
        let of_edge = |edge: &Edge| {
            let flags = flag(spirv::EDGE_SMOOTH, edge.is_smooth) | flag(spirv::EDGE_DOUBLE_SIDED, edge.is_double_sided);
            let ([from, to], [a, b]) = (edge.ends, edge.opposite);
            [[edge.first_vertex, from, to, flags], [a, b, 0, 0]]
        };
        let corners = strokes.iter().map(of_corner);
        let words: Vec<[[u32; 4]; 2]> = corners.chain(edges.iter().map(of_edge)).collect();
        let uint4 = vk::Format::R32G32B32A32_UINT;
        Ok(Self {
            words: uploader.texels("points, lines and edges", uint4, words.as_flattened())?,
            corner_count: strokes.len() as u32,
            edge_count: edges.len() as u32,
        })
    }
}

/// A frame's vertices. `pose` and `stroke` overwrite those that move.
pub(in crate::render) struct MovingVertices {
    pub(in crate::render) positions: TexelBuffer,
    pub(in crate::render) normals: TexelBuffer,
    /// Tangents; `None` unless a motion moves vertices, because they don't depend on the camera.
    pub(in crate::render) tangents: Option<TexelBuffer>,
    /// Matrices and weights of the moment, which the host writes before each recording.
    pub(in crate::render) moment: Option<TexelBuffer>,
}

impl MovingVertices {
    /// Allocates memory for all vertices of a geometry, if some of them move in the world or, as points and lines,
    /// with the camera.
    pub(in crate::render) fn new(memory: &Memory, geometry: &GpuGeometry) -> Result<Option<Self>, VulkanError> {
        if !geometry.vertices_move() {
            return Ok(None);
        }
        let usage = vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER
            | vk::BufferUsageFlags::STORAGE_TEXEL_BUFFER
            | vk::BufferUsageFlags::TRANSFER_DST;
        let texels = |name: &str, elements: u64, usage, place| {
            let format = vk::Format::R32G32B32A32_SFLOAT;
            memory.texel_buffer(name, elements, format, usage, place)
        };
        let like = |name: &str, view: &TexelBuffer| texels(name, view.buffer.size() / 16, usage, MemoryUse::Device);
        let moment = |motion: &GpuMotion| {
            let mut moment = texels(
                "matrices and weights",
                motion.vector_count,
                vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER,
                MemoryUse::Upload,
            )?;
            if (moment.buffer.bytes_mut().len() as u64) < motion.vector_count * 16 {
                return Err(VulkanError::Call {
                    call: "mapping matrices and weights",
                    result: vk::Result::ERROR_MEMORY_MAP_FAILED,
                });
            }
            Ok(moment)
        };
        Ok(Some(Self {
            positions: like("moving positions", &geometry.positions)?,
            normals: like("moving normals", &geometry.normals)?,
            tangents: geometry.is_posed().then(|| like("moving tangents", &geometry.tangents)).transpose()?,
            moment: geometry.motion.as_ref().map(moment).transpose()?,
        }))
    }

    /// Bytes of device memory for the vertices of a geometry.
    pub(in crate::render) fn bytes(geometry: &GpuGeometry) -> u64 {
        if !geometry.vertices_move() {
            return 0;
        }
        let tangents = geometry.is_posed().then_some(&geometry.tangents);
        let streams = [&geometry.positions, &geometry.normals];
        let streams = streams.into_iter().chain(tangents);
        let vertices: u64 = streams.map(|view| view.buffer.size()).sum();
        let motion = geometry.motion.as_ref();
        vertices + motion.map_or(0, |motion| motion.vector_count * 16)
    }

    /// Records copies of the vertices of the first pose. Vertices that don't move keep them.
    pub(in crate::render) fn record_upload(&self, recorder: &Recorder<'_>, geometry: &GpuGeometry) {
        let tangents = self.tangents.as_ref().map(|to| (&geometry.tangents, to));
        let streams = [(&geometry.positions, &self.positions), (&geometry.normals, &self.normals)];
        for (from, to) in streams.into_iter().chain(tangents) {
            recorder.copy(&from.buffer, from.buffer.size(), &to.buffer, 0);
        }
    }

    /// Writes a moment; the device must have finished the previous recording.
    pub(in crate::render) fn write(&mut self, moment: &Moment) {
        let vectors: &[u8] = bytemuck::cast_slice(&moment.vectors);
        let moment = self.moment.as_mut();
        if let Some(place) = moment.and_then(|m| m.buffer.bytes_mut().get_mut(..vectors.len())) {
            place.copy_from_slice(vectors);
        }
    }
}

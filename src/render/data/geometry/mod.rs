//! Triangles on the device: each mesh once, and the instances that draw it.
//!
//! A triangle's ID minus 1 is its index. Without instances, the index is that of the triangle's words. With
//! instances, each instance owns a range of indices that starts at a multiple of 64, so that one look-up, by index /
//! 64, finds the instance. `shaders/include/triangle.glsl` has the functions with which every pass reads triangles; a
//! specialisation constant removes the look-up for scenes without instances.
//!
//! Data that depend on a camera belong to a frame ([`FrameGeometry`]), so that several frames may be in flight.

mod frame;
mod moving;
mod placed;

pub use frame::FrameGeometry;
pub(in crate::render) use moving::{GpuMotion, GpuStrokes, MovingVertices};
pub(in crate::render) use placed::PlacedInstances;

use crate::engine::data::upload::Uploader;
use crate::engine::spirv;
use crate::render::data::AlphaUse;
use crate::scene::{DrawClass, MeshInstance, Motion, PosedGeometry, Scene};
use crate::vulkan::{TexelBuffer, VulkanError};
use ash::vk;
use glam::{DAffine3, DVec3};
use std::borrow::Cow;
use std::collections::HashMap;

/// Number of consecutive indices that belong to the same instance.
const BLOCK: u32 = MeshInstance::ALIGNMENT;

/// Consecutive triangles of the same class and the same place, drawn by one command.
#[derive(Clone, Copy, Debug)]
pub(in crate::render) struct Run {
    pub(in crate::render) class: DrawClass,
    pub(in crate::render) first_index: u32,
    pub(in crate::render) triangle_count: u32,
    /// Index of the place at which the triangles are drawn.
    pub(in crate::render) place: u32,
}

/// Place at which triangles are drawn: their transform, their bounds, and the range of their indices.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Difference, modulo 2^32, from an index to its words; the index after the last; flags; 0.
    words: [u32; 4],
    transform: DAffine3,
    /// Lowest and highest corner of the box around the vertices, before the transform.
    bounds: [DVec3; 2],
}

impl Place {
    fn of(instance: &MeshInstance, bounds: [DVec3; 2]) -> Self {
        let offset = instance.first_triangle.wrapping_sub(instance.first_index);
        let end = instance.first_index + instance.triangle_count;
        let flags = if instance.mirrored() { spirv::INSTANCE_MIRRORED } else { 0 };
        Self { words: [offset, end, flags, 0], transform: instance.transform, bounds }
    }
}

/// A scene's triangles on the device.
pub(in crate::render) struct GpuGeometry {
    pub(in crate::render) positions: TexelBuffer,
    /// For each triangle its corners, and a word with material, bin and flags.
    pub(in crate::render) triangles: TexelBuffer,
    pub(in crate::render) normals: TexelBuffer,
    pub(in crate::render) tangents: TexelBuffer,
    pub(in crate::render) uvs: TexelBuffer,
    pub(in crate::render) colors: TexelBuffer,
    /// Index of the place for each block of indices.
    pub(in crate::render) blocks: TexelBuffer,
    pub(in crate::render) runs: Vec<Run>,
    places: Vec<Place>,
    /// Moving vertices; `None` for a scene that does not move.
    pub(in crate::render) motion: Option<GpuMotion>,
    /// Points and lines; `None` without any.
    pub(in crate::render) strokes: Option<GpuStrokes>,
    pub(in crate::render) has_tangents: bool,
    pub(in crate::render) is_instanced: bool,
    /// Number of triangles that are drawn.
    pub(in crate::render) triangle_count: u64,
    /// Number of triangle slots; some may be empty.
    pub(in crate::render) triangle_slots: u32,
    /// World position to which positions are relative.
    pub(in crate::render) origin: DVec3,
}

/// `stream`, or `count` vectors of the same value if it is empty.
fn or_filled(stream: &[[f32; 4]], value: f32, count: usize) -> Cow<'_, [[f32; 4]]> {
    if stream.is_empty() { Cow::Owned(vec![[value; 4]; count]) } else { Cow::Borrowed(stream) }
}

impl GpuGeometry {
    /// Allocates and fills the buffers for a scene's geometry; `triangles` holds the words of its triangles.
    pub(in crate::render) fn new(
        uploader: &mut Uploader<'_>,
        scene: &Scene,
        geometry: &PosedGeometry,
        motion: Option<&Motion>,
        words: &[[u32; 4]],
        alphas: AlphaUse,
    ) -> Result<Self, VulkanError> {
        // Reading an alpha takes both streams, colours and texture coordinates, even if the scene has only one of them.
        let has_alpha = scene.materials.iter().any(|m| alphas.reads(m.alpha_mode));
        let filled = if has_alpha { geometry.positions.len() } else { 0 };
        let colors = or_filled(&geometry.streams.colors, 1.0, filled);
        let uvs = or_filled(&geometry.streams.uvs, 0.0, filled);
        let positions = geometry.positions.iter();
        let positions: Vec<_> = positions.map(|&[x, y, z]| [x, y, z, 1.0]).collect();
        let float4 = vk::Format::R32G32B32A32_SFLOAT;
        let uint4 = vk::Format::R32G32B32A32_UINT;
        let triangle_slots =
            geometry.instances.last().map_or(words.len() as u32, |last| last.first_index + last.triangle_count);
        Ok(Self {
            positions: uploader.texels("positions", float4, &positions)?,
            triangles: uploader.texels("triangles", uint4, words)?,
            normals: uploader.texels("normals", float4, &normals_and_scales(geometry))?,
            tangents: uploader.texels("tangents", float4, &geometry.streams.tangents)?,
            uvs: uploader.texels("texture coordinates", float4, &uvs)?,
            colors: uploader.texels("vertex colours", float4, &colors)?,
            blocks: uploader.texels("instances of blocks", vk::Format::R32_UINT, &blocks(geometry))?,
            runs: runs(geometry),
            places: places(geometry, motion.is_some()),
            strokes: geometry
                .has_strokes()
                .then(|| GpuStrokes::new(uploader, &geometry.strokes, &geometry.edges))
                .transpose()?,
            motion: motion.map(|motion| GpuMotion::new(uploader, motion)).transpose()?,
            has_tangents: !geometry.streams.tangents.is_empty(),
            is_instanced: !geometry.instances.is_empty(),
            triangle_count: geometry.triangle_count(),
            triangle_slots,
            origin: geometry.origin,
        })
    }

    /// Whether a motion moves vertices.
    pub(in crate::render) fn is_posed(&self) -> bool {
        let motion = self.motion.as_ref();
        motion.is_some_and(|motion| !motion.parts.is_empty())
    }

    /// Whether vertices move: in the world, or, for points and lines, with the camera.
    fn vertices_move(&self) -> bool {
        self.is_posed() || self.strokes.is_some()
    }

    /// Index of the first triangle of a class or of a later one; the number of indices if there is no such triangle.
    pub(in crate::render) fn first_of(&self, class: DrawClass) -> u32 {
        self.runs.iter().find(|run| run.class >= class).map_or(self.triangle_slots, |run| run.first_index)
    }
}

/// Normals, with the scale in the fourth component.
fn normals_and_scales(geometry: &PosedGeometry) -> Vec<[f32; 4]> {
    let streams = &geometry.streams;
    let scales = streams.scales.iter().copied().chain(std::iter::repeat(1.0));
    let pairs = streams.normals.iter().zip(scales);
    pairs.map(|(&[x, y, z], scale)| [x, y, z, scale]).collect()
}

/// Index of the place for each block of indices.
fn blocks(geometry: &PosedGeometry) -> Vec<u32> {
    let mut blocks = Vec::new();
    for (place, instance) in (0..).zip(&geometry.instances) {
        let end = instance.first_index + instance.triangle_count;
        blocks.resize(end.div_ceil(BLOCK) as usize, place);
    }
    blocks
}

/// Places of all instances; for a scene without instances, a single place with the identity as its transform and an
/// infinite box. If vertices move or have a size in pixels, all places with this transform have an infinite box.
fn places(geometry: &PosedGeometry, moves: bool) -> Vec<Place> {
    let everywhere = [DVec3::NEG_INFINITY, DVec3::INFINITY];
    if geometry.instances.is_empty() {
        return vec![Place {
            words: [0, geometry.triangles.len() as u32, 0, 0],
            transform: DAffine3::IDENTITY,
            bounds: everywhere,
        }];
    }
    // Instances of the same mesh share its box.
    let mut boxes: HashMap<(u32, u32), [DVec3; 2]> = HashMap::new();
    let changes = moves || geometry.has_strokes();
    let place = |instance: &MeshInstance| {
        if changes && instance.transform == DAffine3::IDENTITY {
            return Place::of(instance, everywhere);
        }
        let bounds = boxes
            .entry((instance.first_triangle, instance.triangle_count))
            .or_insert_with(|| geometry.own_box(instance).unwrap_or(everywhere));
        Place::of(instance, *bounds)
    };
    geometry.instances.iter().map(place).collect()
}

/// Runs of triangles, each drawn by one command.
fn runs(geometry: &PosedGeometry) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    if geometry.instances.is_empty() {
        for draw in &geometry.draws {
            match runs.last_mut() {
                Some(run) if run.class == draw.class => run.triangle_count += draw.triangle_count,
                _ => runs.push(Run {
                    class: draw.class,
                    first_index: draw.first_triangle,
                    triangle_count: draw.triangle_count,
                    place: 0,
                }),
            }
        }
        return runs;
    }
    for (place, instance) in (0..).zip(&geometry.instances) {
        let after = geometry.draws.partition_point(|draw| draw.first_triangle <= instance.first_triangle);
        if let Some(draw) = geometry.draws.get(after.wrapping_sub(1)) {
            runs.push(Run {
                class: draw.class,
                first_index: instance.first_index,
                triangle_count: instance.triangle_count,
                place,
            });
        }
    }
    runs
}

/// Whether a class shows back faces.
pub(in crate::render) fn double_sided(class: DrawClass) -> bool {
    matches!(class, DrawClass::OpaqueDoubleSided | DrawClass::MaskDoubleSided | DrawClass::BlendDoubleSided)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Stroke, StrokePart};

    #[test]
    fn boxes_are_known_of_what_keeps_its_place_alone() {
        let instance = |first_triangle, first_index, transform| MeshInstance {
            first_triangle,
            triangle_count: 1,
            first_index,
            transform,
        };
        let mut geometry = PosedGeometry {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2]; 2],
            instances: vec![instance(0, 0, DAffine3::IDENTITY), instance(1, 64, DAffine3::from_translation(DVec3::X))],
            ..PosedGeometry::default()
        };
        let known = |geometry: &PosedGeometry, moves: bool| -> Vec<bool> {
            let places = places(geometry, moves);
            let corners = places.iter().map(|place| place.bounds);
            corners.map(|[low, high]| low.is_finite() && high.is_finite()).collect()
        };
        assert_eq!(known(&geometry, false), [true, true]);
        assert_eq!(known(&geometry, true), [false, true]);
        geometry.strokes.push(Stroke {
            part: StrokePart::Left,
            vertex: 2,
            at: 0,
            other: 1,
            beyond: 0,
            faces_camera: true,
        });
        assert_eq!(known(&geometry, false), [false, true]);
    }
}

//! The part of the geometry that belongs to a frame.

use super::{MovingVertices, PlacedInstances, double_sided};
use crate::engine::passes::RasterRun;
use crate::engine::spirv::frame_set;
use crate::render::data::GpuScene;
use crate::scene::{DrawClass, Moment};
use crate::vulkan::{BoundDescriptor, Memory, Recorder, VulkanError};
use glam::DMat4;

/// Instances as a frame's camera sees them, and the vertices that move at the frame's moment.
pub struct FrameGeometry {
    pub(in crate::render) placed: PlacedInstances,
    pub(in crate::render) moving: Option<MovingVertices>,
}

impl FrameGeometry {
    /// Allocates the memory for a scene. Unless `moves` is true, vertices stay as they were uploaded, except those of
    /// points and lines.
    ///
    /// # Errors
    /// If memory runs out or can't be mapped.
    pub fn new(memory: &Memory, scene: &GpuScene, moves: bool) -> Result<Self, VulkanError> {
        let moves = moves || scene.geometry.strokes.is_some();
        let moving = moves.then(|| MovingVertices::new(memory, &scene.geometry));
        Ok(Self { placed: PlacedInstances::new(memory, &scene.geometry)?, moving: moving.transpose()?.flatten() })
    }

    /// Approximate number of bytes for a scene that moves.
    #[must_use]
    pub fn bytes(scene: &GpuScene) -> u64 {
        PlacedInstances::bytes(&scene.geometry) + MovingVertices::bytes(&scene.geometry)
    }

    /// Bindings that show the vertices of the scene and of the frame.
    #[must_use]
    pub fn shown(&self, scene: &GpuScene) -> Vec<BoundDescriptor> {
        let geometry = &scene.geometry;
        let (positions, normals) = match &self.moving {
            Some(moving) => (&moving.positions, &moving.normals),
            None => (&geometry.positions, &geometry.normals),
        };
        let moving_tangents = self.moving.as_ref().and_then(|m| m.tangents.as_ref());
        let tangents = moving_tangents.unwrap_or(&geometry.tangents);
        let mut texels = vec![
            (frame_set::POSITIONS, positions),
            (frame_set::TRIANGLES, &geometry.triangles),
            (frame_set::NORMALS, normals),
            (frame_set::TANGENTS, tangents),
            (frame_set::UVS, &geometry.uvs),
            (frame_set::COLORS, &geometry.colors),
            (frame_set::ALPHA_ATLAS, &scene.alpha_atlas),
            (frame_set::INSTANCE_OF, &geometry.blocks),
            (frame_set::INSTANCES, &self.placed.buffer),
        ];
        if let Some(moving) = &self.moving {
            texels.extend([(frame_set::POSITIONS_OUT, &moving.positions), (frame_set::NORMALS_OUT, &moving.normals)]);
            texels.extend(moving_tangents.map(|tangents| (frame_set::TANGENTS_OUT, tangents)));
            texels.extend(moving.moment.as_ref().map(|moment| (frame_set::MOMENT, moment)));
            texels.extend(geometry.strokes.as_ref().map(|strokes| (frame_set::STROKES, &strokes.words)));
        }
        if let Some(motion) = &geometry.motion {
            texels.extend([
                (frame_set::RESTING, &motion.resting),
                (frame_set::INFLUENCES, &motion.influences),
                (frame_set::DISPLACEMENTS, &motion.displacements),
            ]);
        }
        texels.into_iter().map(|(binding, texels)| (binding, texels.texels().into())).collect()
    }

    /// Runs of a scene's triangles for [`Raster`](crate::engine::passes::Raster), without those outside of the camera's view.
    pub(crate) fn runs<'a>(&'a self, scene: &'a GpuScene) -> impl Iterator<Item = RasterRun> + Clone + 'a {
        let runs = scene.geometry.runs.iter();
        runs.filter_map(|run| {
            Some(RasterRun {
                push: *self.placed.draw(run.place)?,
                first_index: run.first_index,
                triangle_count: run.triangle_count,
                double_sided: double_sided(run.class),
                masked: matches!(run.class, DrawClass::Mask | DrawClass::MaskDoubleSided),
                blended: run.class >= DrawClass::Blend,
            })
        })
    }

    /// Records initial copies of the vertices, if some of them will move.
    pub(crate) fn record_upload(&self, recorder: &Recorder<'_>, scene: &GpuScene) {
        if let Some(moving) = &self.moving {
            moving.record_upload(recorder, &scene.geometry);
        }
    }

    /// Writes a scene's instances for a camera; `to_clip` is the matrix from the scene's coordinates to pixel-scaled
    /// clip space. Call `place` before each recording, once the device has finished the previous one. `image` is the
    /// size in pixels of the image that `raster` draws, if it runs.
    pub(crate) fn place(&mut self, scene: &GpuScene, to_clip: &DMat4, image: Option<[u32; 2]>) {
        self.placed.write(&scene.geometry, to_clip, image);
    }

    /// Writes the vertices' matrices and weights at a moment. Call `write_moment` before a recording, once the device
    /// has finished the previous one.
    pub(crate) fn write_moment(&mut self, moment: &Moment) {
        if let Some(moving) = &mut self.moving {
            moving.write(moment);
        }
    }
}

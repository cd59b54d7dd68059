//! pose: computes vertices that move, at a moment. It is no [`Pass`](crate::engine::pipelines::Pass), because its push constants
//! depend on the moment.

use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv;
use crate::render::data::{FrameGeometry, GpuScene};
use crate::scene::Moment;
use crate::vulkan::{Recorder, Specialized, VulkanError};

/// Applies morph targets, skins and transforms to meshes.
pub struct PosePass {
    kernel: Kernel<spirv::Pose>,
}

impl PosePass {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout) -> Result<Self, VulkanError> {
        Ok(Self { kernel: layout.kernel(&spirv::Pose)? })
    }

    /// Records the pass for a moment, which was written to the frame's memory.
    pub fn record(&self, recorder: &Recorder<'_>, scene: &GpuScene, geometry: &FrameGeometry, moment: &Moment) {
        let (Some(motion), Some(_)) = (&scene.geometry.motion, &geometry.moving) else {
            return;
        };
        let tangents = if scene.geometry.has_tangents { spirv::POSE_TANGENTS } else { 0 };
        recorder.pass(spirv::Pose::INTERFACE, || {
            // Parts write different vertices.
            recorder.unordered(|| {
                for (part, at) in motion.parts.iter().zip(&moment.parts) {
                    let flag = |bit: u32, set: bool| if set { bit } else { 0 };
                    let flags =
                        flag(spirv::POSE_FLAT, part.is_flat) | flag(spirv::POSE_INSIDE_OUT, part.mirrored) | tangents;
                    let push = spirv::PosePush {
                        count: part.vertex_count,
                        first_vertex: part.first_vertex,
                        first_resting: part.first_resting,
                        first_influence: part.first_influence,
                        sets: part.sets,
                        first_displacement: part.first_displacement,
                        displacement_vectors: part.displacement_vectors,
                        first_matrix: at.first_matrix,
                        first_weight: at.first_weight,
                        weight_count: at.weight_count,
                        flags,
                    };
                    self.kernel.record(recorder, &push, part.vertex_count);
                }
            });
        });
    }
}

//! What the uniform blocks of images and of lists of locations have in common.

use super::Settings;
use crate::engine::sampler::footprint::Footprints;
use crate::passes::{Content, FrameUniform, ResourceSizes};
use crate::render::passes::GpuScene;
use glam::DVec3;

/// Who looks, and where to.
pub(super) struct Looking {
    pub eye: DVec3,
    pub direction: DVec3,
    pub is_parallel: bool,
}

/// The uniform block of a scene and of cells of so many samples, without what says where on the plane they are.
pub(super) fn uniform(
    scene: &GpuScene,
    settings: &Settings,
    looking: &Looking,
    (samples, footprints): (u32, &Footprints),
    sizes: &ResourceSizes,
) -> FrameUniform {
    let eye = (looking.eye - scene.origin()).as_vec3();
    let direction = looking.direction.as_vec3();
    let parallel = if looking.is_parallel { 1.0 } else { 0.0 };
    FrameUniform {
        eye: [eye.x, eye.y, eye.z, 1.0],
        view_direction: [direction.x, direction.y, direction.z, parallel],
        irradiance: scene.environment().irradiance,
        environment: scene.environment().axes,
        background: settings.background_rgba(),
        triangle_count: scene.index_count(),
        first_mask: scene.first_mask(),
        first_blend: scene.first_blend(),
        sample_count: samples,
        bin_count: scene.bin_count(),
        light_count: scene.light_features().count,
        material_vectors: scene.material_vectors(),
        exposure: settings.exposure.exp2(),
        footprint: footprints.centre,
        place_footprint: footprints.place,
        sample_footprint: footprints.sample,
        ..FrameUniform::with_room(sizes)
    }
}

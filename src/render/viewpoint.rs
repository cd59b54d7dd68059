//! Viewpoint of a scene, in the form that passes read.

use crate::camera::{Camera, Pinhole};
use crate::engine::data::Content;
use crate::engine::sampler::uniform::SceneBlock;
use crate::render::data::GpuScene;
use glam::DVec3;

/// Position from which a scene is seen, and the direction of view.
pub(super) struct EyePoint {
    eye: DVec3,
    direction: DVec3,
    is_parallel: bool,
}

impl From<&Camera> for EyePoint {
    fn from(camera: &Camera) -> Self {
        Self { eye: camera.eye, direction: camera.direction(), is_parallel: camera.is_orthographic() }
    }
}

impl From<&Pinhole> for EyePoint {
    fn from(pinhole: &Pinhole) -> Self {
        // Parallel rays need not be perpendicular to the plane.
        let of_rays = pinhole.parallel_direction().map(|to_centre| -to_centre);
        Self {
            eye: pinhole.eye(),
            direction: of_rays.unwrap_or(pinhole.direction()),
            is_parallel: pinhole.is_parallel(),
        }
    }
}

impl SceneBlock {
    /// Viewpoint block for a scene on the device.
    pub(super) fn of(scene: &GpuScene, viewpoint: &EyePoint) -> Self {
        let parallel = if viewpoint.is_parallel { 1.0 } else { 0.0 };
        Self {
            eye: (viewpoint.eye - scene.geometry.origin).as_vec3().extend(1.0).to_array(),
            view_direction: viewpoint.direction.as_vec3().extend(parallel).to_array(),
            irradiance: scene.environment.uniform.irradiance,
            environment: scene.environment.uniform.axes,
            triangle_count: scene.triangle_slots(),
            first_mask: scene.first_mask,
            first_blend: scene.first_blend,
            material_vectors: scene.material_vectors,
            bin_count: scene.bin_count(),
            light_count: scene.light_features.count,
        }
    }
}

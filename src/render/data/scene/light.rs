//! Lights in the form that shaders read.

use crate::scene::{Light, LightKind, Sun};
use glam::DVec3;

/// `Light` of `shaders/include/frame.glsl`.
pub(super) use crate::engine::spirv::Light as GpuLight;

impl GpuLight {
    pub(super) fn of_scene(light: &Light, origin: DVec3) -> Self {
        let position = (light.position - origin).as_vec3();
        let direction = light.direction.as_vec3();
        // The formulas are those of KHR_lights_punctual, "Inner and Outer Cone Angles".
        let (kind, scale, offset) = match light.kind {
            LightKind::Directional => (0.0, 0.0, 1.0),
            LightKind::Point => (1.0, 0.0, 1.0),
            LightKind::Spot { inner_angle, outer_angle } => {
                let scale = 1.0 / (inner_angle.cos() - outer_angle.cos()).max(0.001);
                (2.0, scale, -outer_angle.cos() * scale)
            }
        };
        let range = light.range.filter(|range| *range > 0.0).map_or(0.0, |range| 1.0 / (range * range));
        Self {
            position_range: [position.x, position.y, position.z, range],
            direction_kind: [direction.x, direction.y, direction.z, kind],
            color_scale: [light.color[0], light.color[1], light.color[2], scale],
            offset: [offset, 0.0, 0.0, 0.0],
        }
    }
}

impl GpuLight {
    /// A sun of the environment, in the map's space.
    pub(super) fn of_sun(sun: &Sun) -> Self {
        let [direction, light] = [sun.direction, sun.light].map(|v| v.as_vec3());
        Self {
            position_range: [0.0; 4],
            direction_kind: direction.extend(sun.solid_angle as f32).to_array(),
            color_scale: light.extend(0.0).to_array(),
            offset: [0.0; 4],
        }
    }
}

/// Lights of a scene, as far as shading pipelines depend on them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LightFeatures {
    /// Number of lights.
    pub count: u32,
    /// Whether there are point or spot lights.
    pub local: bool,
}

impl LightFeatures {
    pub(super) fn of(lights: &[Light]) -> Self {
        Self { count: lights.len() as u32, local: lights.iter().any(|light| light.kind != LightKind::Directional) }
    }
}

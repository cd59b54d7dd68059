//! Lights in the form that shaders read.

use crate::scene::{Light, LightKind, Sun, Suns};
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
    /// The bright parts of an environment, in the form that `shaders/include/environment.glsl` describes: the groups, then their
    /// nodes.
    pub(super) fn of_suns(suns: &Suns) -> impl Iterator<Item = Self> {
        let first = suns.groups.len();
        let groups = suns.groups.iter().map(move |group| {
            let nodes = [group.nodes.start, group.nodes.end].map(|index| (first + index) as f32);
            Self {
                position_range: [nodes[0], nodes[1], reach(&group.whole), 0.0],
                ..Self::of_sun(&group.whole, suns.grid)
            }
        });
        let nodes = suns.nodes.iter().map(move |node| {
            let [column, row] = node.sun.place.map(|x| x as f32);
            let next = (first + node.next) as f32;
            Self { position_range: [column, row, reach(&node.sun), next], ..Self::of_sun(&node.sun, suns.grid) }
        });
        groups.chain(nodes)
    }

    /// Fields that groups and nodes have in common.
    fn of_sun(sun: &Sun, grid: [u32; 2]) -> Self {
        let [direction, light] = [sun.direction, sun.light].map(|v| v.as_vec3());
        let [width, height] = sun.size.map(|x| x as f32);
        let [columns, rows] = grid.map(|count| count as f32);
        Self {
            position_range: [0.0; 4],
            direction_kind: direction.extend(sun.variance as f32).to_array(),
            color_scale: light.extend(width).to_array(),
            offset: [height, columns, rows, 0.0],
        }
    }
}

/// Square of a distance that is large enough beside a light's radius for the light to count as one.
fn reach(sun: &Sun) -> f32 {
    /// Distance in radii. Highlights must not change where parts begin to count as one.
    const FACTOR: f64 = 10.0;
    (FACTOR * sun.radius).powi(2) as f32
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

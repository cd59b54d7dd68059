//! Punctual lights (`KHR_lights_punctual`) in world space.

use glam::DVec3;

/// Kind of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Parallel light; intensity in lux.
    Directional,
    /// Light from a point in all directions; intensity in candela.
    Point,
    /// Light from a point within a cone; intensity in candela, angles in radians from the axis.
    Spot {
        /// Half angle inside which the light is full.
        inner_angle: f32,
        /// Half angle outside of which the light is dark, above `inner_angle`, at most pi / 2.
        outer_angle: f32,
    },
}

/// Light of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Kind of the light.
    pub kind: LightKind,
    /// World position; unused by directional lights.
    pub position: DVec3,
    /// Unit vector along which the light travels.
    pub direction: DVec3,
    /// Linear RGB colour times intensity.
    pub color: [f32; 3],
    /// Distance past which a point or spot light has no effect; `None` is infinite.
    pub range: Option<f32>,
}

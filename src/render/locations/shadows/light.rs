//! The pinholes of a light, and where receivers lie on their planes.
//!
//! ```text
//!   directional: parallel rays, w = 0      spot: one perspective plane       point, wide spot: six planes, a cube
//!
//!     │ │ │ │ │                                    C                              ┌─────┐
//!   ──┼─┼─┼─┼─┼── plane                           ╱│╲                             │  C  │
//!     ▼ ▼ ▼ ▼ ▼                                  ╱─┼─╲ plane                      └─────┘
//! ```

use super::receivers::Receiver;
use crate::camera::{Pinhole, Rig, SampleLocation};
use crate::render::RenderError;
use crate::scene::{Light, LightKind};
use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

/// What lies nearer than this is the receiver itself: part of the distance to a local light, or of the scene's depth in
/// the direction of a distant one, 2^-17. It covers the rounding of positions to 32 bits on surfaces that light grazes
/// at more than a degree.
const BIAS: f64 = 1.0 / 131_072.0;
/// Largest half angle of a cone on one plane, in radians: 75 degrees. A pixel on its rim is 15 times as large as on its
/// axis.
const WIDEST: f64 = 75.0 * std::f64::consts::PI / 180.0;
/// Distance of the near plane of local lights, in diagonals of the scene; nothing nearer casts a shadow.
const NEAR: f64 = 1e-6;
/// Most pixels along a side of a light's plane, which then is one region of the engine.
const MOST_PIXELS: f64 = 2_000.0;

/// A pinhole of a light, and the receivers that it sees: a sampling set without any pattern.
pub(super) struct LightView {
    pub pinhole: Pinhole,
    /// Their places on the plane.
    pub locations: Vec<SampleLocation>,
    /// The least depth of what shadows them, and IDs of their triangles.
    surfaces: Vec<(f32, u32)>,
    /// Indices of their records.
    pub indices: Vec<usize>,
}

/// What a light is to a receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Sight {
    /// It does not shine so far, or not in this direction.
    Beyond,
    /// It shines on the side that is not seen: the receiver lies in the shadow of its own triangle.
    Turned,
    /// It would shine on it if nothing stood in the way.
    Facing {
        /// Number of the pinhole that sees it; none where it lies too near.
        pinhole: Option<usize>,
        /// Its place on that one's plane.
        uv: DVec2,
    },
}

/// The pinholes of a light that together see all of these receivers, in a scene within `bounds`, and what it is to each
/// receiver.
///
/// # Errors
/// If a pinhole can't be, since the scene has no extent that 64 bits tell apart.
pub(super) fn sights(
    light: &Light,
    bounds: (DVec3, DVec3),
    receivers: &[Receiver],
) -> Result<(Vec<Pinhole>, Vec<Sight>), RenderError> {
    // About as many pixels as receivers: tiles then have short lists.
    let side = (receivers.len() as f64).sqrt().clamp(64.0, MOST_PIXELS);
    let all = receivers.par_iter();
    let sight = |receiver: &Receiver, to_light: DVec3, place: Option<(usize, DVec2)>| {
        if receiver.normal.dot(to_light) < 0.0 {
            return Sight::Turned;
        }
        let (pinhole, uv) = place.unzip();
        Sight::Facing {
            pinhole,
            uv: uv.unwrap_or_default(),
        }
    };
    match light.kind {
        LightKind::Directional => {
            let pinhole = distant(light.direction, bounds, receivers, side)?;
            let of = |receiver: &Receiver| {
                let uv = pinhole.project(receiver.position);
                sight(receiver, -light.direction, uv.map(|uv| (0, uv)))
            };
            Ok((vec![pinhole], all.map(of).collect()))
        }
        LightKind::Point | LightKind::Spot { .. } => {
            let rig = local(light, bounds, side)?;
            let of = |receiver: &Receiver| {
                let way = receiver.position - light.position;
                if reaches(light, way) {
                    sight(receiver, -way, rig.locate(way))
                } else {
                    Sight::Beyond
                }
            };
            Ok((rig.pinholes().to_vec(), all.map(of).collect()))
        }
    }
}

/// Whether light goes this way from a local light.
fn reaches(light: &Light, way: DVec3) -> bool {
    let near = light.range.is_none_or(|range| way.length() <= range.into());
    let inside = match light.kind {
        LightKind::Spot { outer_angle, .. } => {
            way.dot(light.direction) >= f64::from(outer_angle).cos() * way.length()
        }
        LightKind::Directional | LightKind::Point => true,
    };
    near && inside
}

/// The pinhole of parallel light, with a plane of `side` pixels around the receivers and all of the scene behind it.
fn distant(
    along: DVec3,
    (low, high): (DVec3, DVec3),
    receivers: &[Receiver],
    side: f64,
) -> Result<Pinhole, RenderError> {
    let a = along.any_orthonormal_vector();
    let b = along.cross(a);
    let diagonal = (high - low).length();
    // Relative to the scene, wherever it lies in the world.
    let on_plane = |receiver: &Receiver| {
        let from_low = receiver.position - low;
        DVec2::new(from_low.dot(a), from_low.dot(b))
    };
    let first = receivers.first().map(on_plane).unwrap_or_default();
    let (least, most) = receivers
        .par_iter()
        .map(|receiver| (on_plane(receiver), on_plane(receiver)))
        .reduce(
            || (first, first),
            |(least, most), (low, high)| (least.min(low), most.max(high)),
        );
    let extent = (most - least).max_element().max(1e-6 * diagonal);
    // The box's nearest and farthest corners.
    let size = high - low;
    let nearest = (size * along).min(DVec3::ZERO).element_sum();
    let farthest = (size * along).max(DVec3::ZERO).element_sum();
    let margin = 1e-3 * diagonal;
    let pixel = extent / side;
    // Half a pixel before the receivers: none lies on the border of a region of the plane.
    let corner = low + (a + b) * (-0.5 * pixel);
    let origin = corner + a * least.x + b * least.y + along * (nearest - margin);
    let depth = farthest - nearest + 2.0 * margin;
    Ok(Pinhole::new(
        (-along).extend(0.0),
        origin,
        a * pixel,
        b * pixel,
        0.0,
        Some(depth),
    )?)
}

/// The pinholes of a local light: one for a cone that a plane of `side` pixels holds, otherwise a cube.
fn local(light: &Light, (low, high): (DVec3, DVec3), side: f64) -> Result<Rig, RenderError> {
    let (eye, axis) = (light.position, light.direction);
    let near = NEAR * (high - low).length();
    match light.kind {
        LightKind::Spot { outer_angle, .. } if f64::from(outer_angle) <= WIDEST => {
            let half = f64::from(outer_angle).tan();
            let a = axis.any_orthonormal_vector();
            let b = axis.cross(a);
            let origin = eye + axis - (a + b) * half;
            let pixel = 2.0 * half / side;
            let pinhole = Pinhole::new(eye.extend(1.0), origin, a * pixel, b * pixel, near, None)?;
            Ok(Rig::new(vec![pinhole])?)
        }
        _ => Ok(Rig::cube(eye, DMat3::IDENTITY, side as u32, near)?),
    }
}

impl LightView {
    /// What pinhole number `number` sees of these receivers.
    pub fn new(pinhole: Pinhole, number: usize, receivers: &[Receiver], sights: &[Sight]) -> Self {
        // From positions relative to its eye to its plane and depth.
        let matrix = pinhole.pixel_matrix(pinhole.eye(), DVec2::ZERO);
        let location = |(receiver, sight): (&Receiver, &Sight)| {
            let uv = match *sight {
                Sight::Facing {
                    pinhole: Some(of),
                    uv,
                } if of == number => uv,
                _ => return None,
            };
            let place = matrix * (receiver.position - pinhole.eye()).extend(1.0);
            let depth = place.z / place.w;
            let least = if pinhole.is_parallel() {
                depth + BIAS
            } else {
                depth * (1.0 + BIAS)
            };
            let location = SampleLocation {
                uv: uv.to_array(),
                jacobian: [[0.0; 2]; 2],
                output: 0,
            };
            Some((location, ((least as f32, receiver.id), receiver.index)))
        };
        let seen = receivers.par_iter().zip(sights).filter_map(location);
        let (locations, (surfaces, indices)) = seen.unzip();
        Self {
            pinhole,
            locations,
            surfaces,
            indices,
        }
    }

    /// What `shaders/include/locations.glsl` has of a receiver in its location's second vector.
    pub fn surface(&self, location: usize) -> [u32; 4] {
        let (least, id) = self.surfaces[location];
        [least.to_bits(), id, 0, 0]
    }
}

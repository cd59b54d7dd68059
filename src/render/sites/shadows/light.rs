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
use crate::camera::{Pinhole, Rig, Site};
use crate::render::RenderError;
use crate::scene::{Light, LightKind};
use glam::{DMat3, DMat4, DVec2, DVec3};
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
    /// From positions relative to its eye to its plane and depth.
    matrix: DMat4,
    /// Their places on the plane and, where others have the Jacobian, the least depth of what shadows them.
    pub sites: Vec<Site>,
    /// IDs of their triangles.
    pub ids: Vec<u32>,
    /// Their places in the caller's list.
    pub indices: Vec<usize>,
}

/// The receivers that a light reaches if nothing stands in the way: those whose seen side faces it, and those whose side
/// is turned from it, which lie in the shadow of their own triangle.
pub(super) fn reached(light: &Light, receivers: &[Receiver]) -> [Vec<Receiver>; 2] {
    let within = receivers.par_iter().copied().filter(|receiver| {
        let is_distant = light.kind == LightKind::Directional;
        is_distant || reaches(light, receiver.position - light.position)
    });
    let (facing, turned) = within.partition(|receiver| {
        let to_light = match light.kind {
            LightKind::Directional => -light.direction,
            LightKind::Point | LightKind::Spot { .. } => light.position - receiver.position,
        };
        receiver.normal.dot(to_light) >= 0.0
    });
    [facing, turned]
}

/// The views of a light that together see all of these receivers, in a scene within `bounds`.
///
/// # Errors
/// If a pinhole can't be, since the scene has no extent that 64 bits tell apart.
pub(super) fn views(
    light: &Light,
    bounds: (DVec3, DVec3),
    receivers: &[Receiver],
) -> Result<Vec<LightView>, RenderError> {
    // About as many pixels as receivers: tiles then have short lists.
    let side = (receivers.len() as f64).sqrt().clamp(64.0, MOST_PIXELS);
    let all = receivers.par_iter();
    let (pinholes, places): (Vec<Pinhole>, Vec<Option<(usize, DVec2)>>) = match light.kind {
        LightKind::Directional => {
            let pinhole = distant(light.direction, bounds, receivers, side)?;
            let place = |receiver: &Receiver| Some((0, pinhole.project(receiver.position)?));
            (vec![pinhole], all.map(place).collect())
        }
        LightKind::Point | LightKind::Spot { .. } => {
            let rig = local(light, bounds, side)?;
            let place = |receiver: &Receiver| rig.locate(receiver.position - light.position);
            (rig.pinholes().to_vec(), all.map(place).collect())
        }
    };
    let mut views: Vec<LightView> = pinholes.into_iter().map(LightView::new).collect();
    for (receiver, place) in receivers.iter().zip(places) {
        if let Some((index, uv)) = place
            && let Some(view) = views.get_mut(index)
        {
            view.push(receiver, uv);
        }
    }
    views.retain(|view| !view.sites.is_empty());
    Ok(views)
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
        .iter()
        .map(on_plane)
        .fold((first, first), |(least, most), p| {
            (least.min(p), most.max(p))
        });
    let extent = (most - least).max_element().max(1e-6 * diagonal);
    // The box's nearest and farthest corners.
    let size = high - low;
    let nearest = (size * along).min(DVec3::ZERO).element_sum();
    let farthest = (size * along).max(DVec3::ZERO).element_sum();
    let margin = 1e-3 * diagonal;
    let origin = low + a * least.x + b * least.y + along * (nearest - margin);
    let pixel = extent / side;
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
    fn new(pinhole: Pinhole) -> Self {
        Self {
            pinhole,
            matrix: pinhole.pixel_matrix(pinhole.eye(), DVec2::ZERO),
            sites: Vec::new(),
            ids: Vec::new(),
            indices: Vec::new(),
        }
    }

    fn push(&mut self, receiver: &Receiver, uv: DVec2) {
        let place = self.matrix * (receiver.position - self.pinhole.eye()).extend(1.0);
        let depth = place.z / place.w;
        let least = if self.pinhole.is_parallel() {
            depth + BIAS
        } else {
            depth * (1.0 + BIAS)
        };
        self.sites.push(Site {
            uv: uv.to_array(),
            jacobian: [[least, 0.0], [0.0; 2]],
            output: 0,
        });
        self.ids.push(receiver.id);
        self.indices.push(receiver.index);
    }
}

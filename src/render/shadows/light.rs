//! Pinholes of lights, and the windows of their image planes in which the visible part of the scene lies.
//!
//! ```text
//!   directional: parallel rays, w = 0      spot: one perspective plane       point, wide spot: six planes, a cube
//!
//!     │ │ │ │ │                                    C                              ┌─────┐
//!   ──┼─┼─┼─┼─┼── plane                           ╱│╲                             │  C  │
//!     ▼ ▼ ▼ ▼ ▼                                  ╱─┼─╲ plane                      └─────┘
//! ```

use super::casters::Lit;
use crate::camera::{Pinhole, Rig};
use crate::engine::data::tiles::tiles;
use crate::render::passes::LightPlane;
use crate::render::plane::{PlaneWindow, TILE};
use crate::scene::{Light, LightKind};
use glam::{DMat3, DVec2, DVec3};

/// Largest half angle of a cone that one plane covers, in radians: 75 degrees. A pixel on the cone's rim covers 15
/// times the area of one on its axis.
const WIDEST: f64 = 75.0 * std::f64::consts::PI / 180.0;
/// Distance of the near plane of point and spot lights, as a share of the scene's diagonal; nothing nearer casts a
/// shadow.
const NEAR: f64 = 1e-6;
/// Number of pixels of a plane for each place. More pixels make the lists of tiles shorter, and their making longer. Long lists are
/// refined, see `shaders/refine.comp`.
const PIXELS_OF_PLACE: u64 = 2;
/// Smallest and largest number of pixels along a side of a light's plane, which is one region of the sampler.
const SIDES: [f64; 2] = [64.0, 2_000.0];
/// Margin around the visible part of a distant light's plane, as a share of that part's side. The margin covers the
/// rounding of positions to 32 bits.
const RIM: f64 = 1.0 / 256.0;

/// A rectangle of a plane: its upper left and lower right corner in pixels.
pub(in crate::render) type Rectangle = [DVec2; 2];

/// The part of a scene that is visible through a pinhole's plane. The planes of lights are computed from the whole
/// visible part, so that all parts of an image, and all runs of a list, get bit-identical shadows.
pub(in crate::render) struct Sight {
    pub pinhole: Pinhole,
    pub whole: Rectangle,
    /// Rectangle of the plane that is shaded at once.
    pub part: Rectangle,
    /// World position to which positions on the device are relative.
    pub origin: DVec3,
}

/// View of a light: its pinhole, the window of its plane that is sampled, and the light's parameters for receivers.
pub(in crate::render) struct LightView {
    pub(super) pinhole: Pinhole,
    pub(super) window: PlaneWindow,
    pub(super) plane: LightPlane,
}

/// Side in pixels of a plane for the lights of `places` pixels or locations. A list of the plane has room for `longest`
/// triangles.
pub(super) fn plane_side(places: u64, longest: u32) -> u32 {
    let [fewest, most] = SIDES;
    // A pair has as many bits for its rank in a list as the numbers of tiles leave: see `shaders/include/pairs.glsl`.
    let tiles = (1_u64 << longest.leading_zeros()) - 1;
    let with_ranks = (tiles as f64 * (TILE[0] * TILE[1]) as f64).sqrt();
    let side = (PIXELS_OF_PLACE as f64 * places as f64).sqrt().clamp(fewest, most);
    // The side is a whole number of tiles.
    (side as u32).next_multiple_of(8).min(with_ranks as u32 / 8 * 8).max(8)
}

/// Largest number of views that [`views`] makes, if lights have only one moment or may be changed by others.
pub(super) fn most_planes(lit: &Lit, moves: bool) -> u32 {
    let of_light = |light: &Light| match light.kind {
        LightKind::Directional => 1,
        LightKind::Spot { outer_angle, .. } if !moves && f64::from(outer_angle) <= WIDEST => 1,
        LightKind::Spot { .. } | LightKind::Point => 6,
    };
    lit.lights.iter().map(of_light).sum()
}

/// Views of all lights that together cover the visible part of the scene; empty for a scene without extent. Planes have
/// `side` pixels along each side.
pub(super) fn views(lit: &Lit, sight: &Sight, side: u32) -> Vec<LightView> {
    let Some(bounds) = lit.bounds else {
        return Vec::new();
    };
    let mut views: Vec<LightView> = Vec::new();
    for (number, light) in (0..).zip(&lit.lights) {
        let pinholes = pinholes(light, bounds, sight, side).unwrap_or_default();
        let single = pinholes.len() == 1;
        for (face, pinhole) in (0..).zip(pinholes) {
            let parallel = pinhole.is_parallel();
            let window = match parallel {
                true => window_around(&pinhole, side, &sight.corners_within(sight.part, bounds)),
                false => whole_window(side),
            };
            let middle = window.middle;
            let to_plane = pinhole.pixel_matrix(sight.origin, DVec2::from_array(middle));
            let place = if parallel { -light.direction } else { light.position - sight.origin };
            let cosine = match light.kind {
                LightKind::Spot { outer_angle, .. } => f64::from(outer_angle).cos(),
                LightKind::Directional | LightKind::Point => -2.0,
            };
            views.push(LightView {
                plane: LightPlane {
                    to_plane: to_plane.as_mat4().to_cols_array(),
                    light: place.extend(if parallel { 0.0 } else { 1.0 }).as_vec4().to_array(),
                    cone: light.direction.extend(cosine).as_vec4().to_array(),
                    range: light.range.unwrap_or(f32::INFINITY),
                    number,
                    begins: views.is_empty().into(),
                    face: if single { LightPlane::SINGLE } else { face },
                    ..LightPlane::default()
                },
                pinhole,
                window,
            });
        }
    }
    views
}

/// Rectangle around places on a plane.
fn around(places: impl Iterator<Item = DVec2>) -> Rectangle {
    let nothing = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    places.fold(nothing, |[low, high], at| [low.min(at), high.max(at)])
}

/// Window that covers a whole plane.
fn whole_window(side: u32) -> PlaneWindow {
    PlaneWindow { low: [0; 2], tiles: tiles([side; 2]), middle: [0.5 * f64::from(side); 2] }
}

/// Window with the tiles of a plane around places in the world.
fn window_around(pinhole: &Pinhole, side: u32, places: &[DVec3]) -> PlaneWindow {
    let [low, high] = around(places.iter().filter_map(|place| pinhole.project(*place)));
    // The margin is at least as large as the rounding of positions.
    let rim = RIM * f64::from(side);
    let whole = whole_window(side);
    let tile = |at: DVec2, axis: usize| (at[axis] / TILE[axis] as f64).floor() as i64;
    let last = whole.tiles.map(|tiles| i64::from(tiles) - 1);
    let first = [0, 1].map(|axis| tile(low - rim, axis).clamp(0, last[axis]));
    let end = [0, 1].map(|axis| tile(high + rim, axis).clamp(first[axis], last[axis]) + 1);
    PlaneWindow {
        low: [0, 1].map(|axis| first[axis] * TILE[axis]),
        tiles: [0, 1].map(|axis| (end[axis] - first[axis]) as u32),
        ..whole
    }
}

/// Pinholes of a light; `None` if the scene's extent vanishes in double precision.
fn pinholes(light: &Light, bounds: (DVec3, DVec3), sight: &Sight, side: u32) -> Option<Vec<Pinhole>> {
    match light.kind {
        LightKind::Directional => Some(vec![distant(light.direction, bounds, sight, side)?]),
        LightKind::Point | LightKind::Spot { .. } => local(light, bounds, side),
    }
}

/// Pinhole of a distant light. Its plane of `side` pixels covers the visible part, and the whole scene lies behind the
/// plane.
fn distant(along: DVec3, (low, high): (DVec3, DVec3), sight: &Sight, side: u32) -> Option<Pinhole> {
    let a = along.any_orthonormal_vector();
    let b = along.cross(a);
    let diagonal = (high - low).length();
    // Positions are relative to the scene's box, so that its place in the world has no effect.
    let on_plane = |place: DVec3| DVec2::new((place - low).dot(a), (place - low).dot(b));
    let places = sight.corners_within(sight.whole, (low, high));
    let [least, most] = around(places.into_iter().map(on_plane));
    let middle = 0.5 * (least + most);
    let extent = (most - least).max_element().max(1e-6 * diagonal) * (1.0 + 2.0 * RIM);
    let first = middle - 0.5 * extent;
    // Distances of the box's nearest and farthest corners.
    let size = high - low;
    let nearest = (size * along).min(DVec3::ZERO).element_sum();
    let farthest = (size * along).max(DVec3::ZERO).element_sum();
    let margin = 1e-3 * diagonal;
    let pixel = extent / f64::from(side);
    let origin = low + a * first.x + b * first.y + along * (nearest - margin);
    let depth = farthest - nearest + 2.0 * margin;
    let to_light = (-along).extend(0.0);
    Pinhole::new(to_light, origin, a * pixel, b * pixel, 0.0, Some(depth)).ok()
}

/// Pinholes of a point or spot light: one for a cone that fits on a plane of `side` pixels, otherwise a cube.
fn local(light: &Light, (low, high): (DVec3, DVec3), side: u32) -> Option<Vec<Pinhole>> {
    let (eye, axis) = (light.position, light.direction);
    let near = NEAR * (high - low).length();
    match light.kind {
        LightKind::Spot { outer_angle, .. } if f64::from(outer_angle) <= WIDEST => {
            let half = f64::from(outer_angle).tan();
            let a = axis.any_orthonormal_vector();
            let b = axis.cross(a);
            let origin = eye + axis - (a + b) * half;
            let pixel = 2.0 * half / f64::from(side);
            let pinhole = Pinhole::new(eye.extend(1.0), origin, a * pixel, b * pixel, near, None);
            Some(vec![pinhole.ok()?])
        }
        _ => Some(Rig::cube(eye, DMat3::IDENTITY, side, near).ok()?.pinholes().to_vec()),
    }
}

impl Sight {
    /// Corners of the part of a box that is visible through a rectangle; the corners of the box if no part is.
    fn corners_within(&self, seen: Rectangle, (low, high): (DVec3, DVec3)) -> Vec<DVec3> {
        let [first, last] = seen;
        let around = [first, DVec2::new(last.x, first.y), last, DVec2::new(first.x, last.y)];
        let rays = around.map(|at| self.pinhole.ray(at));
        let tips = rays.map(|ray| ray.start + ray.direction);
        let middle = tips.iter().sum::<DVec3>() * 0.25;
        // The sides of the pyramid or prism whose edges are the rays, each as a point and a vector that points
        // inwards.
        let side = |i: usize| {
            let normal = rays[i].direction.cross(tips[(i + 1) % 4] - tips[i]);
            let inwards = normal * (middle - rays[i].start).dot(normal).signum();
            (rays[i].start, inwards)
        };
        let sides = [0, 1, 2, 3].map(side);
        let corner = |bits: usize| {
            let pick = |axis: usize| {
                if bits >> axis & 1 == 0 { low[axis] } else { high[axis] }
            };
            DVec3::new(pick(0), pick(1), pick(2))
        };
        let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
        let mut corners = Vec::new();
        for face in faces {
            let whole: Vec<DVec3> = face.map(corner).to_vec();
            corners.extend(sides.iter().fold(whole, |polygon, side| clip(&polygon, *side)));
        }
        let eye = self.pinhole.eye();
        if !self.pinhole.is_parallel() && eye.cmpge(low).all() && eye.cmple(high).all() {
            corners.push(eye);
        }
        if corners.is_empty() {
            corners.extend((0..8).map(corner));
        }
        corners
    }
}

/// The part of a convex polygon in front of a plane.
fn clip(polygon: &[DVec3], (point, inwards): (DVec3, DVec3)) -> Vec<DVec3> {
    let before = |place: DVec3| (place - point).dot(inwards);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, from) in polygon.iter().enumerate() {
        let to = polygon[(i + 1) % polygon.len()];
        let (a, b) = (before(*from), before(to));
        if a >= 0.0 {
            kept.push(*from);
        }
        if (a >= 0.0) != (b >= 0.0) {
            kept.push(*from + (to - *from) * (a / (a - b)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::random::Random;

    fn sight(eye: DVec3, target: DVec3) -> Sight {
        let size = [100, 50];
        let pinhole = Pinhole::from_field_of_view(eye, target, DVec3::Y, 40.0, 0.01, size);
        Sight {
            pinhole: pinhole.unwrap(),
            whole: [DVec2::ZERO, DVec2::new(100.0, 50.0)],
            part: [DVec2::ZERO, DVec2::new(100.0, 50.0)],
            origin: DVec3::ZERO,
        }
    }

    #[test]
    fn a_distant_lights_plane_holds_all_that_is_seen() {
        let bounds = (DVec3::new(-3.0, -1.0, -20.0), DVec3::new(4.0, 2.0, 1.0));
        let mut numbers = Random::new(7);
        let mut random = || (numbers.bits() >> 40) as f64 / f64::from(1 << 24);
        let (mut held, mut in_part) = (0, 0);
        for view in 0..50 {
            let mut place = || bounds.0 + (bounds.1 - bounds.0) * DVec3::new(random(), random(), random());
            // Every other view looks at the box from outside.
            let (eye, target) = (place() * if view % 2 == 0 { 1.0 } else { 5.0 }, place());
            let seen = sight(eye, target);
            let along = (place() - target).normalize();
            let pinhole = distant(along, bounds, &seen, 128).unwrap();
            let part = [DVec2::new(10.0, 20.0), DVec2::new(30.0, 50.0)];
            let window = window_around(&pinhole, 128, &seen.corners_within(part, bounds));
            let [low, size] = [window.low.map(|v| v as f64), window.size().map(f64::from)];
            let (low, size) = (DVec2::from_array(low), DVec2::from_array(size));
            for _ in 0..200 {
                let place = bounds.0 + (bounds.1 - bounds.0) * DVec3::new(random(), random(), random());
                let is_seen = seen
                    .pinhole
                    .project(place)
                    .is_some_and(|at| at.cmpge(DVec2::ZERO).all() && at.cmple(DVec2::new(100.0, 50.0)).all());
                if is_seen {
                    let at = pinhole.project(place).unwrap();
                    assert!(at.min_element() > 0.0 && at.max_element() < 128.0, "{at} of {place}");
                    let seen_at = seen.pinhole.project(place).unwrap();
                    if seen_at.cmpge(part[0]).all() && seen_at.cmple(part[1]).all() {
                        assert!((at - low).min_element() > 0.0, "{at} {low}");
                        assert!((low + size - at).min_element() > 0.0, "{at} {low} {size}");
                        in_part += 1;
                    }
                    held += 1;
                }
            }
        }
        assert!(held > 500 && in_part > 50, "{held} {in_part}");
    }

    #[test]
    fn a_plane_is_no_larger_than_what_is_seen() {
        // The window has 2 x 1 units, at distance 10, on a plane that is perpendicular to the view and to the light.
        let bounds = (DVec3::new(-100.0, -100.0, -10.0), DVec3::new(100.0, 100.0, -10.0));
        let seen = sight(DVec3::ZERO, DVec3::NEG_Z);
        let pinhole = distant(DVec3::NEG_Z, bounds, &seen, 128).unwrap();
        let width = 2.0 * 2.0 * 10.0 * 20.0_f64.to_radians().tan();
        let found = pinhole.steps()[0].length() * 128.0;
        assert!((found / width - 1.0).abs() < 0.01, "{found} {width}");
    }

    /// The bits of a pair hold the number of a plane's tile and the rank of a triangle in its list.
    #[test]
    fn long_lists_leave_planes_fewer_tiles() {
        for longest in [0, 1, 30_000, 40_000, 1 << 20, 1 << 29] {
            let side = plane_side(1 << 22, longest);
            let tiles = side.div_ceil(8) * side.div_ceil(4);
            let ranks = 1_u64 << tiles.leading_zeros();
            assert!(ranks >= longest.into(), "{longest}: {side}");
            assert!(side == 2000 || 2 * u64::from(longest) > ranks / 4, "{longest}: {side}");
        }
    }
}

//! Crossings: whether a thin triangle crosses the cell of a sampling location without covering the location.
//!
//! Nearness is 1 / distance along the view direction, or for parallel rays minus that distance. It is linear over the
//! plane, and larger for nearer points.

use glam::{DMat2, DMat4, DVec2, DVec3, DVec4, Vec4Swizzles};
use gpc::camera::{Pinhole, SampleLocation};

/// Height / longest side, in cells, below which a triangle counts as thin. A wider triangle covers the location of
/// some cell.
pub const THIN: f64 = 1.5;

/// View of a pinhole.
#[derive(Clone, Copy, Debug)]
pub struct PinholeView {
    /// Matrix from positions to (u w, v w, w, distance).
    matrix: DMat4,
    near: f64,
    parallel: bool,
    /// Width of a pixel of the plane: at distance 1, or for parallel rays at any distance.
    pixel: f64,
}

/// Crossing of a cell by a thin triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Smallest and largest nearness of the triangle's part that lies within the cell's width, measured along the
    /// triangle's longer extent.
    pub nearness: [f64; 2],
    /// Difference of nearness that equals a cell's width, at the farther of two points.
    pub gap: f64,
    /// Clearance in cells by which the triangle crosses the cell and is thin; 0 if that is undecided.
    pub clearance: f64,
}

/// Effect of a crossing on a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// None: the triangle may be hidden behind what the cell shows, or lie in its surface.
    None,
    /// The cell becomes a superpixel if the triangle lies in the middle of another one.
    Painted,
    /// The cell becomes a superpixel.
    Apart,
}

impl PinholeView {
    /// View of a pinhole onto positions relative to `origin`.
    #[must_use]
    pub fn new(pinhole: &Pinhole, origin: DVec3) -> Self {
        let pixels = pinhole.pixel_matrix(origin, DVec2::ZERO);
        let normal = pinhole.direction();
        let distance = normal.extend(normal.dot(origin - pinhole.eye()));
        let [u, v, w] = [pixels.row(0), pixels.row(1), pixels.row(3)];
        let [a, b] = pinhole.steps();
        let to_plane = if pinhole.is_parallel() { 1.0 } else { (pinhole.origin() - pinhole.eye()).dot(normal) };
        Self {
            matrix: DMat4::from_cols(u, v, w, distance).transpose(),
            near: pinhole.near(),
            parallel: pinhole.is_parallel(),
            pixel: a.cross(b).length().sqrt() / to_plane,
        }
    }

    fn nearness(&self, distance: f64) -> f64 {
        if self.parallel { -distance } else { 1.0 / distance }
    }

    /// Nearness of what a location shows at a depth; a depth of 0 is the background, behind everything.
    #[must_use]
    pub fn behind(&self, depth: f64) -> f64 {
        match (depth == 0.0, self.parallel) {
            (true, true) => f64::NEG_INFINITY,
            (true, false) => 0.0,
            _ => self.nearness(depth),
        }
    }

    /// Crossing of a triangle through the cell of a location; `None` if it does not cross the cell or is not thin.
    #[must_use]
    pub fn crossing(&self, corners: [DVec3; 3], location: &SampleLocation) -> Option<Crossing> {
        let [column, row] = location.jacobian.map(DVec2::from_array);
        let jacobian = DMat2::from_cols(column, row);
        let area = jacobian.determinant();
        if area == 0.0 {
            return None;
        }
        let seen = corners.map(|corner| self.matrix * corner.extend(1.0));
        let shown = clipped(&seen, |v: &DVec4| v.w - self.near, DVec4::lerp);
        let at = DVec2::from_array(location.uv);
        let in_cell = |v: &DVec4| {
            let place = jacobian.inverse() * (v.xy() / v.z - at);
            place.extend(self.nearness(v.w))
        };
        let mut shown: Vec<DVec3> = shown.iter().map(in_cell).collect();
        let height = height(&shown)?;
        let [low, high] = range(&shown);
        if high.y - low.y > high.x - low.x {
            for place in &mut shown {
                (place.x, place.y) = (place.y, place.x);
            }
        }
        let left = clipped(&shown, |v| v.x + 0.5, DVec3::lerp);
        let column = clipped(&left, |v| 0.5 - v.x, DVec3::lerp);
        let [low, high] = range(&column);
        let crosses = !column.is_empty() && low.y < 0.5 && high.y >= -0.5;
        if !crosses || height >= THIN {
            return None;
        }
        let width = self.pixel * area.abs().sqrt();
        let [within, thinner] = [(0.5 - low.y).min(high.y + 0.5), THIN - height];
        Some(Crossing {
            nearness: [low.z, high.z],
            gap: if self.parallel { width } else { width * low.z },
            clearance: within.min(thinner).min(high.x - low.x),
        })
    }
}

impl Crossing {
    /// Effect on a cell that shows something at the nearness `behind`. `fold` says whether the triangle lies at an angle to
    /// it: see [`FOLD`](super::thin::FOLD).
    #[must_use]
    pub fn mark(&self, behind: f64, fold: bool) -> Mark {
        let [farthest, nearest] = self.nearness;
        if farthest - behind > self.gap || (fold && nearest >= behind) {
            Mark::Apart
        } else if nearest >= behind {
            Mark::Painted
        } else {
            Mark::None
        }
    }
}

/// Part of a convex polygon in which a linear function is not negative (Sutherland and Hodgman, "Reentrant Polygon
/// Clipping", 1974).
fn clipped<T: Copy>(polygon: &[T], inside: impl Fn(&T) -> f64, between: impl Fn(T, T, f64) -> T) -> Vec<T> {
    let following = polygon.iter().cycle().skip(1);
    let mut kept = Vec::new();
    for (v, w) in polygon.iter().zip(following) {
        let [at_v, at_w] = [inside(v), inside(w)];
        if at_v >= 0.0 {
            kept.push(*v);
        }
        if (at_v < 0.0) != (at_w < 0.0) {
            kept.push(between(*v, *w, at_v / (at_v - at_w)));
        }
    }
    kept
}

/// Lowest and highest corner of the box around places.
fn range(places: &[DVec3]) -> [DVec3; 2] {
    let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let both = |[low, high]: [DVec3; 2], at: &DVec3| [low.min(*at), high.max(*at)];
    places.iter().fold(nothing, both)
}

/// Twice the area / the distance of the farthest corners: the height of a triangle over its longest side. `None`
/// without area.
fn height(places: &[DVec3]) -> Option<f64> {
    let places: Vec<DVec2> = places.iter().map(|place| place.truncate()).collect();
    let first = *places.first()?;
    let fan = places.windows(2).map(|pair| (pair[0] - first).perp_dot(pair[1] - first));
    let area = fan.sum::<f64>().abs();
    let farthest = |p: &DVec2| places.iter().map(|q| p.distance(*q)).fold(0.0, f64::max);
    let longest = places.iter().map(farthest).fold(0.0, f64::max);
    (area > 0.0).then(|| area / longest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A view along -z from the origin. A pixel at distance 1 is 0.1 wide, and (10, 10) is straight ahead.
    fn view() -> PinholeView {
        let corner = DVec3::new(-1.0, 1.0, -1.0);
        let [a, b] = [DVec3::X * 0.1, DVec3::NEG_Y * 0.1];
        PinholeView::new(&Pinhole::new(DVec4::W, corner, a, b, 0.5, None).unwrap(), DVec3::ZERO)
    }

    fn location(uv: [f64; 2], side: f64) -> SampleLocation {
        SampleLocation { uv, jacobian: [[side, 0.0], [0.0, side]], output: 0 }
    }

    /// The strip is 0.3 high at distance 2, where a pixel is 0.2 wide: 1.5 pixels high.
    #[test]
    fn what_is_thin_is_so_in_cells() {
        let strip = [[-1.0, 0.0, -2.0], [1.0, 0.0, -2.0], [0.0, 0.28, -2.0]];
        let strip = strip.map(DVec3::from_array);
        for (side, thin) in [(1.0, true), (0.9, false), (3.0, true)] {
            let crossing = view().crossing(strip, &location([10.0, 9.9], side));
            assert_eq!(crossing.is_some(), thin, "{side}");
        }
        assert!(view().crossing(strip, &location([10.0, 12.0], 1.0)).is_none());
    }

    #[test]
    fn gaps_are_as_wide_as_cells() {
        let wire = [[-1.0, 0.0, -2.0], [1.0, 0.0, -2.0], [0.0, 0.02, -2.0]];
        for side in [0.5, 1.0, 3.0] {
            let crossing = view().crossing(wire.map(DVec3::from_array), &location([10.0, 10.0], side));
            let at = |widths: f64, fold: bool| crossing.unwrap().mark(view().behind(2.0 + 0.2 * side * widths), fold);
            let marks = |fold: bool| [at(1.6, fold), at(0.5, fold), at(-0.5, fold)];
            assert_eq!(marks(false), [Mark::Apart, Mark::Painted, Mark::None], "{side}");
            assert_eq!(marks(true), [Mark::Apart, Mark::Apart, Mark::None], "{side}");
        }
        let crossing = view().crossing(wire.map(DVec3::from_array), &location([10.0, 10.0], 1.0));
        assert_eq!(crossing.unwrap().mark(view().behind(0.0), false), Mark::Apart);
    }

    /// A wire from far ahead to behind the eye is as thin as its visible part.
    #[test]
    fn what_passes_the_eye_is_cut_at_the_near_plane() {
        let wire = [[0.0, 1.0, 9.0], [0.02, 1.0, -50.0], [0.0, 1.0, -50.0]];
        // At distance 20 the wire is half a pixel above the middle.
        let crossing = view().crossing(wire.map(DVec3::from_array), &location([10.0, 9.5], 1.0));
        let [far, near] = crossing.unwrap().nearness;
        assert!(far > 1.0 / 50.1 && near < 2.0, "{far} {near}");
    }
}

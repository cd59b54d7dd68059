//! Where a triangle appears on a pinhole's plane, and how near it is there.

use crate::camera::{Pinhole, SampleLocation};
use glam::{DMat2, DMat4, DVec2, DVec3, DVec4, Vec4Swizzles};

/// Half of a cell's side, the output's unit being a cell.
const HALF: f64 = 0.5;

/// A pinhole's way of seeing. Nearness is 1 / distance from the eye along the view direction, or
/// minus that distance where rays are parallel: linear over the plane, and larger for what is nearer.
pub struct View {
    /// Positions to (u w, v w, w, distance).
    matrix: DMat4,
    near: f64,
    parallel: bool,
    /// Width on the plane's own scale that a cell of one pixel has: per unit of distance, or of the world where rays
    /// are parallel.
    pixel: f64,
}

/// What a view shows of a window of the plane: half-spaces of (u w, v w, w, distance, 1), positive inside.
pub struct Window {
    sides: [(DVec4, f64); 5],
}

/// The part of a triangle inside a window.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    /// Its corners in pixels of the plane; they turn clockwise, as v points down.
    corners: Vec<DVec2>,
    /// What `corners` are made from, and where they are clipped.
    clipped: [Vec<DVec4>; 2],
    low: DVec2,
    high: DVec2,
    breadth: f64,
    /// Nearness as a function of (u, v, 1).
    plane: DVec3,
    /// The least and the largest.
    range: [f64; 2],
}

impl View {
    /// How a pinhole sees positions relative to `origin`.
    pub fn new(pinhole: &Pinhole, origin: DVec3) -> Self {
        let pixels = pinhole.pixel_matrix(origin, DVec2::ZERO);
        let normal = pinhole.direction();
        let distance = normal.extend(normal.dot(origin - pinhole.eye()));
        let [u, v, w] = [pixels.row(0), pixels.row(1), pixels.row(3)];
        let [a, b] = pinhole.steps();
        let to_plane = if pinhole.is_parallel() {
            1.0
        } else {
            (pinhole.origin() - pinhole.eye()).dot(normal)
        };
        Self {
            matrix: DMat4::from_cols(u, v, w, distance).transpose(),
            near: pinhole.near(),
            parallel: pinhole.is_parallel(),
            pixel: a.cross(b).length().sqrt() / to_plane,
        }
    }

    /// The window from `low` to `high` in pixels of the plane.
    pub fn window(&self, [low, high]: [DVec2; 2]) -> Window {
        let [x, y, w, distance] = [DVec4::X, DVec4::Y, DVec4::Z, DVec4::W];
        let sides = [
            (distance, -self.near),
            (x - low.x * w, 0.0),
            (high.x * w - x, 0.0),
            (y - low.y * w, 0.0),
            (high.y * w - y, 0.0),
        ];
        Window { sides }
    }

    /// Whether a window may show something of the box between two corners.
    pub fn may_show(&self, window: &Window, [low, high]: [DVec3; 2]) -> bool {
        let centre = (0.5 * (low + high)).extend(1.0);
        let half = (0.5 * (high - low)).extend(0.0);
        window.sides.iter().all(|(factors, constant)| {
            let factors = self.matrix.transpose() * *factors;
            factors.dot(centre) + factors.abs().dot(half) + constant >= 0.0
        })
    }

    /// Nearness at a distance along the view direction.
    fn nearness(&self, distance: f64) -> f64 {
        if self.parallel {
            -distance
        } else {
            1.0 / distance
        }
    }

    /// Nearness of what a location sees at a depth; a depth of 0 is the background, with nothing behind it.
    pub fn behind(&self, depth: f32) -> f64 {
        match (depth == 0.0, self.parallel) {
            (true, true) => f64::NEG_INFINITY,
            (true, false) => 0.0,
            _ => self.nearness(f64::from(depth)),
        }
    }

    /// Difference of nearness between a surface and one that is a cell's width behind it.
    pub fn gap(&self, nearness: f64, location: &SampleLocation) -> f64 {
        let [[a, b], [c, d]] = location.jacobian;
        let width = self.pixel * (a * d - b * c).abs().sqrt();
        if self.parallel {
            width
        } else {
            width * nearness
        }
    }

    /// Puts the outline of a triangle into `outline`. `false` if nothing of it is seen: it shows its back and has but
    /// one side, lies outside of the window or in front of it, or is seen edge-on.
    pub fn outline(
        &self,
        window: &Window,
        corners: [DVec3; 3],
        double_sided: bool,
        outline: &mut Outline,
    ) -> bool {
        let seen = corners.map(|corner| self.matrix * corner.extend(1.0));
        let [a, b, c] = seen.map(|v| v.xyz());
        let [ab, bc, ca] = [a.cross(b), b.cross(c), c.cross(a)];
        let determinant = a.dot(bc);
        // v points down, so that a front face has a negative determinant.
        if !(determinant < 0.0 || double_sided && determinant > 0.0) {
            return false;
        }
        if !outline.clip(seen, &window.sides) {
            return false;
        }
        let [from_a, from_b, from_c] = seen.map(|v| if self.parallel { -v.w } else { 1.0 });
        outline.plane = (from_a * bc + from_b * ca + from_c * ab) / determinant;
        let [current, _] = &outline.clipped;
        let nearness = current.iter().map(|v| self.nearness(v.w));
        outline.range = nearness.fold([f64::INFINITY, f64::NEG_INFINITY], |[far, near], v| {
            [v.min(far), v.max(near)]
        });
        outline.measure();
        true
    }
}

impl Outline {
    /// Leaves what is inside all half-spaces (Sutherland and Hodgman, "Reentrant Polygon Clipping", 1974); `false` if
    /// that has no area.
    fn clip(&mut self, triangle: [DVec4; 3], sides: &[(DVec4, f64)]) -> bool {
        let [current, next] = &mut self.clipped;
        current.clear();
        current.extend(triangle);
        for (factors, constant) in sides {
            let inside = |v: &DVec4| factors.dot(*v) + constant;
            if current.iter().all(|v| inside(v) >= 0.0) {
                continue;
            }
            next.clear();
            let following = current.iter().cycle().skip(1);
            for (v, w) in current.iter().zip(following) {
                let [at_v, at_w] = [inside(v), inside(w)];
                if at_v >= 0.0 {
                    next.push(*v);
                }
                if (at_v < 0.0) != (at_w < 0.0) {
                    next.push(v.lerp(*w, at_v / (at_v - at_w)));
                }
            }
            std::mem::swap(current, next);
            if current.len() < 3 {
                return false;
            }
        }
        true
    }

    /// Everything that follows from the corners.
    fn measure(&mut self) {
        let [current, _] = &self.clipped;
        self.corners.clear();
        self.corners.extend(current.iter().map(|v| v.xy() / v.z));
        let corners = self.corners.as_slice();
        self.low = corners.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        self.high = corners
            .iter()
            .copied()
            .fold(DVec2::NEG_INFINITY, DVec2::max);
        let first = corners.first().copied().unwrap_or_default();
        let fan = corners.windows(2).map(|pair| match pair {
            [p, q] => (*p - first).perp_dot(*q - first),
            _ => 0.0,
        });
        let area = 0.5 * fan.sum::<f64>();
        let following = |place| corners.iter().skip(place + 1);
        let longest = corners
            .iter()
            .enumerate()
            .flat_map(|(place, p)| following(place).map(move |q| p.distance_squared(*q)))
            .fold(0.0, f64::max);
        if area < 0.0 {
            self.corners.reverse();
        }
        self.breadth = area.abs() / longest.sqrt();
    }

    /// Its area over the distance of its farthest corners, in pixels: at most its height over any of its sides.
    pub fn breadth(&self) -> f64 {
        self.breadth
    }

    /// Its largest nearness.
    pub fn nearest(&self) -> f64 {
        self.range[1]
    }

    /// Pairs of corners, in turn.
    fn edges(corners: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> {
        let last = corners.last().into_iter();
        last.chain(corners).copied().zip(corners.iter().copied())
    }

    /// Whether it touches an upright rectangle of the plane.
    pub fn touches(&self, low: DVec2, high: DVec2) -> bool {
        let overlaps = self.low.cmple(high).all() && self.high.cmpge(low).all();
        let lies_within = || self.low.cmpge(low).all() && self.high.cmple(high).all();
        let meets = || no_edge_separates(&self.corners, 0.5 * (low + high), 0.5 * (high - low));
        overlaps && (lies_within() || meets())
    }

    /// The least and largest nearness in the cell of a location that it crosses, and its height over its longest side
    /// there with the cell as the unit.
    pub fn across(
        &self,
        location: &SampleLocation,
        scratch: &mut Vec<DVec2>,
    ) -> Option<([f64; 2], f64)> {
        let [column, row] = location.jacobian.map(DVec2::from_array);
        let at = DVec2::from_array(location.uv);
        let half = HALF * (column.abs() + row.abs());
        if (at - half).cmpgt(self.high).any() || (at + half).cmplt(self.low).any() {
            return None;
        }
        let jacobian = DMat2::from_cols(column, row);
        let determinant = jacobian.determinant();
        if determinant == 0.0 {
            return None;
        }
        let to_output = jacobian.inverse();
        scratch.clear();
        scratch.extend(self.corners.iter().map(|corner| to_output * (*corner - at)));
        if determinant < 0.0 {
            scratch.reverse();
        }
        let low = scratch.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = scratch
            .iter()
            .copied()
            .fold(DVec2::NEG_INFINITY, DVec2::max);
        let beside = low.max_element() > HALF || high.min_element() < -HALF;
        if beside || !no_edge_separates(scratch, DVec2::ZERO, DVec2::splat(HALF)) {
            return None;
        }
        let gradient = self.plane.truncate();
        let middle = gradient.dot(at) + self.plane.z;
        let slope = HALF * (gradient.dot(column).abs() + gradient.dot(row).abs());
        let [far, near] = self.range;
        let nearness = [middle - slope, middle + slope].map(|v| v.max(far).min(near));
        Some((nearness, height(scratch)))
    }
}

/// Whether no edge of a convex outline, whose corners turn clockwise as v points down, has an upright rectangle on its
/// outer side.
fn no_edge_separates(corners: &[DVec2], centre: DVec2, half: DVec2) -> bool {
    Outline::edges(corners).all(|(p, q)| {
        let inward = (q - p).perp();
        inward.dot(centre - p) + inward.abs().dot(half) >= 0.0
    })
}

/// Height over the longest side.
fn height(corners: &[DVec2]) -> f64 {
    let longest = Outline::edges(corners)
        .max_by(|(p, q), (r, s)| p.distance_squared(*q).total_cmp(&r.distance_squared(*s)));
    let Some((p, q)) = longest else { return 0.0 };
    let heights = corners
        .iter()
        .map(|corner| (q - p).perp_dot(*corner - p).abs());
    heights.fold(0.0, f64::max) / p.distance(q)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looks along -z from the origin; a pixel at distance 1 is 0.1 wide, and (10, 10) is straight ahead.
    fn pinhole() -> Pinhole {
        let corner = DVec3::new(-1.0, 1.0, -1.0);
        let [a, b] = [DVec3::X * 0.1, DVec3::NEG_Y * 0.1];
        Pinhole::new(DVec4::W, corner, a, b, 0.5, None).unwrap()
    }

    const WINDOW: [DVec2; 2] = [DVec2::ZERO, DVec2::splat(20.0)];

    fn location(uv: [f64; 2], side: f64) -> SampleLocation {
        SampleLocation {
            uv,
            jacobian: [[side, 0.0], [0.0, side]],
            output: 0,
        }
    }

    fn outlined(corners: [[f64; 3]; 3], double_sided: bool) -> Option<Outline> {
        let view = View::new(&pinhole(), DVec3::ZERO);
        let mut outline = Outline::default();
        let corners = corners.map(DVec3::from_array);
        view.outline(&view.window(WINDOW), corners, double_sided, &mut outline)
            .then_some(outline)
    }

    #[test]
    fn only_faces_in_the_window_have_an_outline() {
        let front = [[0.0, 0.0, -2.0], [1.0, 0.0, -2.0], [0.0, 1.0, -2.0]];
        let [a, b, c] = front;
        assert!(outlined(front, false).is_some());
        assert!(outlined([a, c, b], false).is_none());
        assert!(outlined([a, c, b], true).is_some());
        let moved = |by: [f64; 3]| front.map(|corner| [0, 1, 2].map(|i| corner[i] + by[i]));
        assert!(outlined(moved([3.0, 0.0, 0.0]), false).is_none());
        assert!(outlined(moved([0.0, 0.0, 4.0]), true).is_none());
        assert!(
            outlined(moved([0.0, 0.0, 1.6]), false).is_none(),
            "before the near plane"
        );
        assert!(
            outlined([a, b, [0.5, 0.0, -2.0]], true).is_none(),
            "edge-on"
        );
    }

    /// A strip from far ahead to behind the eye is as wide as what the window shows of it.
    #[test]
    fn what_passes_the_eye_is_clipped_to_the_window() {
        let strip = outlined(
            [[0.0, 1.0, 9.0], [0.02, 1.0, -50.0], [0.0, 1.0, -50.0]],
            true,
        );
        let strip = strip.unwrap();
        assert!(strip.low.y > -1e-9 && strip.high.y < 10.0, "{strip:?}");
        assert!(strip.breadth() < 0.2, "{strip:?}");
    }

    #[test]
    fn nearness_is_that_of_the_cell() {
        // A wall that leans: distance 2 to the left, 4 to the right.
        let wall = outlined(
            [[-2.0, -9.0, -2.0], [4.0, -9.0, -4.0], [-2.0, 9.0, -2.0]],
            true,
        );
        let wall = wall.unwrap();
        let mut scratch = Vec::new();
        let mut across = |u: f64, side| wall.across(&location([u, 10.0], side), &mut scratch);
        let ([far, near], _) = across(5.0, 2.0).unwrap();
        // u = 10 + 10 x / d, with x = 3 d - 8 on the wall.
        let distance = |u: f64| 80.0 / (40.0 - u);
        assert!((near - 1.0 / distance(4.0)).abs() < 1e-12, "{near}");
        assert!((far - 1.0 / distance(6.0)).abs() < 1e-12, "{far}");
        assert!(across(21.5, 1.0).is_none());
    }

    /// Half as wide and deep, cells make twice the height of the same triangle, and half the gap.
    #[test]
    fn height_and_gap_are_in_cells() {
        let view = View::new(&pinhole(), DVec3::ZERO);
        let strip = [[-1.0, 0.0, -2.0], [1.0, 0.0, -2.0], [0.0, 0.3, -2.0]];
        let strip = outlined(strip, false).unwrap();
        for (side, height) in [(1.0, 1.5), (0.5, 3.0), (3.0, 0.5)] {
            let location = location([10.0, 10.0], side);
            let (_, found) = strip.across(&location, &mut Vec::new()).unwrap();
            assert!((found - height).abs() < 1e-12, "{found}");
            // A surface at distance 2, where a cell is 0.2 wide, and one about a cell behind.
            let nearness = view.nearness(2.0);
            let behind = |widths: f64| view.nearness(2.0 + 0.2 * side * widths);
            let gap = view.gap(nearness, &location);
            assert!(
                nearness - behind(0.5) < gap && nearness - behind(1.6) > gap,
                "{side}"
            );
        }
    }
}

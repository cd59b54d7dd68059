//! Polygons that lines and points cover in an image, and the choice of the mesh edges that are drawn.
//!
//! A vertex is in clip space: (pixel x * w, pixel y * w, z, w). On the near plane, z = w; farther from the eye, z < w.
//! Polygons are in pixels and counter-clockwise on the screen, whose y points down.

/// A vertex in clip space.
pub type Clip = [f64; 4];

/// Longest mitre, in widths of the line; a sharper joint is bevelled.
const LONGEST_MITRE: f64 = 4.0;

/// Number of corners of a disc's polygon.
const DISC_CORNERS: u32 = 16;

/// Part of a segment with z <= w, so not nearer than the near plane; `None` if there is no such part.
fn clipped(from: Clip, to: Clip) -> Option<[Clip; 2]> {
    let before = |p: Clip| p[3] - p[2];
    let at_plane = |front: Clip, behind: Clip| {
        let t = before(front) / (before(front) - before(behind));
        [0, 1, 2, 3].map(|i| front[i] + t * (behind[i] - front[i]))
    };
    match (before(from) >= 0.0, before(to) >= 0.0) {
        (true, true) => Some([from, to]),
        (true, false) => Some([from, at_plane(from, to)]),
        (false, true) => Some([at_plane(to, from), to]),
        (false, false) => None,
    }
}

fn pixel(p: Clip) -> [f64; 2] {
    [p[0] / p[3], p[1] / p[3]]
}

/// Direction and length in pixels of the visible part of the segment from `p` to `q`; `None` if it has no length.
fn way(p: Clip, q: Clip) -> Option<([f64; 2], f64)> {
    let [a, b] = clipped(p, q)?.map(pixel);
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let length = x.hypot(y);
    (length > 0.0).then(|| ([x / length, y / length], length))
}

fn left_of([x, y]: [f64; 2]) -> [f64; 2] {
    [y, -x]
}

fn moved(p: [f64; 2], by: [f64; 2], factor: f64) -> [f64; 2] {
    [p[0] + factor * by[0], p[1] + factor * by[1]]
}

/// Joint of two segments of a line.
enum Joint {
    /// Mitre: the vector from the middle of the line to the left end of the mitre, in halves of the width.
    Mitre([f64; 2]),
    /// Bevel: the directions of both segments, and whether the line turns right.
    Cut([[f64; 2]; 2], bool),
}

/// Joint at `at` between the segments from `from` and to `to`; `None` unless both are visible there.
fn joint_at(from: Clip, at: Clip, to: Clip, width: f64) -> Option<Joint> {
    if at[2] > at[3] {
        return None;
    }
    let (back, first) = way(at, from)?;
    let (e, second) = (back.map(|x| -x), way(at, to)?);
    let (f, second) = second;
    let cosine = e[0] * f[0] + e[1] * f[1];
    let sine = e[0] * f[1] - e[1] * f[0];
    // This is the square of the cosine of half the angle.
    let squared_cosine = 0.5 * (1.0 + cosine);
    let fits = 0.5 * width * sine.abs() <= (1.0 + cosine) * first.min(second);
    if squared_cosine * LONGEST_MITRE * LONGEST_MITRE >= 1.0 && fits {
        let middle = [e[0] + f[0], e[1] + f[1]];
        let scale = 1.0 / (2.0 * squared_cosine);
        return Some(Joint::Mitre(left_of(middle).map(|x| x * scale)));
    }
    Some(Joint::Cut([e, f], sine > 0.0))
}

/// Polygon of a line `width` pixels wide between `from` and `to`; the line comes from `before` and continues to
/// `after`, if they exist.
#[must_use]
pub fn segment(before: Option<Clip>, [from, to]: [Clip; 2], after: Option<Clip>, width: f64) -> Vec<[f64; 2]> {
    let (Some(seen), Some((direction, _))) = (clipped(from, to), way(from, to)) else {
        return Vec::new();
    };
    let left = |joint: Option<Joint>| match joint {
        Some(Joint::Mitre(left)) => left,
        _ => left_of(direction),
    };
    let start = left(before.and_then(|before| joint_at(before, from, to, width)));
    let end = left(after.and_then(|after| joint_at(from, to, after, width)));
    let [a, b] = seen.map(pixel);
    let half = 0.5 * width;
    vec![moved(a, start, -half), moved(b, end, -half), moved(b, end, half), moved(a, start, half)]
}

/// Polygon that fills the joint of two segments if a mitre would be too long.
#[must_use]
pub fn joint(from: Clip, at: Clip, to: Clip, width: f64) -> Vec<[f64; 2]> {
    let Some(Joint::Cut([e, f], turns_right)) = joint_at(from, at, to, width) else {
        return Vec::new();
    };
    let middle = pixel(at);
    let (ends, side) = if turns_right { ([f, e], 0.5 * width) } else { ([e, f], -0.5 * width) };
    let [second, third] = ends.map(|direction| moved(middle, left_of(direction), side));
    vec![middle, second, third]
}

/// Polygon of a point with the diameter `size` in pixels; it has the area of the disc.
#[must_use]
pub fn disc(at: Clip, size: f64) -> Vec<[f64; 2]> {
    if at[2] > at[3] {
        return Vec::new();
    }
    let step = std::f64::consts::TAU / f64::from(DISC_CORNERS);
    let radius = 0.5 * size * (step / step.sin()).sqrt();
    let corner = |k: u32| {
        let (sin, cos) = (step * f64::from(k)).sin_cos();
        moved(pixel(at), [cos, -sin], radius)
    };
    (0..DISC_CORNERS).map(corner).collect()
}

/// Polygon of a mesh edge that is drawn `width` pixels wide, if the depths of its ends are similar.
#[must_use]
pub fn edge(ends: [Clip; 2], is_smooth: bool, width: f64) -> Vec<[f64; 2]> {
    let [from, to] = ends;
    let (Some(seen), Some((direction, _))) = (clipped(from, to), way(from, to)) else {
        return Vec::new();
    };
    let half = 0.5 * width;
    let beyond = if is_smooth { 0.25 * half } else { half };
    let [a, b] = seen.map(pixel);
    let (a, b) = (moved(a, direction, -beyond), moved(b, direction, beyond));
    let left = left_of(direction);
    vec![moved(a, left, -half), moved(b, left, -half), moved(b, left, half), moved(a, left, half)]
}

/// Origin of the lines of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Eye {
    /// Position of the eye.
    At([f64; 3]),
    /// Direction of all lines of sight, for an orthographic camera.
    Along([f64; 3]),
}

/// Edge of a mesh in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Ends of the edge.
    pub ends: [[f64; 3]; 2],
    /// Third corners of its faces: of the face in which the edge runs from the first end to the second, and of the
    /// other one.
    pub faces: [Option<[f64; 3]>; 2],
    /// Whether the edge is visible only as a silhouette.
    pub is_smooth: bool,
    /// Whether the edge is visible even if its faces are seen from behind.
    pub is_double_sided: bool,
}

impl Edge {
    /// Whether the edge is drawn.
    #[must_use]
    pub fn shows(&self, eye: Eye) -> bool {
        let minus = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|i| p[i] - q[i]);
        let [a, b] = self.ends;
        let view = match eye {
            Eye::At(place) => minus(place, a),
            Eye::Along(direction) => direction.map(|x| -x),
        };
        let [x, y, z] = minus(b, a);
        let [front, back] = self.faces.map(|third| {
            let third = minus(third?, a);
            let normal = [y * third[2] - z * third[1], z * third[0] - x * third[2], x * third[1] - y * third[0]];
            let facing: f64 = (0..3).map(|i| normal[i] * view[i]).sum();
            Some(facing)
        });
        let (front, back) = (front.is_some_and(|facing| facing > 0.0), back.is_some_and(|facing| facing < 0.0));
        if self.is_smooth { front != back } else { self.is_double_sided || front || back }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64) -> Clip {
        [3.0 * x, 3.0 * y, 1.0, 3.0]
    }

    fn area(polygon: &[[f64; 2]]) -> f64 {
        let next = polygon.iter().cycle().skip(1);
        let twice: f64 = polygon.iter().zip(next).map(|(p, q)| p[1] * q[0] - p[0] * q[1]).sum();
        0.5 * twice
    }

    #[test]
    fn areas_are_widths_times_lengths() {
        let line = segment(None, [at(1.0, 2.0), at(4.0, 6.0)], None, 0.3);
        assert!((area(&line) - 1.5).abs() < 1e-12);
        // A mitre adds as much area outside as it removes inside.
        let (a, b, c) = (at(0.0, 0.0), at(10.0, 0.0), at(10.0, 10.0));
        let both = area(&segment(None, [a, b], Some(c), 2.0)) + area(&segment(Some(a), [b, c], None, 2.0));
        assert!((both - 40.0).abs() < 1e-12, "{both}");
        assert!(joint(a, b, c, 2.0).is_empty());
        let size = 5.0;
        let disc = area(&disc(at(-3.0, 2.0), size));
        assert!((disc - 0.25 * std::f64::consts::PI * size * size).abs() < 1e-12);
    }

    #[test]
    fn sharp_joints_are_cut_off() {
        let (a, b) = (at(0.0, 0.0), at(10.0, 0.0));
        for (c, other) in [(at(0.0, 1.0), false), (at(0.0, -1.0), true)] {
            let fill = joint(a, b, c, 2.0);
            assert!(area(&fill) > 0.0, "{fill:?}");
            let outside = if other { 1.0 } else { -1.0 };
            assert!(fill.iter().all(|p| p[1] * outside >= -1.0 && p[0] >= 10.0 - 1e-12));
        }
        // This joint is as sharp as a mitre may be: four widths long.
        let turn = 2.0 * (1.0_f64 / 4.0).acos();
        let c = |turn: f64| at(10.0 + 100.0 * turn.cos(), 100.0 * turn.sin());
        assert!(joint(at(-100.0, 0.0), b, c(turn - 1e-6), 2.0).is_empty());
        assert!(!joint(at(-100.0, 0.0), b, c(turn + 1e-6), 2.0).is_empty());
        // The mitre would be longer than one of the segments.
        assert!(!joint(at(9.5, 0.0), b, at(10.0, 10.0), 2.0).is_empty());
    }

    #[test]
    fn edges_show_where_a_face_does() {
        let edge = Edge {
            ends: [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]],
            faces: [Some([-1.0, 0.0, -0.1]), Some([1.0, 0.0, -0.1])],
            is_smooth: true,
            is_double_sided: false,
        };
        let from = |x: f64, z: f64| Eye::At([x, 0.0, z]);
        // The edge is seen from in front, from the side and from behind.
        let places = [from(0.0, 5.0), from(5.0, 0.0), from(0.0, -5.0)];
        assert_eq!(places.map(|eye| edge.shows(eye)), [false, true, false]);
        assert!(edge.shows(Eye::Along([-1.0, 0.0, 0.0])));
        let sharp = Edge { is_smooth: false, ..edge };
        assert_eq!(places.map(|eye| sharp.shows(eye)), [true, true, false]);
        let border = Edge { faces: [edge.faces[0], None], ..sharp };
        assert_eq!(places.map(|eye| border.shows(eye)), [true, false, false]);
        let both = Edge { is_double_sided: true, ..border };
        assert_eq!(places.map(|eye| both.shows(eye)), [true; 3]);
    }

    #[test]
    fn what_lies_behind_the_near_plane_is_cut_off() {
        // The line runs from the middle of the image to behind the eye, so that it leaves the image upwards.
        let (from, to) = ([0.0, 0.0, 1.0, 3.0], [-100.0, -100.0, 1.0, -1.0]);
        let line = segment(None, [from, to], None, 1.0);
        assert_eq!(line.len(), 4);
        let far = [[-50.0, -50.0]; 2];
        for (p, q) in line[1..3].iter().zip(far) {
            assert!((p[0] - q[0]).hypot(p[1] - q[1]) < 0.5 + 1e-9, "{line:?}");
        }
        assert!(segment(None, [to, to], None, 1.0).is_empty());
        assert!(segment(None, [from, from], None, 1.0).is_empty());
        assert!(disc(to, 3.0).is_empty());
    }
}

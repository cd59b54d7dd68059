//! Points and lines of a primitive, as triangles whose corners a renderer places for each camera.

use gltf::json::mesh::Mode;

use super::triangles;
use crate::scene::stroke::StrokePart;

/// Corner of a point or line, with vertices of one primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    pub part: StrokePart,
    /// Index of the vertex to which the corner belongs. `other` is the vertex at the other end of its segment,
    /// `beyond` the one to which the line continues; each equals `at` if there is none.
    pub at: u32,
    pub other: u32,
    pub beyond: u32,
}

/// Points or lines of a primitive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Strokes {
    pub triangles: Vec<[u32; 3]>,
    /// Corners. The last vertices of the primitive belong to them, in the same order.
    pub corners: Vec<Corner>,
}

/// Whether a topology consists of points or lines (glTF 2.0, section 3.7.2.1).
pub fn are_made_of(mode: Mode) -> bool {
    matches!(mode, Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip)
}

/// Largest number of triangles that `count` indices make; 0 for topologies of triangles.
pub fn number(mode: Mode, count: usize) -> usize {
    match mode {
        Mode::Points => count.saturating_mul(StrokePart::DISC_CORNERS as usize - 2),
        Mode::Lines => count / 2 * 2,
        Mode::LineLoop | Mode::LineStrip => count.saturating_mul(3),
        Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan => 0,
    }
}

/// Points or lines along a path of vertices, which `None` interrupts. No line connects vertices that are the `same`.
/// In [`Mode::Lines`], consecutive segments that share a vertex become one line.
pub fn assemble(mode: Mode, path: &[Option<u32>], same: impl Fn(u32, u32) -> bool) -> Strokes {
    let mut strokes = Strokes::default();
    match mode {
        Mode::Points => {
            let points: Vec<u32> = path.iter().copied().flatten().collect();
            strokes = Strokes::points(&points);
        }
        Mode::Lines => {
            let mut line: Vec<u32> = Vec::new();
            for pair in path.as_chunks().0 {
                let [Some(from), Some(to)] = *pair else {
                    continue;
                };
                if same(from, to) {
                    continue;
                }
                if line.last() != Some(&from) {
                    strokes.add_path(&mut line);
                    line.push(from);
                }
                line.push(to);
            }
            strokes.add_path(&mut line);
        }
        _ => {
            let closes = mode == Mode::LineLoop;
            let closed = closes && path.iter().all(Option::is_some);
            let back = path.first().filter(|_| closes && !closed);
            let whole: Vec<Option<u32>> = path.iter().chain(back).copied().collect();
            for part in whole.split(Option::is_none) {
                let mut part: Vec<u32> = part.iter().copied().flatten().collect();
                part.dedup_by(|a, b| same(*a, *b));
                if closed {
                    while part.len() > 1 && part.first().zip(part.last()).is_some_and(|(a, b)| same(*a, *b)) {
                        part.pop();
                    }
                }
                strokes.add_line(&part, closed);
            }
        }
    }
    strokes
}

impl Strokes {
    /// Discs around vertices.
    fn points(points: &[u32]) -> Self {
        let mut strokes = Self::default();
        for &at in points {
            let first = strokes.corners.len() as u32;
            strokes.corners.extend((0..StrokePart::DISC_CORNERS).map(|index| Corner {
                part: StrokePart::Disc(index),
                at,
                other: at,
                beyond: at,
            }));
            let fan = (1..StrokePart::DISC_CORNERS - 1).map(|k| [first, first + k, first + k + 1]);
            strokes.triangles.extend(fan);
        }
        strokes
    }

    /// Adds a line through the vertices of `path`, which is emptied. The line is closed if it ends where it begins.
    fn add_path(&mut self, path: &mut Vec<u32>) {
        let closed = path.len() > 2 && path.first() == path.last();
        if closed {
            path.pop();
        }
        self.add_line(path, closed);
        path.clear();
    }

    /// Adds a line through vertices; if it is `closed`, the last is joined to the first.
    fn add_line(&mut self, path: &[u32], closed: bool) {
        let count = path.len();
        if count < 2 {
            return;
        }
        let vertex = |index: usize| path.get(index).copied();
        let wrapped = |index: usize| if closed { vertex(index % count) } else { None };
        for s in 0..if closed { count } else { count - 1 } {
            let before = if s > 0 { vertex(s - 1) } else { wrapped(count - 1) };
            let after = vertex(s + 2).or_else(|| wrapped(s + 2));
            if let (Some(from), Some(to)) = (vertex(s), vertex(s + 1).or_else(|| wrapped(s + 1))) {
                self.add_segment(before, from, to, after);
            }
        }
    }

    /// Adds a segment of a line, and the joint to the one after it.
    fn add_segment(&mut self, before: Option<u32>, from: u32, to: u32, after: Option<u32>) {
        let first = self.corners.len() as u32;
        let start = |part| Corner { part, at: from, other: to, beyond: before.unwrap_or(from) };
        let end = |part| Corner { part, at: to, other: from, beyond: after.unwrap_or(to) };
        use StrokePart::{JointCentre, JointFirst, JointSecond, Left, Right};
        self.corners.extend([start(Left), end(Right), end(Left), start(Right)]);
        self.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|v| first + v)));
        if after.is_some() {
            self.corners.extend([JointCentre, JointFirst, JointSecond].map(end));
            self.triangles.push([4, 5, 6].map(|v| first + v));
        }
    }

    /// Removes vertices that are not used. Returns the indices of the used vertices, followed by one for each corner,
    /// and renumbers the strokes to positions in this list.
    pub fn compact(&mut self, vertex_count: usize) -> Vec<u32> {
        let named = |corner: &Corner| [corner.at, corner.other, corner.beyond];
        let mut named: Vec<[u32; 3]> = self.corners.iter().map(named).collect();
        let used = triangles::compact(&mut named, vertex_count);
        for (corner, [at, other, beyond]) in self.corners.iter_mut().zip(named) {
            *corner = Corner { at, other, beyond, ..*corner };
        }
        for vertex in self.triangles.as_flattened_mut() {
            *vertex += used.len() as u32;
        }
        let of_corners: Vec<u32> =
            self.corners.iter().filter_map(|corner| used.get(corner.at as usize).copied()).collect();
        used.into_iter().chain(of_corners).collect()
    }
}

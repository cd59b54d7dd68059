//! Which locations' cells a convex outline may touch.
//!
//! Locations in the order of a Morton curve over the plane, under a tree of bounding boxes: each node holds [`FAN`] nodes of
//! the level below, each of the lowest level as many locations. It costs no area, however far apart or crowded locations are.

use super::outline::Outline;
use super::rule::THIN;
use crate::camera::SampleLocation;
use crate::passes::Cells;
use crate::render::locations::partition::half_extent;
use glam::DVec2;
use rayon::prelude::*;

/// Children of a node.
const FAN: usize = 8;

/// Locations under a tree of boxes.
pub struct LocationTree {
    /// Places of the locations in their list, along the curve.
    order: Vec<u32>,
    /// From the lowest level to the root.
    levels: Vec<Vec<Node>>,
}

/// What some cells have in common.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: DVec2,
    high: DVec2,
    /// The most that a unit of the output is stretched to on the plane, in pixels, or more (Frobenius norm).
    stretch: f64,
    /// The least nearness of what a cell shows.
    behind: f64,
}

impl Node {
    const NOTHING: Self = Self {
        low: DVec2::INFINITY,
        high: DVec2::NEG_INFINITY,
        stretch: 0.0,
        behind: f64::INFINITY,
    };

    fn of(location: &SampleLocation, behind: f64) -> Self {
        let at = DVec2::from_array(location.uv);
        let half = DVec2::from_array(half_extent(location, Cells::Superpixels));
        let squares = location.jacobian.iter().flatten().map(|v| v * v);
        Self {
            low: at - half,
            high: at + half,
            stretch: squares.sum::<f64>().sqrt(),
            behind,
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            stretch: self.stretch.max(other.stretch),
            behind: self.behind.min(other.behind),
        }
    }

    fn may_hold(&self, outline: &Outline) -> bool {
        outline.touches(self.low, self.high)
            && outline.breadth() < THIN * self.stretch
            && outline.nearest() >= self.behind
    }
}

impl LocationTree {
    /// The tree of some locations, whose numbers are finite; `behind` is the nearness of what the cell of each shows.
    pub fn new(
        locations: &[SampleLocation],
        behind: impl Fn(&SampleLocation) -> f64 + Sync,
    ) -> Self {
        let places = locations
            .iter()
            .map(|location| DVec2::from_array(location.uv));
        let (low, high) = places.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), at| {
            (low.min(at), high.max(at))
        });
        let scale = f64::from(u32::MAX) / (high - low).max_element().max(f64::MIN_POSITIVE);
        let mut keyed: Vec<(u64, u32)> = locations
            .par_iter()
            .enumerate()
            .map(|(index, location)| {
                let place = (DVec2::from_array(location.uv) - low) * scale;
                let key = spread(place.y as u32) << 1 | spread(place.x as u32);
                (key, index as u32)
            })
            .collect();
        keyed.par_sort_unstable();
        let order: Vec<u32> = keyed.into_iter().map(|(_, index)| index).collect();
        let cells = |part: &[u32]| {
            let cells = part
                .iter()
                .filter_map(|index| locations.get(*index as usize));
            let nodes = cells.map(|location| Node::of(location, behind(location)));
            nodes.fold(Node::NOTHING, Node::and)
        };
        let mut levels: Vec<Vec<Node>> = vec![order.par_chunks(FAN).map(cells).collect()];
        while let Some(below) = levels.last().filter(|level| level.len() > 1) {
            let nodes = below.chunks(FAN);
            let above = nodes.map(|part| part.iter().copied().fold(Node::NOTHING, Node::and));
            levels.push(above.collect());
        }
        Self { order, levels }
    }

    /// Corners of the box around all cells.
    pub fn bounds(&self) -> [DVec2; 2] {
        let root = self.root();
        [root.low, root.high]
    }

    /// Hands the places in their list of all locations whose cells a thin outline may touch unhidden, and of some more, to
    /// `found`.
    pub fn search(&self, outline: &Outline, found: &mut impl FnMut(u32)) {
        self.descend(self.levels.len(), 0, outline, found);
    }

    /// Searches the nodes of the level below `level` that are the children of its node `index`.
    fn descend(&self, level: usize, index: usize, outline: &Outline, found: &mut impl FnMut(u32)) {
        let children = index * FAN..(index + 1) * FAN;
        let Some(below) = level.checked_sub(1) else {
            let end = children.end.min(self.order.len());
            let locations = self.order.get(children.start..end).unwrap_or(&[]);
            return locations.iter().copied().for_each(found);
        };
        let nodes = self.levels.get(below).map_or(&[][..], Vec::as_slice);
        let end = children.end.min(nodes.len());
        let nodes = nodes.get(children.start..end).unwrap_or(&[]);
        for (child, node) in (children.start..).zip(nodes) {
            if node.may_hold(outline) {
                self.descend(below, child, outline, found);
            }
        }
    }

    fn root(&self) -> Node {
        let top = self.levels.last().and_then(|level| level.first());
        top.copied().unwrap_or(Node::NOTHING)
    }
}

/// The bits of a word on every other place.
fn spread(v: u32) -> u64 {
    let v = u64::from(v);
    let v = (v | v << 16) & 0x0000_ffff_0000_ffff;
    let v = (v | v << 8) & 0x00ff_00ff_00ff_00ff;
    let v = (v | v << 4) & 0x0f0f_0f0f_0f0f_0f0f;
    let v = (v | v << 2) & 0x3333_3333_3333_3333;
    (v | v << 1) & 0x5555_5555_5555_5555
}

#[cfg(test)]
mod tests {
    use super::super::outline::View;
    use super::*;
    use crate::camera::Pinhole;
    use crate::random::Random;
    use glam::{DVec3, DVec4};

    /// Pixel (u, v) of its plane is the world's (u, v, 0).
    fn plane() -> Pinhole {
        Pinhole::new(DVec4::Z, DVec3::ZERO, DVec3::X, DVec3::Y, -1.0, Some(1.0)).unwrap()
    }

    /// A crowd, duplicates and locations far away.
    fn locations(random: &mut Random) -> Vec<SampleLocation> {
        (0..600)
            .map(|index| {
                let side = [20.0, 0.01, 1e5][index % 3];
                SampleLocation {
                    uv: [(random.range(0.0, side)).round(), random.range(0.0, side)],
                    jacobian: [
                        [random.range(0.1, 2.0), 0.3],
                        [-0.2, random.range(0.1, 2.0)],
                    ],
                    output: 0,
                }
            })
            .collect()
    }

    #[test]
    fn no_cell_that_a_thin_outline_crosses_is_missed() {
        let mut random = Random::new(17);
        let locations = locations(&mut random);
        let view = View::new(&plane(), DVec3::ZERO);
        let tree = LocationTree::new(&locations, |_| f64::NEG_INFINITY);
        let window = view.window(tree.bounds());
        let (mut outline, mut scratch) = (Outline::default(), Vec::new());
        let mut crossed = 0;
        for triangle in 0..300 {
            let length = [1.0, 30.0, 1e5][triangle % 3];
            let mut corner =
                || DVec3::new(random.range(-0.1, length), random.range(-0.1, length), 0.0);
            let [a, b] = [corner(), corner()];
            let c = a + DVec3::new(0.3, 0.2, 0.0);
            if !view.outline(&window, [a, b, c], true, &mut outline) {
                continue;
            }
            let mut found = Vec::new();
            tree.search(&outline, &mut |place| found.push(place));
            for (place, location) in locations.iter().enumerate() {
                if let Some((_, height)) = outline.across(location, &mut scratch) {
                    crossed += 1;
                    let missed = height < THIN && !found.contains(&(place as u32));
                    assert!(!missed, "triangle {triangle}, location {place}");
                }
            }
        }
        assert!(crossed > 1000, "{crossed}");
    }

    #[test]
    fn what_lies_behind_all_that_cells_show_is_passed_over() {
        let locations = locations(&mut Random::new(4));
        let view = View::new(&plane(), DVec3::ZERO);
        let mut outline = Outline::default();
        for (shown, expected) in [(0.5, true), (-0.5, false)] {
            // The triangle lies in the plane, at distance 0.
            let tree = LocationTree::new(&locations, |_| view.behind(shown));
            let window = view.window(tree.bounds());
            let corners = [DVec3::ZERO, DVec3::new(9.0, 0.1, 0.0), DVec3::Y];
            assert!(view.outline(&window, corners, true, &mut outline));
            let mut found = false;
            tree.search(&outline, &mut |_| found = true);
            assert_eq!(found, expected);
        }
    }
}

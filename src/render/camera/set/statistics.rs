//! Statistics of a sampling set: density and evenness of its samples.

use super::neighbours::Neighbours;
use serde::Serialize;

/// Statistics of a sampling set. A rate is the number of cells of the output per square pixel of the plane, computed
/// from the quads between the locations of four neighbouring cells: 1 for a planar set, 1/m^2 where a zoom enlarges by
/// 1/m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SetStatistics {
    /// Number of quads that have a location at each corner.
    pub quads: u64,
    /// Lowest rate; `None` without quads.
    pub lowest_rate: Option<f64>,
    /// Highest rate, infinite if a quad has no area; `None` without quads.
    pub highest_rate: Option<f64>,
    /// Number of quads that are inverted at one or more corners. The map folds there, and shows the surroundings of
    /// the fold twice.
    pub folds: u64,
    /// Number of samples in the fullest cell of the set.
    pub fullest_cell: usize,
}

pub(super) fn of(neighbours: &Neighbours, fullest_cell: usize) -> SetStatistics {
    let mut found = SetStatistics { quads: 0, lowest_rate: None, highest_rate: None, folds: 0, fullest_cell };
    for (row, col) in neighbours.places() {
        let corners = [(0, 0), (0, 1), (1, 1), (1, 0)];
        let [Some(a), Some(b), Some(c), Some(d)] = corners.map(|(y, x)| neighbours.at(row + y, col + x)) else {
            continue;
        };
        found.quads += 1;
        // Twice the signed areas of the triangles at the corners; with y down, a quad that is not inverted has
        // positive areas.
        let turns =
            [(b - a).perp_dot(d - a), (c - b).perp_dot(a - b), (d - c).perp_dot(b - c), (a - d).perp_dot(c - d)];
        if turns.iter().any(|turn| *turn < 0.0) {
            found.folds += 1;
        }
        let area = 0.25 * turns.iter().sum::<f64>();
        let rate = 1.0 / area.abs();
        found.lowest_rate = Some(found.lowest_rate.map_or(rate, |lowest| lowest.min(rate)));
        found.highest_rate = Some(found.highest_rate.map_or(rate, |highest| highest.max(rate)));
    }
    found
}

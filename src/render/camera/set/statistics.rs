//! Statistics of a set: density and evenness of its samples on the plane.

use super::neighbours::Neighbours;
use serde::Serialize;

/// Figures of a sampling set. Rates are cells of the output for a square pixel of the plane, from the areas of the quads
/// between the locations of four neighbouring rows and columns: 1 for a planar set, 1/m^2 where a zoom enlarges by 1/m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SetStatistics {
    /// Quads with a location at each corner.
    pub quads: u64,
    /// The lowest rate; `None` without quads.
    pub lowest_rate: Option<f64>,
    /// The highest rate; infinite where a quad has no area.
    pub highest_rate: Option<f64>,
    /// Quads that are turned over at one corner at least, so that the map folds there: what lies on both sides of the
    /// fold is seen twice.
    pub folds: u64,
    /// Samples in the fullest cell of the set.
    pub fullest_cell: usize,
}

pub(super) fn of(neighbours: &Neighbours, fullest_cell: usize) -> SetStatistics {
    let mut found = SetStatistics {
        quads: 0,
        lowest_rate: None,
        highest_rate: None,
        folds: 0,
        fullest_cell,
    };
    for (row, col) in neighbours.places() {
        let corners = [(0, 0), (0, 1), (1, 1), (1, 0)];
        let [Some(a), Some(b), Some(c), Some(d)] =
            corners.map(|(y, x)| neighbours.at(row + y, col + x))
        else {
            continue;
        };
        found.quads += 1;
        // Twice the signed areas of the triangles at the corners; y down, so that the upright way around is positive.
        let turns = [
            (b - a).perp_dot(d - a),
            (c - b).perp_dot(a - b),
            (d - c).perp_dot(b - c),
            (a - d).perp_dot(c - d),
        ];
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

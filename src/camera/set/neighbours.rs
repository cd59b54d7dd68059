//! Locations of neighbouring rows and columns.

use super::Sample;
use glam::{DMat2, DVec2};

/// The mean location of each cell of an output.
pub(super) struct Neighbours {
    size: [u32; 2],
    /// Sums of locations and their numbers, row by row.
    cells: Vec<(DVec2, u32)>,
}

impl Neighbours {
    pub(super) fn new(size: [u32; 2], samples: &[Sample]) -> Self {
        let mut cells = vec![(DVec2::ZERO, 0); size[0] as usize * size[1] as usize];
        for sample in samples {
            let index = sample.row as usize * size[0] as usize + sample.col as usize;
            if let Some((sum, count)) = cells.get_mut(index) {
                *sum += DVec2::from(sample.uv);
                *count += 1;
            }
        }
        Self { size, cells }
    }

    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The mean location of a cell; `None` outside of the output and where there is no sample.
    pub(super) fn at(&self, row: i64, col: i64) -> Option<DVec2> {
        let [columns, rows] = self.size.map(i64::from);
        if !(0..rows).contains(&row) || !(0..columns).contains(&col) {
            return None;
        }
        let (sum, count) = self.cells.get((row * columns + col) as usize)?;
        (*count > 0).then(|| *sum / f64::from(*count))
    }

    /// Differences of locations along columns and rows: central where both neighbours are there, one-sided where one is.
    /// Without neighbours along one axis the footprint is taken to be square, without any to be a pixel.
    pub(super) fn jacobian(&self, row: u32, col: u32) -> DMat2 {
        let (row, col) = (i64::from(row), i64::from(col));
        let along = |rows: i64, columns: i64| {
            let before = self.at(row - rows, col - columns);
            let here = self.at(row, col);
            let after = self.at(row + rows, col + columns);
            match (before, here, after) {
                (Some(before), _, Some(after)) => Some(0.5 * (after - before)),
                (None, Some(here), Some(after)) => Some(after - here),
                (Some(before), Some(here), None) => Some(here - before),
                _ => None,
            }
        };
        match (along(0, 1), along(1, 0)) {
            (Some(x), Some(y)) => DMat2::from_cols(x, y),
            (Some(x), None) => DMat2::from_cols(x, x.perp()),
            (None, Some(y)) => DMat2::from_cols(-y.perp(), y),
            (None, None) => DMat2::IDENTITY,
        }
    }
}

//! Locations of neighbouring rows and columns.

use super::Sample;
use glam::{DMat2, DVec2};

/// The mean location of each cell of the output that has samples.
pub(super) struct Neighbours {
    columns: u64,
    /// Index (row by row) and mean location of each cell, sorted by index.
    cells: Vec<(u64, DVec2)>,
    /// Whether every cell up to the last has samples, so that the index is the position in `cells`.
    complete: bool,
}

impl Neighbours {
    pub(super) fn new(size: [u32; 2], samples: &[Sample]) -> Self {
        let columns = u64::from(size[0]);
        let index = |sample: &Sample| u64::from(sample.row) * columns + u64::from(sample.col);
        let mut all: Vec<_> = samples.iter().map(|sample| (index(sample), DVec2::from(sample.uv))).collect();
        all.sort_by_key(|(index, _)| *index);
        let mean = |run: &[(u64, DVec2)]| {
            let sum: DVec2 = run.iter().map(|(_, location)| *location).sum();
            run.first().map(|(index, _)| (*index, sum / run.len() as f64))
        };
        let cells: Vec<_> = all.chunk_by(|a, b| a.0 == b.0).filter_map(mean).collect();
        let complete = cells.last().is_some_and(|(last, _)| last + 1 == cells.len() as u64);
        Self { columns, cells, complete }
    }

    /// Rows and columns of the cells that have samples.
    pub(super) fn places(&self) -> impl Iterator<Item = (i64, i64)> {
        let place = |index: u64| ((index / self.columns) as i64, (index % self.columns) as i64);
        self.cells.iter().map(move |(index, _)| place(*index))
    }

    /// Mean location of a cell; `None` outside of the output and for a cell without samples.
    pub(super) fn at(&self, row: i64, col: i64) -> Option<DVec2> {
        let (row, col) = (u64::try_from(row).ok()?, u64::try_from(col).ok()?);
        if col >= self.columns {
            return None;
        }
        let index = row * self.columns + col;
        let place = if self.complete {
            usize::try_from(index).ok()?
        } else {
            self.cells.binary_search_by_key(&index, |(index, _)| *index).ok()?
        };
        self.cells.get(place).map(|(_, location)| *location)
    }

    /// Jacobian from differences of neighbouring locations along columns and rows: central if both neighbours exist,
    /// one-sided if one does. Without neighbours along one axis the footprint is assumed to be square; without any, to
    /// be one pixel.
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

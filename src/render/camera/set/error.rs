//! Errors of sampling locations.

use super::FARTHEST;

/// Error: locations that make no sampling set.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SetError {
    /// Set without locations.
    #[error("no sampling locations; give at least one")]
    Empty,
    /// Number of locations that is too large for a 32-bit index.
    #[error("{0} sampling locations; at most {max} fit in one set", max = u32::MAX)]
    TooMany(usize),
    /// Location with a NaN or infinite coordinate.
    #[error("sampling location {index} is ({u}, {v}); both coordinates must be finite")]
    NotFinite {
        /// Index of the location in the list.
        index: usize,
        /// Coordinate u of the location.
        u: f64,
        /// Coordinate v of the location.
        v: f64,
    },
    /// Location so far from the image that single precision can't tell its pixels apart.
    #[error("sampling location {index} is ({u}, {v}); both coordinates must be within {FARTHEST} pixels of 0")]
    Far {
        /// Index of the location in the list.
        index: usize,
        /// Coordinate u of the location.
        u: f64,
        /// Coordinate v of the location.
        v: f64,
    },
    /// Location that belongs to a cell which the output does not have.
    #[error(
        "sampling location {index} belongs to row {row} and column {col}, which an output of {columns} x {rows} has not"
    )]
    Cell {
        /// Index of the location in the list.
        index: usize,
        /// Row of the cell.
        row: u32,
        /// Column of the cell.
        col: u32,
        /// Columns of the output.
        columns: u32,
        /// Rows of the output.
        rows: u32,
    },
    /// Output without cells, or with too many.
    #[error("an output of {columns} x {rows} cells; it must have from 1 to {max}", max = super::MOST_CELLS)]
    Size {
        /// Columns of the output.
        columns: u32,
        /// Rows of the output.
        rows: u32,
    },
    /// Superpixel marks whose number differs from the number of pixels.
    #[error("{found} marks for the superpixels of an image of {expected} pixels; give one for each")]
    Marks {
        /// Number of pixels.
        expected: usize,
        /// Number of marks.
        found: usize,
    },
    /// Locations that no grid separates: even the finest grid tried has two of them in a cell.
    #[error(
        "no uniform grid fits: locations {first} and {second} share a cell even of {pitch} pixel; use a no-pattern set"
    )]
    NoGrid {
        /// Index of one location.
        first: usize,
        /// Index of another location in the same cell.
        second: usize,
        /// Side of the smallest cells tried, in pixels.
        pitch: f64,
    },
    /// Leaf size of 0: leaves must be allowed to hold at least one sample.
    #[error("leaves of at most 0 samples hold nothing; allow at least 1")]
    LeafSize,
    /// Window of a quadtree that is empty or not finite.
    #[error("the window from ({}, {}) to ({}, {}) holds nothing", .low[0], .low[1], .high[0], .high[1])]
    Window {
        /// Upper left corner of the window.
        low: [f64; 2],
        /// Lower right corner of the window.
        high: [f64; 2],
    },
}

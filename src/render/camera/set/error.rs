//! Errors of sampling locations.

use super::FARTHEST;

/// Locations that make no sampling set.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SetError {
    /// Set without locations.
    #[error("no sampling locations; give at least one")]
    Empty,
    /// Number of locations that is too large for a 32-bit index.
    #[error("{0} sampling locations; at most {max} fit in one set", max = u32::MAX)]
    TooMany(usize),
    /// NaN or infinite.
    #[error("sampling location {index} is ({u}, {v}); both coordinates must be finite")]
    NotFinite {
        /// Index among the locations.
        index: usize,
        /// Coordinate u of the location.
        u: f64,
        /// Coordinate v of the location.
        v: f64,
    },
    /// Location so far from the image that single precision can't tell pixels apart.
    #[error(
        "sampling location {index} is ({u}, {v}); both coordinates must be within {FARTHEST} pixels of 0"
    )]
    Far {
        /// Index among the locations.
        index: usize,
        /// Coordinate u of the location.
        u: f64,
        /// Coordinate v of the location.
        v: f64,
    },
    /// The output has no such cell.
    #[error(
        "sampling location {index} belongs to row {row} and column {col}, which an output of {columns} x {rows} has not"
    )]
    Cell {
        /// Index among the locations.
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
    /// The output has no cells or too many.
    #[error("an output of {columns} x {rows} cells; it must have from 1 to {max}", max = super::MOST_CELLS)]
    Size {
        /// Columns of the output.
        columns: u32,
        /// Rows of the output.
        rows: u32,
    },
    /// The superpixels are not those of the image.
    #[error(
        "{found} marks for the superpixels of an image of {expected} pixels; give one for each"
    )]
    Marks {
        /// Number of pixels.
        expected: usize,
        /// Number of marks.
        found: usize,
    },
    /// No grid has at most one location in each cell.
    #[error(
        "no uniform grid fits: locations {first} and {second} share a cell even of {pitch} pixel; use a no-pattern set"
    )]
    NoGrid {
        /// Position of one location, from 0.
        first: usize,
        /// Position of the other.
        second: usize,
        /// Side of the smallest cells tried, in pixels.
        pitch: f64,
    },
    /// A leaf must be allowed a sample at least.
    #[error("leaves of at most 0 samples hold nothing; allow at least 1")]
    LeafSize,
    /// The window of a quad-tree is empty or not finite.
    #[error("the window from ({}, {}) to ({}, {}) holds nothing", .low[0], .low[1], .high[0], .high[1])]
    Window {
        /// Upper left corner of the window.
        low: [f64; 2],
        /// Lower right corner of the window.
        high: [f64; 2],
    },
}

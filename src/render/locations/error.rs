//! Errors of sampling locations.

use thiserror::Error;

/// Error: locations that can't be sampled. `index` is the position of the first such location in the list.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LocationError {
    /// List without locations.
    #[error("the set holds no sampling location; give at least one")]
    Empty,
    /// Location with a coordinate or derivative that is NaN or infinite.
    #[error("sampling location {index} is ({u}, {v}) with the Jacobian {jacobian:?}; all of these must be finite")]
    NotFinite {
        /// Index of the location in the list.
        index: usize,
        /// Coordinate u in pixels.
        u: f64,
        /// Coordinate v in pixels.
        v: f64,
        /// Jacobian of the location.
        jacobian: [[f64; 2]; 2],
    },
    /// Location whose cell reaches too far off the image.
    #[error(
        "sampling location {index} is ({u}, {v}), with {half_width} x {half_height} pixels around it; all must lie within {} pixels of the image's upper left corner",
        Self::FARTHEST
    )]
    TooFar {
        /// Index of the location in the list.
        index: usize,
        /// Coordinate u in pixels.
        u: f64,
        /// Coordinate v in pixels.
        v: f64,
        /// Half of the cell's width in pixels.
        half_width: f64,
        /// Half of the cell's height in pixels.
        half_height: f64,
    },
    /// Location for a cell that the output does not have.
    #[error("sampling location {index} belongs to output cell {output}, but there are {cells} cells")]
    Output {
        /// Index of the location in the list.
        index: usize,
        /// Index of the cell.
        output: u32,
        /// Number of cells of the output.
        cells: u64,
    },
    /// List with more locations than 32-bit indices allow.
    #[error("{found} sampling locations at once; give at most {}", u32::MAX >> 1)]
    TooMany {
        /// Number of locations.
        found: usize,
    },
}

impl LocationError {
    /// Largest distance of a location or its samples from the image's upper left corner along either axis, in pixels:
    /// 2^20.
    pub const FARTHEST: f64 = 1_048_576.0;
}

//! Why a set of locations can't be sampled.

use thiserror::Error;

/// A set of locations that can't be sampled; `index` is the first offender's place in the list.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum LocationError {
    /// There is nothing to sample.
    #[error("the set holds no sampling location; give at least one")]
    Empty,
    /// A coordinate or a derivative is not a number, or infinite.
    #[error(
        "sampling location {index} is ({u}, {v}) with the Jacobian {jacobian:?}; all of these must be finite"
    )]
    NotFinite {
        /// Its place in the list.
        index: usize,
        /// Its u.
        u: f64,
        /// Its v.
        v: f64,
        /// Its Jacobian.
        jacobian: [[f64; 2]; 2],
    },
    /// A location or its cell reaches too far off the image.
    #[error(
        "sampling location {index} is ({u}, {v}), with {half_width} x {half_height} pixels around it; all must lie within {} pixels of the image's upper left corner",
        Self::FARTHEST
    )]
    TooFar {
        /// Its place in the list.
        index: usize,
        /// Its u.
        u: f64,
        /// Its v.
        v: f64,
        /// Half of the cell's width in pixels.
        half_width: f64,
        /// Half of the cell's height in pixels.
        half_height: f64,
    },
    /// An output cell that the output does not have.
    #[error(
        "sampling location {index} belongs to output cell {output}, but there are {cells} cells"
    )]
    Output {
        /// Its place in the list.
        index: usize,
        /// The output cell asked for.
        output: u32,
        /// How many there are.
        cells: u64,
    },
    /// More locations than can be told apart.
    #[error("{found} sampling locations at once; give at most {}", u32::MAX >> 1)]
    TooMany {
        /// How many there are.
        found: usize,
    },
}

impl LocationError {
    /// The farthest that a location and its sub-samples can be from the upper left corner of the image along either
    /// axis, in pixels: 2^20.
    pub const FARTHEST: f64 = 1_048_576.0;
}

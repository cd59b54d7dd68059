//! Patterns: the places of the samples in a pixel; and filters: their weights.
//!
//! A [`Pattern`] gives the samples of a superpixel as offsets from the pixel's centre, in pixels, x to the right and y
//! down. Each coordinate is in [-0.5, 0.5) and a multiple of 2^-16, and so exact in 32-bit floating point and in fixed
//! point: a shader and its exact twin sample the same places.
//!
//! # Order
//! The offsets of every pattern are in the same spatial order. The pixel is halved repeatedly, along its longer side
//! first (vertically if the sides are equal), and the samples of the first half precede those of the second. A half
//! takes a whole number of blocks of 256, 64, 16, 4 or 1 samples: the largest of these sizes that is smaller than the
//! number of samples to halve. So every aligned run of 64 or of 256 samples is compact: at 1,024 samples, each run of
//! 256 is a quarter of the pixel and each run of 64 a sixteenth. The order depends on the set of samples alone.

mod filter;
mod lattice;
mod order;
mod pattern;
mod sobol;
mod standard;

pub(crate) use filter::{Bend, SPREAD_SCALES};
pub use filter::{FilterError, FilterShape, PixelFilter};
pub use pattern::{MAX_SAMPLES, Pattern, PatternError};
pub use sobol::owen_sobol;

/// A location in a pixel, in units of 2^-16 pixel from its top left corner.
type Location = [u16; 2];

/// Number of units of a [`Location`] along a pixel's side.
const UNITS: f64 = 65536.0;

/// Location nearest to a fraction (0 to 1) of the pixel's width and height; halves round up.
fn locate(x: f64, y: f64) -> Location {
    // A cast from floating point saturates, so a value that rounds up to the right or lower border stays inside the
    // pixel.
    [x, y].map(|fraction| (fraction * UNITS + 0.5).floor() as u16)
}

/// Exact offset of a location from the pixel's centre, in pixels.
fn offset(location: Location) -> [f32; 2] {
    location.map(|units| f32::from(units) / UNITS as f32 - 0.5)
}

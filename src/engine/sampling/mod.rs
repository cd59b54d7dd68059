//! Where in a pixel the samples lie.
//!
//! A [`Pattern`] gives the locations of the samples of one superpixel as offsets from the pixel's centre, in pixels,
//! x to the right and y down, each coordinate in [-0.5, 0.5) and a multiple of 2^-16. The multiples make offsets exact
//! in 32-bit floating and in fixed point alike, so that a shader and its exact twin sample the same places.
//!
//! # Order
//! The offsets of every pattern come in the same spatial order: the pixel is halved again and again, the longer side
//! first (the vertical one where they are equal), and the samples of the first half precede those of the second. A
//! half takes a whole number of blocks of 256, 64, 16, 4 or 1 samples, the largest of these that is smaller than what
//! there is to halve. Hence every aligned run of 64 or of 256 samples is compact: at 1,024 samples, each run of 256 is
//! a quarter of the pixel and each run of 64 a sixteenth. The order is a function of the set alone.

mod lattice;
mod order;
mod pattern;
mod sobol;
mod standard;

pub use pattern::{MAX_SAMPLES, Pattern, PatternError};
pub use sobol::owen_sobol;

/// A location in a pixel, in units of 2^-16 pixel from its top left corner.
type Location = [u16; 2];

/// Units of a [`Location`] in a pixel's side.
const UNITS: f64 = 65536.0;

/// The location nearest to a fraction (0 to 1) of the pixel's width and height; halves round up.
fn locate(x: f64, y: f64) -> Location {
    // A cast from floating point saturates, which keeps what rounds up to the far side inside the pixel.
    [x, y].map(|fraction| (fraction * UNITS + 0.5).floor() as u16)
}

/// The offset of a location from the pixel's centre, in pixels; exact.
fn offset(location: Location) -> [f32; 2] {
    location.map(|units| f32::from(units) / UNITS as f32 - 0.5)
}

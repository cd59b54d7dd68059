//! Benchmarks: times of the methods, and the distances of their images from a reference.
//!
//! [`brute_force`] renders the reference by supersampling with thousands of samples a pixel, and a [`Cache`] keeps it
//! on disk. [`Yardstick`] compares images with it. [`take_turns`] times several [`Contender`]s in one run, frame by
//! frame in turns, so that a machine that slows down affects all of them. The sampling sets of the camera's [`Variant`]s are
//! contenders, too. [`SequenceErrors`] compares frames in [`Motion`] with a reference for each frame.

mod accuracy;
mod cache;
mod causes;
mod faults;
mod growth;
mod motion;
mod reference;
mod spread;
pub mod stress;
mod stripped;
mod timing;
mod variants;

pub use accuracy::{Accuracy, Yardstick};
pub use cache::{Cache, Fingerprint};
pub use causes::{Cause, LOOKS, PixelTriangles, Split};
pub use faults::{Fault, Within};
pub use growth::{Growth, GrowthStep};
pub use motion::{Motion, SequenceErrors, Steadiness};
pub use reference::{GRID_SAMPLES, MAX_REFERENCE_SAMPLES, brute_force};
pub use spread::Spread;
pub use stripped::Stripped;
pub use timing::{Contender, Cost, take_turns};
pub use variants::Variant;

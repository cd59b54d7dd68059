//! Benchmarks: the costs of methods, and the distances of their images from brute force at thousands of samples.
//!
//! [`brute_force`] renders the reference, which a [`Cache`] keeps on disk; [`Yardstick`] holds images against it;
//! [`take_turns`] times several [`Contender`]s in one run, each in its turn, so that a machine that slows down slows all
//! of them down. A [`VariantContender`] does so for the sampling sets of the camera's variants. A [`Sequence`] holds frames in
//! [`Motion`] against their own truths.

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

pub use crate::random::Random;
pub use accuracy::{Accuracy, Yardstick};
pub use cache::{Cache, Fingerprint};
pub use causes::{Cause, LOOKS, Looks, Split};
pub use faults::{Fault, FaultError, Half, Suspects, Within};
pub use growth::{Growth, GrowthStep};
pub use motion::{Motion, Sequence, Steadiness};
pub use reference::{GRID_SAMPLES, MAX_REFERENCE_SAMPLES, TRUTH_SIDE, brute_force};
pub use spread::Spread;
pub use stripped::Stripped;
pub use timing::{Contender, Cost, PassCost, take_turns};
pub use variants::{Variant, VariantContender, VariantCost, VariantError};

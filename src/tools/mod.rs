//! Tools of the command: image files, comparisons of images, resampling of photographs, and benchmarks.

pub mod bench;
pub mod compare;
pub mod names;
pub mod output;
mod random;
pub mod resample;

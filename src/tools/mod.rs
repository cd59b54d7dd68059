//! What only the command needs: image files, comparisons of images, zooms of photographs, benchmarks.

pub mod bench;
pub mod compare;
pub mod output;
pub mod resample;

//! Scalar twins, in exact or 64-bit arithmetic, of the decisions that the GPU makes.
//!
//! The twins are slow and simple, and share no code with the shaders; tests compare the shaders with them. All
//! positions are in pixels, x to the right and y down.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod behind;
pub mod coverage;
pub mod crossings;
pub mod detect;
pub mod distribute;
pub mod edge;
mod exact;
pub mod grow;
pub mod merge;
pub mod pixel_filter;
pub mod prefilter;
pub mod reflection;
pub mod sample_lines;
pub mod schedule;
pub mod shadow;
pub mod sheen;
pub mod stroke;
pub mod texture;
pub mod thin;
pub mod topology;
pub mod transform;
pub mod variation;
pub mod visibility;

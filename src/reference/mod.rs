//! Scalar twins, in exact or 64-bit arithmetic, of every decision that the GPU makes.
//!
//! They are slow and plain. Tests hold the shaders against them.

#![forbid(unsafe_code)]

pub mod edge;

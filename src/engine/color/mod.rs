//! Encodings of colours in double precision, for files and detection; `shaders/include/color.glsl` computes the same
//! in single precision.

#![forbid(unsafe_code)]

pub mod srgb;
pub mod tonemap;

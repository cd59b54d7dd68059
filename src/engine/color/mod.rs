//! Encodings of colours, in 64 bits: what files and detection have, and what `shaders/include/color.glsl` computes in 32.

#![forbid(unsafe_code)]

pub mod srgb;
pub mod tonemap;

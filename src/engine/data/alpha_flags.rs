//! Flags of the alpha test: the same numbers as in `shaders/include/alpha.glsl`.

pub(crate) const TEXTURED: u32 = 1;
pub(crate) const NEAREST_MAG: u32 = 2;
pub(crate) const NEAREST_MIN: u32 = 4;
pub(crate) const NO_MIP: u32 = 8;
pub(crate) const NEAREST_MIP: u32 = 16;

/// Wrap mode: what texels beyond an image are.
pub(crate) const REPEAT: u32 = 0;
pub(crate) const MIRRORED_REPEAT: u32 = 1;
pub(crate) const CLAMP_TO_EDGE: u32 = 2;

/// Bits of the wrap modes along u and v.
pub(crate) fn beyond([u, v]: [u32; 2]) -> u32 {
    u << 8 | v << 10
}

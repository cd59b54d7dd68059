//! Flags of the alpha test.

pub(crate) use crate::engine::spirv::{
    ALPHA_NEAREST_MAG as NEAREST_MAG, ALPHA_NEAREST_MIN as NEAREST_MIN, ALPHA_NEAREST_MIP as NEAREST_MIP,
    ALPHA_NO_MIP as NO_MIP, ALPHA_TEXTURED as TEXTURED, WRAP_CLAMP_TO_EDGE as CLAMP_TO_EDGE,
    WRAP_MIRRORED_REPEAT as MIRRORED_REPEAT, WRAP_REPEAT as REPEAT,
};

/// Flag bits for the wrap modes `u` and `v`.
pub(crate) fn beyond([u, v]: [u32; 2]) -> u32 {
    u << 8 | v << 10
}

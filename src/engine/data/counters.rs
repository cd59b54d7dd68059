//! Counters and indirect dispatches, which are generated from `shaders/include/interface.glsl`.

pub(crate) use crate::engine::spirv::STRETCH;
pub use crate::engine::spirv::{Argument, Counter};

impl Counter {
    /// Number of counters.
    pub const COUNT: usize = size_of::<crate::engine::spirv::Counters>() / 4;
    /// Number of bytes of the buffer of counters.
    pub(crate) const BYTES: u64 = 4 * Self::COUNT as u64;

    /// Value of this counter in `counters`; 0 if the slice is too short.
    pub(crate) fn of(self, counters: &[u32]) -> u32 {
        counters.get(self as usize).copied().unwrap_or(0)
    }
}

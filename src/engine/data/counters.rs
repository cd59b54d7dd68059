//! The indices of counters and of indirect dispatches, as `shaders/include/interface.glsl` numbers them.

pub(crate) use crate::engine::passes::spirv::STRETCH;
pub use crate::engine::passes::spirv::{Argument, Counter};

impl Counter {
    /// Length of the buffer of counters.
    pub const COUNT: usize = size_of::<crate::engine::passes::spirv::Counters>() / 4;
    /// Bytes of the buffer of counters.
    pub(crate) const BYTES: u64 = 4 * Self::COUNT as u64;
    /// Bytes of those that are cleared before each run.
    pub(crate) const CLEARED_BYTES: u64 = 4 * Self::Subgroups as u64;

    /// Its value among all counters; 0 where these are fewer.
    pub(crate) fn of(self, counters: &[u32]) -> u32 {
        counters.get(self as usize).copied().unwrap_or(0)
    }
}

//! Policy for dividing a frame's samples into rounds.

use super::Capacity;
use super::plan::MOST_FRAGMENTS;
use crate::vulkan::Limits;

/// Policy for dividing a frame's samples into rounds, which depends on the kind of device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RoundPolicy {
    /// Small rounds, whose memory stays in the caches of a CPU.
    Small,
    /// Large rounds, for devices with plenty of memory, because a GPU is idle during each barrier.
    Large {
        /// Largest number of visibility samples in a round.
        fragments: u64,
    },
}

/// Number of bytes of local memory from which on a device has plenty.
const PLENTY: u64 = 2 << 30;
/// Divisor of the local memory: a round's visibility samples may take this part of it.
const PART: u64 = 32;
/// Number of bytes that a host's frame may take besides its triangles if nothing else is known: 1 GiB less 64 MiB for a million
/// triangles.
const USUAL_MEMORY: u64 = 960 << 20;
/// Number of bytes of a visibility sample in all buffers of a round.
const FRAGMENT_BYTES: u64 = 44;

impl RoundPolicy {
    /// Policy for a device.
    pub fn of(limits: &Limits) -> Self {
        if limits.is_cpu() || limits.local_bytes < PLENTY {
            Self::Small
        } else {
            let fragments = limits.local_bytes / (PART * FRAGMENT_BYTES);
            Self::Large { fragments }
        }
    }

    /// Number of bytes that a host's frame may take with this capacity besides its triangles, if the host names no other limit;
    /// `None` for no limit.
    pub fn usual_memory(self, capacity: Capacity) -> Option<u64> {
        match self {
            Self::Small => None,
            Self::Large { .. } => Some(USUAL_MEMORY.saturating_mul(capacity.growth())),
        }
    }

    /// Largest number of visibility samples in a round of an image.
    pub fn most_fragments(self, limits: &Limits) -> u64 {
        match self {
            Self::Small => MOST_FRAGMENTS,
            Self::Large { fragments } => fragments.min(limits.max_storage_bytes / 16).min(limits.max_texel_elements),
        }
    }
}

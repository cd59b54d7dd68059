//! How a frame's samples are divided into rounds.

use super::plan::MOST_RECORDS;
use crate::vulkan::Limits;
use ash::vk;

/// Division of a frame's samples into rounds, by the kind of the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RoundPolicy {
    /// Small rounds, whose memory stays in the caches of a CPU. All rounds are recorded that any image may need: a CPU skips an idle one
    /// in microseconds.
    Small,
    /// Large rounds in plenty of memory. As many are recorded as images usually need, because a GPU is idle during each barrier; a frame
    /// that needs more says so, and is made again.
    Large {
        /// Largest number of visibility samples in a round.
        records: u64,
    },
}

/// Bytes of local memory from which on a device has plenty.
const PLENTY: u64 = 2 << 30;
/// Part of the local memory that a round's visibility samples may take.
const PART: u64 = 32;
/// Bytes that a visibility sample takes in all buffers of a round.
const RECORD_BYTES: u64 = 44;

impl RoundPolicy {
    /// Policy for a device.
    pub fn of(limits: &Limits) -> Self {
        let is_cpu = limits.device_type == vk::PhysicalDeviceType::CPU;
        if is_cpu || limits.local_bytes < PLENTY {
            Self::Small
        } else {
            let records = limits.local_bytes / (PART * RECORD_BYTES);
            Self::Large { records }
        }
    }

    /// Largest number of visibility samples in a round of an image.
    pub fn most_records(self, limits: &Limits) -> u64 {
        match self {
            Self::Small => MOST_RECORDS,
            Self::Large { records } => records
                .min(limits.max_storage_bytes / 16)
                .min(limits.max_texel_elements),
        }
    }
}

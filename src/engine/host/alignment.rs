//! Ranges of lent buffers, aligned as descriptors require.

use super::{HostError, Member};
use crate::vulkan::Limits;
use ash::vk;

/// Range of a lent buffer for a descriptor. The range starts at the alignment that the device requires, so it may
/// include bytes before the first element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct LentBytes {
    buffer: vk::Buffer,
    offset: u64,
    /// Bytes before the first element.
    pub before: u32,
    /// Size of the range, including the bytes before the first element.
    bytes: u64,
}

impl LentBytes {
    pub fn new(buffer: vk::Buffer, offset: u64, bytes: u64, limits: &Limits) -> Self {
        Self::aligned(buffer, offset, bytes, descriptor_alignment(limits))
    }

    fn aligned(buffer: vk::Buffer, offset: u64, bytes: u64, alignment: u64) -> Self {
        let before = offset % alignment;
        Self { buffer, offset: offset - before, before: before as u32, bytes: before + bytes }
    }

    /// Checks that the device addresses so many bytes in one buffer.
    pub fn check(&self, member: Member, limits: &Limits) -> Result<(), HostError> {
        let (needed, limit) = (self.bytes, limits.max_storage_bytes);
        if needed > limit { Err(HostError::Length { member, needed, limit }) } else { Ok(()) }
    }

    /// The same range, extended to whole words of 4 bytes.
    pub fn in_words(self) -> Self {
        Self { bytes: self.bytes.next_multiple_of(4), ..self }
    }

    pub fn info(&self) -> vk::DescriptorBufferInfo {
        vk::DescriptorBufferInfo::default().buffer(self.buffer).offset(self.offset).range(self.bytes)
    }
}

/// Alignment in bytes of buffer offsets in descriptors: at least 16, the size of a position in clip space.
pub(super) fn descriptor_alignment(limits: &Limits) -> u64 {
    limits.buffer_alignment.max(16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_lent_begins_where_the_device_can() {
        let buffer = vk::Buffer::null();
        let lent = LentBytes::aligned(buffer, 300, 100, 256);
        assert_eq!((lent.offset, lent.before, lent.bytes), (256, 44, 144));
        let lent = LentBytes::aligned(buffer, 512, 99, 256).in_words();
        assert_eq!((lent.offset, lent.before, lent.bytes), (512, 0, 100));
    }
}

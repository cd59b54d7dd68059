//! Parts of buffers that a host lends, as descriptors can have them.

use super::HostError;
use crate::vulkan::{Limits, VulkanError};
use ash::vk;

/// A part of a lent buffer: from a multiple of what the device asks for on, with what lies before the first element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct LentBytes {
    buffer: vk::Buffer,
    offset: u64,
    /// Bytes before the first element.
    pub before: u32,
    /// Bytes in all.
    bytes: u64,
}

impl LentBytes {
    pub fn new(buffer: vk::Buffer, offset: u64, bytes: u64, limits: &Limits) -> Self {
        Self::aligned(buffer, offset, bytes, descriptor_alignment(limits))
    }

    fn aligned(buffer: vk::Buffer, offset: u64, bytes: u64, alignment: u64) -> Self {
        let before = offset % alignment;
        Self {
            buffer,
            offset: offset - before,
            before: before as u32,
            bytes: before + bytes,
        }
    }

    /// The same with whole words of 4 bytes.
    pub fn in_words(self) -> Self {
        Self {
            bytes: self.bytes.next_multiple_of(4),
            ..self
        }
    }

    pub fn info(&self) -> vk::DescriptorBufferInfo {
        vk::DescriptorBufferInfo::default()
            .buffer(self.buffer)
            .offset(self.offset)
            .range(self.bytes)
    }
}

/// What descriptors of buffers may begin at: at least the bytes of a position in clip space.
pub(super) fn descriptor_alignment(limits: &Limits) -> u64 {
    limits.buffer_alignment.max(16)
}

/// Checks an offset and what it has to be a multiple of, a stride and the least that it can be, and a part of a buffer.
pub(super) fn check_layout(
    limits: &Limits,
    (offset_name, offset, alignment): (&'static str, u64, u64),
    stride: Option<(&'static str, u32, u32)>,
    (buffer_name, lent): (&'static str, LentBytes),
) -> Result<(), HostError> {
    if let Some((what, found, least)) = stride
        && (found % 4 != 0 || found < least)
    {
        return Err(HostError::Stride { what, found, least });
    }
    if offset % alignment != 0 {
        return Err(HostError::Alignment {
            what: offset_name,
            offset,
            alignment,
        });
    }
    VulkanError::check_limit(buffer_name, lent.bytes, "bytes", limits.max_storage_bytes)?;
    Ok(())
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

//! Copies of the passes' counters, for the host to read.

use crate::engine::data::{Counter, Resources};
use crate::vulkan::{Buffer, Memory, MemoryUse, Recorder, VulkanError};
use ash::vk;
use std::slice::ChunksExact;

/// Copies of the passes' counters, in slots; each copy in a recording has its own slot.
pub(crate) struct CounterLog {
    /// Buffer of the copies; `None` without slots.
    buffer: Option<Buffer>,
    slots: usize,
}

impl CounterLog {
    /// Makes a log with `slots` slots.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn new(memory: &Memory, slots: usize) -> Result<Self, VulkanError> {
        let buffer = || {
            memory.buffer(
                "counter read-back",
                slots as u64 * Counter::BYTES,
                vk::BufferUsageFlags::TRANSFER_DST,
                MemoryUse::Readback,
            )
        };
        Ok(Self { buffer: (slots > 0).then(buffer).transpose()?, slots })
    }

    /// Records a copy of the counters to a slot, if there are slots.
    pub fn record(&self, recorder: &Recorder<'_>, resources: &Resources, slot: usize) {
        if let Some(buffer) = &self.buffer {
            resources.record_keep_counters(recorder, buffer, slot as u64);
        }
    }

    /// Counters of the last recording, available once its commands have run. Each item holds the counters of one run:
    /// those of `slots_of_run` slots.
    ///
    /// # Errors
    /// If the counters can't be read.
    pub fn read(&self, slots_of_run: usize) -> Result<impl Iterator<Item = ChunksExact<'_, u32>>, VulkanError> {
        let words: &[u32] = match &self.buffer {
            Some(buffer) => buffer.read(self.slots * Counter::COUNT)?,
            None => &[],
        };
        let runs = words.chunks_exact(slots_of_run * Counter::COUNT);
        Ok(runs.map(|run| run.chunks_exact(Counter::COUNT)))
    }
}

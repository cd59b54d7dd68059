//! Recordings of a frame's memory besides its passes: uploads, clearing, counters and the background.

use super::{Data, Resources, SampleSet};
use crate::engine::data::{Counter, FrameUniform};
use crate::vulkan::{Buffer, Recorder};
use ash::vk;

impl Resources {
    /// Records the upload of the offsets and the clearing of all counters.
    pub fn record_upload(&self, recorder: &Recorder<'_>) {
        for set in &self.sets {
            set.upload.record(recorder);
        }
        if let Some(unread) = &self.unread {
            recorder.transition(unread, vk::ImageLayout::UNDEFINED, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
        }
        recorder.clear(self.buffer(Data::Counters));
    }

    /// Records the beginning of a region: uniform block, cleared counters and tiles. Passes use the sets `set` from here on.
    pub fn record_begin(&self, recorder: &Recorder<'_>, set: &SampleSet, uniform: &FrameUniform) {
        recorder.update(&set.uniform, 0, bytemuck::bytes_of(uniform));
        recorder.clear(self.buffer(Data::Counters));
        recorder.clear(self.buffer(Data::Tiles));
        set.show(recorder);
    }

    /// Records that all pixels of the region are taken, by one cell in each tile.
    pub(crate) fn record_all_tiles(&self, recorder: &Recorder<'_>) {
        recorder.fill(self.buffer(Data::Masks), vk::WHOLE_SIZE, u32::MAX);
        recorder.fill(self.buffer(Data::TileLoads), vk::WHOLE_SIZE, 1);
        let tiles = 4 * Counter::Tiles as u64;
        recorder.update(self.buffer(Data::Counters), tiles, &1_u32.to_ne_bytes());
    }

    /// Records copying the reach of a list's samples, which `distribute` has computed, to the uniform block.
    pub(crate) fn record_reach(&self, recorder: &Recorder<'_>, set: &SampleSet) {
        let region = vk::BufferCopy::default()
            .src_offset(4 * Counter::Reach as u64)
            .dst_offset(std::mem::offset_of!(FrameUniform, reach) as u64)
            .size(4);
        // SAFETY: counter and member lie in the buffers, which were created for copies and live as long as the frame.
        unsafe { recorder.copy_raw(self.buffer(Data::Counters).raw, set.uniform.raw, &[region]) };
    }

    /// Records `rounds` rounds. If the device can skip commands, it skips the rounds for which no tile waits.
    ///
    /// The passes of the first round are timed separately, all others together: timestamps are not skipped, and on CPU
    /// devices they cost ten times as much as the rest of a skipped round.
    pub(crate) fn record_rounds(&self, recorder: &Recorder<'_>, rounds: u32, record: impl Fn(&Recorder<'_>)) {
        if rounds > 0 {
            self.record_round(recorder, &record);
        }
        if rounds > 1 {
            recorder.repeated_rounds(|| {
                (1..rounds).for_each(|_| self.record_round(recorder, &record));
            });
        }
    }

    fn record_round(&self, recorder: &Recorder<'_>, record: impl Fn(&Recorder<'_>)) {
        if !self.sizes.skips_rounds {
            record(recorder);
            return;
        }
        let another_round = self.buffer(Data::AnotherRound);
        let waiting = vk::BufferCopy::default().src_offset(4 * Counter::Waiting as u64).size(4);
        // SAFETY: the counter lies in its buffer; both buffers were created for copies and live as long as the frame.
        unsafe { recorder.copy_raw(self.buffer(Data::Counters).raw, another_round.raw, &[waiting]) };
        // Dispatches of a host are not skipped. Their cleared sizes make them do nothing in a skipped round.
        recorder.clear(self.buffer(Data::Arguments));
        recorder.unless_zero(another_round, || record(recorder));
    }

    /// Records a copy of the counters to slot `slot` of a read-back buffer.
    pub(crate) fn record_keep_counters(&self, recorder: &Recorder<'_>, to: &Buffer, slot: u64) {
        let bytes = Counter::BYTES;
        recorder.copy(self.buffer(Data::Counters), bytes, to, slot * bytes);
    }

    /// Records a copy of the first `bytes` bytes of the colours to a host's buffer, at the offset `first_byte`.
    ///
    /// # Safety
    /// The buffer outlives the execution of the commands, was created for copies, and has room for the colours.
    pub(crate) unsafe fn record_keep_colors(
        &self,
        recorder: &Recorder<'_>,
        to: vk::Buffer,
        first_byte: u64,
        bytes: u64,
    ) {
        if bytes > 0 {
            let region = vk::BufferCopy::default().dst_offset(first_byte).size(bytes);
            // SAFETY: guaranteed by the caller; the resources have room for that many colours.
            unsafe { recorder.copy_raw(self.buffer(Data::Color).raw, to, &[region]) };
        }
    }

    /// Records replacing colours by the first `pixels` pixels of a filter.
    pub(crate) fn record_keep_filtered(&self, recorder: &Recorder<'_>, pixels: u32) {
        let (from, to) = (self.buffer(Data::Filtered), self.buffer(Data::Color));
        recorder.copy(from, 16 * u64::from(pixels), to, 0);
    }

    /// Records filling the first `pixels` pixels or locations with the background: its premultiplied colour, its
    /// display code and, for locations with attributes, the attributes of an empty location.
    pub(crate) fn record_background(&self, recorder: &Recorder<'_>, pixels: u32, background: [f32; 4], code: u32) {
        recorder.fill(self.buffer(Data::Display), vk::WHOLE_SIZE, code);
        fill(recorder, self.buffer(Data::Color), background, pixels);
        if self.sizes.attributes && self.sizes.locations.is_some() {
            let unseen = [[0, 0, 0, code], [0; 4]];
            fill(recorder, self.buffer(Data::Attributes), unseen, pixels);
        }
    }
}

/// Records filling the first `count` elements of a buffer that was created for copies and has at least as many
/// elements.
fn fill<T: bytemuck::NoUninit>(recorder: &Recorder<'_>, buffer: &Buffer, value: T, count: u32) {
    /// Number of bytes that are written inline: the most that Vulkan allows. Copies then double the filled range until
    /// the buffer is full.
    const SEED: u64 = 65_536;
    if bytemuck::bytes_of(&value).iter().all(|byte| *byte == 0) {
        recorder.clear(buffer);
        return;
    }
    let total = u64::from(count) * size_of::<T>() as u64;
    let mut filled = SEED.min(total);
    let seed = vec![value; filled as usize / size_of::<T>()];
    recorder.update(buffer, 0, bytemuck::cast_slice(&seed));
    while filled < total {
        let size = filled.min(total - filled);
        recorder.copy(buffer, size, buffer, filled);
        filled = (2 * filled).min(total);
    }
}

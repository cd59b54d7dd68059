//! What a frame records of its memory beside its passes: uploads, clearing, counters and the background.

use super::{Resources, SampleSet};
use crate::engine::data::{Counter, FrameUniform};
use crate::vulkan::{Buffer, Recorder};
use ash::vk;

impl Resources {
    /// Copies the offsets to the device and clears all counters, once.
    pub fn record_upload(&self, recorder: &Recorder<'_>) {
        for set in &self.sets {
            set.upload.record(recorder);
        }
        recorder.clear(&self.counters);
        recorder.barrier();
    }

    /// Begins work on a region: its uniform block, cleared counters and tiles, bound sets.
    pub fn record_begin(&self, recorder: &Recorder<'_>, set: &SampleSet, uniform: &FrameUniform) {
        recorder.barrier();
        recorder.update(&set.uniform, 0, bytemuck::bytes_of(uniform));
        recorder.clear_first(&self.counters, Counter::CLEARED_BYTES);
        recorder.clear(&self.tiles);
        recorder.barrier();
        self.record_bind(recorder, set);
    }

    /// Binds the set of the passes.
    pub(crate) fn record_bind(&self, recorder: &Recorder<'_>, set: &SampleSet) {
        // SAFETY: the recorder's contract; the set matches the layout of all pipelines.
        unsafe {
            recorder.device().cmd_bind_descriptor_sets(
                recorder.bindings(),
                vk::PipelineBindPoint::COMPUTE,
                self.layout.pipeline,
                0,
                &[set.descriptor()],
                &[],
            );
        }
    }

    /// Tells the passes that follow how far samples of a list's locations reach.
    pub(crate) fn record_reach(&self, recorder: &Recorder<'_>, set: &SampleSet) {
        let counter = 4 * Counter::Reach as u64;
        let member = std::mem::offset_of!(FrameUniform, reach) as u64;
        // SAFETY: counter and member lie in the buffers, which were made for copies and go with the frame.
        unsafe { recorder.copy_raw((self.counters.raw, counter), (set.uniform.raw, member), 4) };
        recorder.barrier();
    }

    /// Records so many rounds. The device skips those that no tile waits for, if it can.
    ///
    /// The passes of the first one are timed, and all others together: timestamps are not skipped, and cost CPU devices ten times
    /// what else a skipped round does.
    pub(crate) fn record_rounds(
        &self,
        recorder: &mut Recorder<'_>,
        rounds: u32,
        record: impl Fn(&mut Recorder<'_>),
    ) {
        if rounds > 0 {
            self.record_round(recorder, &record);
        }
        if rounds > 1 {
            recorder
                .untimed(|recorder| (1..rounds).for_each(|_| self.record_round(recorder, &record)));
            recorder.mark("rounds");
        }
    }

    fn record_round(&self, recorder: &mut Recorder<'_>, record: impl Fn(&mut Recorder<'_>)) {
        let Some(another_round) = &self.another_round else {
            record(recorder);
            return;
        };
        let waiting = 4 * Counter::Waiting as u64;
        // SAFETY: the counter lies in its buffer; both were made for copies and go with the frame.
        unsafe { recorder.copy_raw((self.counters.raw, waiting), (another_round.raw, 0), 4) };
        // Dispatches of a host's are not skipped. In a round that is, they find nothing.
        recorder.clear(&self.arguments);
        recorder.barrier();
        recorder.unless_zero(another_round, record);
    }

    /// Copies the counters to slot `slot` of a read-back buffer.
    pub(crate) fn record_keep_counters(&self, recorder: &Recorder<'_>, to: &Buffer, slot: u64) {
        let bytes = Counter::BYTES;
        recorder.copy(&self.counters, bytes, to, slot * bytes);
    }

    /// Copies the first bytes of the colours to a buffer of a host's, from a byte of that on.
    ///
    /// # Safety
    /// The buffer outlives the execution of the commands, was made for copies, and has room for them.
    pub(crate) unsafe fn record_keep_colors(
        &self,
        recorder: &Recorder<'_>,
        to: vk::Buffer,
        first_byte: u64,
        bytes: u64,
    ) {
        if bytes > 0 {
            // SAFETY: passed on to the caller; the resources have room for as many colours.
            unsafe { recorder.copy_raw((self.color.buffer.raw, 0), (to, first_byte), bytes) };
        }
    }

    /// Puts the first `pixels` pixels that the box filter made in the place of those that it made them of.
    pub(crate) fn record_keep_filtered(&self, recorder: &Recorder<'_>, pixels: u32) {
        let (from, to) = (&self.filtered.buffer, &self.color.buffer);
        recorder.copy(from, 16 * u64::from(pixels), to, 0);
        recorder.barrier();
    }

    /// Fills the first `pixels` pixels or locations with the background, premultiplied as in the output, its display code and, of
    /// locations that have them, its attributes.
    pub(crate) fn record_background(
        &self,
        recorder: &Recorder<'_>,
        pixels: u32,
        background: [f32; 4],
        code: u32,
    ) {
        // SAFETY: the recorder's contract; the buffer was made for copies.
        unsafe {
            recorder.device().cmd_fill_buffer(
                recorder.raw(),
                self.display.buffer.raw,
                0,
                vk::WHOLE_SIZE,
                code,
            );
        }
        fill(recorder, &self.color.buffer, background, pixels);
        if self.sizes.attributes && self.sizes.locations.is_some() {
            let unseen = [[0, 0, 0, code], [0; 4]];
            fill(recorder, &self.attributes, unseen, pixels);
        }
        recorder.barrier();
    }
}

/// Fills the first `count` places of a buffer, which has them and was made for copies.
fn fill<T: bytemuck::NoUninit>(recorder: &Recorder<'_>, buffer: &Buffer, value: T, count: u32) {
    /// Bytes written inline, as many as can be; the rest is copied from what is there, twice as much each time.
    const SEED: u64 = 65_536;
    let device = recorder.device();
    let total = u64::from(count) * size_of::<T>() as u64;
    let mut filled = SEED.min(total);
    // SAFETY: the recorder's contract; sizes are multiples of 4, and each copy reads what the copies before it wrote and writes
    // past it.
    unsafe {
        if bytemuck::bytes_of(&value).iter().all(|byte| *byte == 0) {
            device.cmd_fill_buffer(recorder.raw(), buffer.raw, 0, vk::WHOLE_SIZE, 0);
            return;
        }
        let seed = vec![value; filled as usize / size_of::<T>()];
        let seed = bytemuck::cast_slice(&seed);
        device.cmd_update_buffer(recorder.raw(), buffer.raw, 0, seed);
        while filled < total {
            recorder.barrier();
            let size = filled.min(total - filled);
            let part = [vk::BufferCopy::default().dst_offset(filled).size(size)];
            device.cmd_copy_buffer(recorder.raw(), buffer.raw, buffer.raw, &part);
            filled = (2 * filled).min(total);
        }
    }
}

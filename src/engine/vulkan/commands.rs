//! Recording into a command buffer, and timing of the passes.

use super::barriers::{Barriers, Commands};
use super::conditions::{Change, Conditions};
use super::trace::Dispatched;
use super::{Buffer, Gpu, Image, Pipeline, VulkanError};
use ash::vk;
use std::cell::Cell;
use std::sync::Arc;

/// Shader stages to which push constants are visible.
pub(crate) const PUSH_STAGES: vk::ShaderStageFlags = vk::ShaderStageFlags::from_raw(
    vk::ShaderStageFlags::VERTEX.as_raw() | vk::ShaderStageFlags::COMPUTE.as_raw(),
);

/// Recorder of a frame's commands into a caller's command buffer.
pub struct Recorder<'a> {
    gpu: &'a Gpu,
    raw: vk::CommandBuffer,
    /// Barriers: a requested barrier is recorded before the next command. A mark is recorded before it, because some
    /// drivers delay a timestamp until the barrier that follows it.
    barriers: Cell<Barriers>,
    conditions: Cell<Conditions>,
    timings: Option<&'a mut Timings>,
    /// Whether dispatches are labelled, and whether they are traced.
    labels: bool,
    traces: bool,
}

impl<'a> Recorder<'a> {
    /// Starts recording.
    ///
    /// # Safety
    /// - `raw` was allocated from `gpu`'s device, for its queue family, and is in the recording state, outside of a
    ///   render pass.
    /// - Everything that is recorded with it belongs to that device, was created for such commands, and is bound
    ///   before it is used; passes are recorded with resources of the sizes that they were made for.
    /// - The commands are submitted only while everything that they refer to is alive. Until they have run, the CPU
    ///   neither reads what they write nor writes what they read.
    #[must_use]
    pub unsafe fn new(
        gpu: &'a Gpu,
        raw: vk::CommandBuffer,
        timings: Option<&'a mut Timings>,
    ) -> Self {
        Self {
            gpu,
            raw,
            barriers: Cell::new(Barriers::new()),
            conditions: Cell::new(Conditions::default()),
            timings,
            labels: gpu.debug_labels.is_some(),
            traces: gpu.trace.is_asked(),
        }
    }

    /// Command buffer for commands of any kind, until the next [`Self::barrier`]. None of them is skipped.
    pub(crate) fn raw(&self) -> vk::CommandBuffer {
        self.change_condition(Conditions::before_others);
        self.before(Commands::Any)
    }

    /// Records dispatches that the device skips where the first word of a buffer is zero. What they are recorded with does not
    /// write that word; it may be written before and after. Within them, others may depend on another word instead. Copies, and
    /// commands recorded with [`Self::raw`], are not skipped.
    ///
    /// The device [can skip commands](super::Limits::conditional_rendering), and the buffer was made for it.
    pub(crate) fn unless_zero(&mut self, word: &Buffer, record: impl FnOnce(&mut Self)) {
        let before = self.conditions.get_mut().enter(word.raw);
        record(self);
        self.change_condition(|conditions| conditions.leave(before));
    }

    /// Buffer whose first word decides whether dispatches are skipped now, if [`Self::unless_zero`] is active.
    pub(crate) fn condition(&self) -> Option<vk::Buffer> {
        self.conditions.get().word()
    }

    /// Records what begins or ends at a step.
    fn change_condition(&self, step: impl FnOnce(&mut Conditions) -> Change) {
        let mut conditions = self.conditions.get();
        let change = step(&mut conditions);
        self.conditions.set(conditions);
        let Some(functions) = &self.gpu.conditional_rendering else {
            return;
        };
        // SAFETY: `new`'s contract; conditional rendering is ended before it is begun again. Both happen outside of
        // render passes, which are recorded with `raw`.
        unsafe {
            if change.ends {
                (functions.fp().cmd_end_conditional_rendering_ext)(self.raw);
            }
            if let Some(word) = change.begins {
                let info = vk::ConditionalRenderingBeginInfoEXT::default().buffer(word);
                (functions.fp().cmd_begin_conditional_rendering_ext)(self.raw, &info);
            }
        }
    }

    /// Command buffer for a dispatch.
    fn dispatching(&self) -> vk::CommandBuffer {
        let raw = self.before(Commands::Dispatches);
        self.change_condition(Conditions::before_dispatch);
        raw
    }

    /// Command buffer for binding and pushing, which need no barrier.
    pub(crate) fn bindings(&self) -> vk::CommandBuffer {
        self.raw
    }

    /// Command buffer, after the barrier that commands of this kind need.
    fn before(&self, next: Commands) -> vk::CommandBuffer {
        let mut barriers = self.barriers.get();
        if let Some(commands) = barriers.before(next) {
            let can_skip = self.gpu.conditional_rendering.is_some();
            let barriers = [commands.barrier(can_skip)];
            let info = vk::DependencyInfo::default().memory_barriers(&barriers);
            // SAFETY: `new`'s contract; synchronization2 is enabled.
            unsafe { self.gpu.device.cmd_pipeline_barrier2(self.raw, &info) };
        }
        self.barriers.set(barriers);
        self.raw
    }

    pub(crate) fn device(&self) -> &ash::Device {
        &self.gpu.device
    }

    /// Requests a barrier that makes all earlier writes visible to all later commands.
    pub fn barrier(&self) {
        let mut barriers = self.barriers.get();
        barriers.ask();
        self.barriers.set(barriers);
    }

    /// Records the transition of an image to another layout, after all earlier and before all later commands.
    pub fn transition(&self, image: &Image, from: vk::ImageLayout, to: vk::ImageLayout) {
        let all = vk::PipelineStageFlags2::ALL_COMMANDS;
        let barriers = [vk::ImageMemoryBarrier2::default()
            .src_stage_mask(all)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(all)
            .dst_access_mask(vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE)
            .old_layout(from)
            .new_layout(to)
            .image(image.raw)
            .subresource_range(image.range())];
        let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
        // SAFETY: `new`'s contract; synchronization2 is enabled.
        unsafe { self.gpu.device.cmd_pipeline_barrier2(self.raw(), &info) };
    }

    /// Binds a pipeline.
    pub fn bind(&self, pipeline: &Pipeline) {
        // SAFETY: `new`'s contract.
        unsafe {
            self.gpu
                .device
                .cmd_bind_pipeline(self.bindings(), pipeline.bind_point, pipeline.raw)
        };
        if self.traces && pipeline.bind_point == vk::PipelineBindPoint::GRAPHICS {
            self.gpu.trace(pipeline, Dispatched::Drawn);
        }
    }

    /// Dispatches `groups` workgroups of a pipeline, in rows of 32,768, and requests a barrier after them.
    pub fn dispatch(&self, pipeline: &Pipeline, groups: u64) {
        self.dispatch_unordered(pipeline, groups);
        self.barrier();
    }

    /// Dispatches as [`Self::dispatch`] does, without a barrier, for dispatches that write different places.
    pub fn dispatch_unordered(&self, pipeline: &Pipeline, groups: u64) {
        let rows = groups.div_ceil(32768) as u32;
        self.run(pipeline, Dispatched::Workgroups(groups), |device, raw| {
            // SAFETY: `new`'s contract; 32,768 is below every device's limit of 65,535.
            unsafe { device.cmd_dispatch(raw, groups.min(32768) as u32, rows, 1) };
        });
    }

    /// Dispatches at least `invocations` invocations, in workgroups of the size that the pipeline's shader declares, and requests a
    /// barrier after them.
    pub fn dispatch_each(&self, pipeline: &Pipeline, invocations: u64) {
        self.dispatch(pipeline, invocations.div_ceil(pipeline.workgroup()));
    }

    /// Dispatches the number of workgroups in vector `index` of `arguments`, and requests a barrier after them.
    pub fn dispatch_indirect(&self, pipeline: &Pipeline, arguments: &Buffer, index: u32) {
        self.dispatch_indirect_unordered(pipeline, arguments, index);
        self.barrier();
    }

    /// Dispatches as [`Self::dispatch_indirect`] does, without a barrier, for dispatches that write different places.
    pub fn dispatch_indirect_unordered(&self, pipeline: &Pipeline, arguments: &Buffer, index: u32) {
        self.run(pipeline, Dispatched::Indirect(index), |device, raw| {
            // SAFETY: `new`'s contract; the vector lies in the buffer, which was created for indirect use.
            unsafe { device.cmd_dispatch_indirect(raw, arguments.raw, u64::from(index) * 16) };
        });
    }

    /// Records a dispatch of a pipeline, labelled with the name of its shader.
    fn run(
        &self,
        pipeline: &Pipeline,
        size: Dispatched,
        record: impl FnOnce(&ash::Device, vk::CommandBuffer),
    ) {
        self.bind(pipeline);
        let raw = self.dispatching();
        let labels = self.gpu.debug_labels.as_ref().filter(|_| self.labels);
        let labelled = labels.zip(pipeline.interface());
        if let Some((labels, interface)) = labelled {
            let name = std::ffi::CString::new(interface.name).unwrap_or_default();
            let label = vk::DebugUtilsLabelEXT::default().label_name(&name);
            // SAFETY: `new`'s contract; the name is copied, and the label is ended below.
            unsafe { labels.cmd_begin_debug_utils_label(raw, &label) };
        }
        record(&self.gpu.device, raw);
        if let Some((labels, _)) = labelled {
            // SAFETY: the label was begun above.
            unsafe { labels.cmd_end_debug_utils_label(raw) };
        }
        if self.traces {
            self.gpu.trace(pipeline, size);
        }
    }

    /// Sets the push constants of `layout`.
    pub fn push(&self, layout: vk::PipelineLayout, pushed: &impl bytemuck::NoUninit) {
        let bytes = bytemuck::bytes_of(pushed);
        // SAFETY: `new`'s contract; layouts have room for the push constants of their passes.
        unsafe {
            self.gpu
                .device
                .cmd_push_constants(self.bindings(), layout, PUSH_STAGES, 0, bytes)
        };
    }

    /// Copies the first `bytes` bytes of a buffer to another one, from `first_byte` of that on. Both were created for
    /// copies and are large enough.
    pub(crate) fn copy(&self, from: &Buffer, bytes: u64, to: &Buffer, first_byte: u64) {
        // SAFETY: as documented above.
        unsafe { self.copy_raw((from.raw, 0), (to.raw, first_byte), bytes) };
    }

    /// Copies bytes of a buffer to another one, from a byte of each on.
    ///
    /// # Safety
    /// Both buffers were created for copies, contain the bytes, and outlive the execution of the commands.
    pub(crate) unsafe fn copy_raw(
        &self,
        (from, from_byte): (vk::Buffer, u64),
        (to, to_byte): (vk::Buffer, u64),
        bytes: u64,
    ) {
        let region = [vk::BufferCopy::default()
            .src_offset(from_byte)
            .dst_offset(to_byte)
            .size(bytes)];
        let raw = self.before(Commands::Dispatches);
        // SAFETY: `new`'s contract; the rest is guaranteed by the caller.
        unsafe { self.gpu.device.cmd_copy_buffer(raw, from, to, &region) };
    }

    /// Writes bytes to a buffer from `first_byte` on. Their number and `first_byte` are multiples of four.
    pub(crate) fn update(&self, buffer: &Buffer, first_byte: u64, bytes: &[u8]) {
        /// Largest number of bytes of an inline update.
        const AT_ONCE: usize = 65_536;
        let raw = self.before(Commands::Dispatches);
        for (chunk, bytes) in (0..).zip(bytes.chunks(AT_ONCE)) {
            let offset = first_byte + chunk * AT_ONCE as u64;
            // SAFETY: `new`'s contract; the buffer was created as a transfer destination, and callers respect its
            // size.
            unsafe {
                self.gpu
                    .device
                    .cmd_update_buffer(raw, buffer.raw, offset, bytes)
            };
        }
    }

    /// Fills a buffer with zeros.
    pub fn clear(&self, buffer: &Buffer) {
        self.clear_first(buffer, vk::WHOLE_SIZE);
    }

    /// Fills the first `bytes` bytes of a buffer with zeros.
    pub fn clear_first(&self, buffer: &Buffer, bytes: u64) {
        let raw = self.before(Commands::Dispatches);
        // SAFETY: `new`'s contract; the buffer was created as a transfer destination, and callers respect its size.
        unsafe {
            self.gpu
                .device
                .cmd_fill_buffer(raw, buffer.raw, 0, bytes, 0)
        };
    }

    /// Ends a named section of the frame: the time since the previous mark is attributed to `name`.
    pub fn mark(&mut self, name: &'static str) {
        if let Some(timings) = self.timings.as_deref_mut() {
            timings.mark(self.gpu, self.raw, Some(name));
        }
    }

    /// Continues timing in a command buffer that follows another one.
    pub fn go_on(&mut self) {
        if let Some(timings) = self.timings.as_deref_mut() {
            timings.mark(self.gpu, self.raw, None);
        }
    }

    /// Records what was recorded before, without marks, labels and traces, which would cost more than skipped commands. The next
    /// mark includes their time.
    pub(crate) fn repeated(&mut self, record: impl FnOnce(&mut Self)) {
        let traces = std::mem::replace(&mut self.traces, false);
        self.untimed(record);
        self.traces = traces;
    }

    /// Records without marks and labels. The next mark includes the time of what is recorded.
    pub(crate) fn untimed(&mut self, record: impl FnOnce(&mut Self)) {
        let timings = self.timings.take();
        let labels = std::mem::replace(&mut self.labels, false);
        record(self);
        self.timings = timings;
        self.labels = labels;
    }

    /// Starts timing.
    pub fn begin(&mut self) {
        if let Some(timings) = self.timings.as_deref_mut() {
            timings.begin(self.gpu, self.raw);
        }
    }
}

impl Drop for Recorder<'_> {
    fn drop(&mut self) {
        // Commands that the caller records next must also wait for the last barrier.
        self.raw();
    }
}

/// Timestamps of a frame. The times of equal names are added up.
pub struct Timings {
    gpu: Arc<Gpu>,
    pool: vk::QueryPool,
    capacity: u32,
    names: Vec<Option<&'static str>>,
}

impl Timings {
    /// Makes a timer with room for `capacity` marks; further marks are ignored.
    ///
    /// # Errors
    /// [`VulkanError::Call`] if the query pool can't be made.
    pub fn new(gpu: &Arc<Gpu>, capacity: u32) -> Result<Self, VulkanError> {
        let info = vk::QueryPoolCreateInfo::default()
            .query_type(vk::QueryType::TIMESTAMP)
            .query_count(capacity);
        // SAFETY: plain creation on a live device.
        let pool = unsafe { gpu.device.create_query_pool(&info, None) }
            .map_err(VulkanError::of("vkCreateQueryPool"))?;
        Ok(Self {
            gpu: gpu.clone(),
            pool,
            capacity,
            names: Vec::new(),
        })
    }

    fn begin(&mut self, gpu: &Gpu, raw: vk::CommandBuffer) {
        self.names.clear();
        // SAFETY: the recorder's contract; the pool is not in use, because the previous frame's commands have run.
        unsafe {
            gpu.device
                .cmd_reset_query_pool(raw, self.pool, 0, self.capacity)
        };
        self.mark(gpu, raw, None);
    }

    fn mark(&mut self, gpu: &Gpu, raw: vk::CommandBuffer, name: Option<&'static str>) {
        let index = self.names.len() as u32;
        if gpu.limits().timestamp_period == 0.0 || index >= self.capacity {
            return;
        }
        // SAFETY: the recorder's contract; the query was reset at the beginning of the frame.
        unsafe {
            gpu.device.cmd_write_timestamp2(
                raw,
                vk::PipelineStageFlags2::ALL_COMMANDS,
                self.pool,
                index,
            )
        };
        self.names.push(name);
    }

    /// Milliseconds by name, in the order of first appearance. This does not wait.
    ///
    /// # Errors
    /// [`VulkanError::NotDone`] if the commands have not run, [`VulkanError::Call`] if the results can't be read.
    pub fn read(&self) -> Result<Vec<(&'static str, f64)>, VulkanError> {
        let mut stamps = vec![0_u64; self.names.len()];
        if !stamps.is_empty() {
            let flags = vk::QueryResultFlags::TYPE_64;
            // SAFETY: the pool belongs to the device and has at least this many queries. They were reset when the
            // names were recorded; after that, results may be read at any time without waiting.
            unsafe {
                self.gpu
                    .device
                    .get_query_pool_results(self.pool, 0, &mut stamps, flags)
            }
            .map_err(|result| match result {
                vk::Result::NOT_READY => VulkanError::NotDone,
                result => VulkanError::of("vkGetQueryPoolResults")(result),
            })?;
        }
        let period = f64::from(self.gpu.limits().timestamp_period) * 1e-6;
        let mut times: Vec<(&'static str, f64)> = Vec::new();
        for (pair, name) in stamps.windows(2).zip(self.names.iter().skip(1)) {
            let (Some(name), &[before, after]) = (name, pair) else {
                continue;
            };
            let ms = after.saturating_sub(before) as f64 * period;
            match times.iter_mut().find(|(known, _)| known == name) {
                Some((_, sum)) => *sum += ms,
                None => times.push((name, ms)),
            }
        }
        Ok(times)
    }
}

impl Drop for Timings {
    fn drop(&mut self) {
        // SAFETY: owners drop timings only after the frames that use them have run.
        unsafe { self.gpu.device.destroy_query_pool(self.pool, None) };
    }
}

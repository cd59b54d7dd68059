//! Recording into a command buffer.

use super::barriers::{Accesses, Barriers, Ordered};
use super::conditions::{Change, Conditions};
use super::descriptor_set::ShownSets;
use super::timings::{PassTime, Timings};
use super::trace::Dispatched;
use super::{Access, Binding, Buffer, DescriptorSets, Gpu, Image, Interface, Limits, Pipeline};
use ash::vk;
use std::cell::{Cell, RefCell};
use std::sync::Arc;

/// Number of descriptor sets that a pipeline may use.
const SETS: usize = 3;

/// Recorder of a frame's commands into a caller's command buffer.
///
/// It binds each pipeline's descriptor sets, chosen from the data that was selected last.
///
/// It records a barrier before a command that depends on an earlier one: the interface of a dispatch's shader says which bindings it
/// reads and writes, and the sets say which buffers these are. Copies and fills name their buffers. Before and after commands of
/// which it knows nothing, it orders everything.
pub struct Recorder<'a> {
    gpu: &'a Gpu,
    raw: vk::CommandBuffer,
    barriers: RefCell<Barriers>,
    conditions: Cell<Conditions>,
    /// Descriptor sets that pipelines use from now on: a frame's, and a pass's own.
    shown: RefCell<[Option<Arc<ShownSets>>; 2]>,
    /// What is bound.
    bound: Cell<Bound>,
    timings: RefCell<Option<&'a mut Timings>>,
    /// Whether timing has begun.
    is_timed: Cell<bool>,
    /// Whether a named section is being recorded.
    in_section: Cell<bool>,
    /// Whether the present commands repeat those of an earlier round.
    repeats: Cell<bool>,
    /// Whether commands are traced.
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
    pub unsafe fn new(gpu: &'a Gpu, raw: vk::CommandBuffer, timings: Option<&'a mut Timings>) -> Self {
        Self {
            gpu,
            raw,
            barriers: RefCell::new(Barriers::new()),
            conditions: Cell::new(Conditions::default()),
            shown: RefCell::default(),
            bound: Cell::default(),
            timings: RefCell::new(timings),
            is_timed: Cell::new(false),
            in_section: Cell::new(false),
            repeats: Cell::new(false),
            traces: gpu.trace.is_asked(),
        }
    }

    /// Command buffer for commands of which the recorder knows nothing, until the next call of another function. They wait for all
    /// earlier commands, all later ones wait for them, and none of them is skipped.
    pub(crate) fn raw(&self) -> vk::CommandBuffer {
        self.change_condition(Conditions::before_others);
        let barrier = self.barriers.borrow_mut().before_unknown();
        self.record_barrier(barrier, &[]);
        // The commands may bind other sets.
        self.bound.take();
        self.raw
    }

    /// Records dispatches that the device skips where the first word of a buffer is zero. What they are recorded with does not
    /// write that word; it may be written before and after. Within them, others may depend on another word instead. Copies, and
    /// commands recorded with [`Self::raw`], are not skipped.
    ///
    /// The device [can skip commands](super::Limits::conditional_rendering), and the buffer was made for it.
    pub(crate) fn unless_zero(&self, word: &Buffer, record: impl FnOnce()) {
        let mut conditions = self.conditions.get();
        let before = conditions.enter(word.raw);
        self.conditions.set(conditions);
        record();
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

    /// Command buffer for a dispatch of a pipeline that also reads a buffer.
    fn dispatching(&self, pipeline: &Pipeline, read: Option<vk::Buffer>) -> vk::CommandBuffer {
        let accesses = self.accesses(pipeline, read);
        let barrier = self.barriers.borrow_mut().before(&accesses);
        self.record_barrier(barrier, &[]);
        self.change_condition(Conditions::before_dispatch);
        self.raw
    }

    /// Accesses of a dispatch of a pipeline that also reads a buffer.
    fn accesses(&self, pipeline: &Pipeline, read: Option<vk::Buffer>) -> Accesses {
        let mut accesses = Accesses::default();
        let shown = self.shown.borrow();
        let sets = sets_of(pipeline, &shown);
        for used in pipeline.interface().uses {
            // What no set shows, a shader does not use with its constants.
            let set = sets[used.set as usize];
            let Some(buffer) = set.and_then(|(_, set)| set.buffer(used.binding.number)) else {
                continue;
            };
            if used.access != Access::Write {
                accesses.read(buffer);
            }
            if used.access != Access::Read {
                accesses.write(buffer);
            }
        }
        for buffer in read.into_iter().chain(self.condition()) {
            accesses.read(buffer);
        }
        accesses
    }

    /// Command buffer, after the barrier that a dispatch, copy or fill with these accesses needs.
    fn before(&self, accesses: &Accesses) -> vk::CommandBuffer {
        let barrier = self.barriers.borrow_mut().before(accesses);
        self.record_barrier(barrier, &[]);
        self.raw
    }

    /// Records a barrier, and changes of images with it.
    fn record_barrier(&self, ordered: Option<Ordered>, images: &[vk::ImageMemoryBarrier2<'_>]) {
        let can_skip = self.gpu.conditional_rendering.is_some();
        let memory: Vec<_> = ordered.map(|ordered| ordered.barrier(can_skip)).into_iter().collect();
        if memory.is_empty() && images.is_empty() {
            return;
        }
        let info = vk::DependencyInfo::default().memory_barriers(&memory).image_memory_barriers(images);
        // SAFETY: `new`'s contract; synchronization2 is enabled.
        unsafe { self.gpu.device.cmd_pipeline_barrier2(self.raw, &info) };
        if self.traces {
            self.gpu.trace_barrier();
        }
    }

    /// Limits of the device.
    pub(crate) fn limits(&self) -> &Limits {
        self.gpu.limits()
    }

    pub(crate) fn device(&self) -> &ash::Device {
        &self.gpu.device
    }

    /// Records commands that do not depend on each other, although they may use the same buffers: they write different places, or
    /// what they write does not depend on their order.
    pub fn unordered(&self, record: impl FnOnce()) {
        let begins = self.barriers.borrow_mut().begin_group();
        record();
        if begins {
            self.barriers.borrow_mut().end_group();
        }
    }

    /// Records the transition of an image to another layout, after all earlier and before all later commands.
    pub fn transition(&self, image: &Image, from: vk::ImageLayout, to: vk::ImageLayout) {
        let all = vk::PipelineStageFlags2::ALL_COMMANDS;
        self.change_image(
            vk::ImageMemoryBarrier2::default()
                .src_stage_mask(all)
                .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
                .dst_stage_mask(all)
                .dst_access_mask(vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE)
                .old_layout(from)
                .new_layout(to)
                .image(image.raw)
                .subresource_range(image.range()),
        );
    }

    /// Records the copy of colours from a buffer to the levels of an image, which shaders can read afterwards. A level is
    /// given as its first byte in the buffer and its size in texels; there, its layers follow one another. What else
    /// the image held is lost. Both were created for copies and are large enough.
    pub(crate) fn fill_image(&self, image: &Image, texels: &Buffer, levels: impl IntoIterator<Item = (u64, [u32; 2])>) {
        let copy = |(level, (first_byte, [width, height])): (u32, (u64, [u32; 2]))| {
            vk::BufferImageCopy::default()
                .buffer_offset(first_byte)
                .image_subresource(vk::ImageSubresourceLayers {
                    aspect_mask: vk::ImageAspectFlags::COLOR,
                    mip_level: level,
                    base_array_layer: 0,
                    layer_count: image.layers,
                })
                .image_extent(vk::Extent3D { width, height, depth: 1 })
        };
        let copies: Vec<_> = (0..).zip(levels).map(copy).collect();
        let written = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        self.transition(image, vk::ImageLayout::UNDEFINED, written);
        // SAFETY: `new`'s contract; callers respect the sizes of the buffer and the image, which has this layout.
        unsafe { self.device().cmd_copy_buffer_to_image(self.raw(), texels.raw, image.raw, written, &copies) };
        self.transition(image, written, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
    }

    /// Records the change of an image, after all earlier commands. Later commands may use the image as it says, and everything else
    /// that was written before.
    pub(crate) fn change_image(&self, change: vk::ImageMemoryBarrier2<'_>) {
        self.change_condition(Conditions::before_others);
        self.record_barrier(Some(Ordered::All), &[change]);
        self.barriers.borrow_mut().all_ordered();
    }

    /// Selects the data that pipelines read and write from now on. The sets replace the frame's sets, or the pass's own sets.
    pub(crate) fn show(&self, sets: &DescriptorSets) {
        let slot = usize::from(!sets.are_of_frame());
        self.shown.borrow_mut()[slot] = Some(sets.shown().clone());
    }

    /// Binds a pipeline, and its sets from the first one on that is not bound.
    pub fn bind(&self, pipeline: &Pipeline) {
        let (raw, point, layout) = (self.raw, pipeline.bind_point, &pipeline.layout);
        let shown = self.shown.borrow();
        let known = sets_of(pipeline, &shown);
        let set = |number: usize| Some((layout.sets.get(number)?.raw, known[number]?.0));
        let sets: [_; SETS] = std::array::from_fn(set);
        let (bound_to, bound) = self.bound.replace((point, sets));
        let is_bound = |number: &usize| bound_to == point && bound[*number] == sets[*number];
        let first = (0..SETS).take_while(is_bound).count();
        let missing = sets[first..].iter().map_while(|set| Some((*set)?.1));
        let missing: Vec<_> = missing.collect();
        // SAFETY: `new`'s contract; the sets were made with the pipeline's layouts.
        unsafe {
            let device = &self.gpu.device;
            device.cmd_bind_pipeline(raw, point, pipeline.raw);
            if !missing.is_empty() {
                let (layout, first) = (layout.raw, first as u32);
                device.cmd_bind_descriptor_sets(raw, point, layout, first, &missing, &[]);
            }
        };
        if self.traces && pipeline.bind_point == vk::PipelineBindPoint::GRAPHICS {
            self.gpu.trace(pipeline, Dispatched::Drawn, !self.repeats.get());
        }
    }

    /// Dispatches `groups` workgroups of a pipeline, in rows of 32,768.
    pub fn dispatch(&self, pipeline: &Pipeline, groups: u64) {
        let rows = groups.div_ceil(32768) as u32;
        let size = Dispatched::Workgroups(groups);
        self.run(pipeline, size, None, |device, raw| {
            // SAFETY: `new`'s contract; 32,768 is below every device's limit of 65,535.
            unsafe { device.cmd_dispatch(raw, groups.min(32768) as u32, rows, 1) };
        });
    }

    /// Dispatches at least `invocations` invocations, in workgroups of the size that the pipeline's shader declares.
    pub fn dispatch_each(&self, pipeline: &Pipeline, invocations: u64) {
        self.dispatch(pipeline, invocations.div_ceil(pipeline.workgroup()));
    }

    /// Dispatches the number of workgroups in vector `index` of `arguments`.
    pub fn dispatch_indirect(&self, pipeline: &Pipeline, arguments: vk::Buffer, index: u32) {
        let size = Dispatched::Indirect(index);
        self.run(pipeline, size, Some(arguments), |device, raw| {
            // SAFETY: `new`'s contract; the vector lies in the buffer, which was created for indirect use.
            unsafe { device.cmd_dispatch_indirect(raw, arguments, u64::from(index) * 16) };
        });
    }

    /// Records a dispatch of a pipeline that also reads a buffer. It is a pass, or a part of one.
    fn run(
        &self,
        pipeline: &Pipeline,
        size: Dispatched,
        read: Option<vk::Buffer>,
        record: impl FnOnce(&ash::Device, vk::CommandBuffer),
    ) {
        self.pass(pipeline.interface(), || {
            self.bind(pipeline);
            record(&self.gpu.device, self.dispatching(pipeline, read));
            if self.traces {
                self.gpu.trace(pipeline, size, !self.repeats.get());
            }
        });
    }

    /// Records a pass, named like the shader with this interface.
    pub(crate) fn pass(&self, interface: &'static Interface, record: impl FnOnce()) {
        self.section(interface.pass(), record);
    }

    /// Records a section with a debug label: a pass, or one of the other parts of a frame that [`PassTime`] names. If it is not part
    /// of another one, the time from the end of the section before it is attributed to its name.
    pub fn section(&self, name: &'static str, record: impl FnOnce()) {
        let outer = self.in_section.replace(true);
        let labels = self.gpu.debug_labels.as_ref();
        // Labels of a repetition would cost more than its skipped commands.
        let labels = labels.filter(|_| !self.repeats.get());
        if let Some(labels) = labels {
            let name = std::ffi::CString::new(name).unwrap_or_default();
            let label = vk::DebugUtilsLabelEXT::default().label_name(&name);
            // SAFETY: `new`'s contract; the name is copied, and the label is ended below.
            unsafe { labels.cmd_begin_debug_utils_label(self.raw, &label) };
        }
        record();
        if let Some(labels) = labels {
            // SAFETY: the label was begun above.
            unsafe { labels.cmd_end_debug_utils_label(self.raw) };
        }
        self.in_section.set(outer);
        if !outer && self.is_timed.get() {
            self.mark(Some(name));
        }
    }

    /// Records rounds that repeat what was recorded before: their dispatches are neither labelled nor listed. Their passes are timed
    /// together, or one by one if the timer says so.
    pub(crate) fn repeated_rounds(&self, record: impl FnOnce()) {
        let repetition = || {
            let outer = self.repeats.replace(true);
            record();
            self.repeats.set(outer);
        };
        let one_by_one = |timings: &&mut Timings| timings.times_repetitions;
        if self.timings.borrow().as_ref().is_some_and(one_by_one) {
            repetition();
        } else {
            self.section(PassTime::ROUNDS, repetition);
        }
    }

    /// Sets the push constants of a pipeline, if there are any.
    pub fn push(&self, pipeline: &Pipeline, bytes: &[u8]) {
        let layout = &pipeline.layout;
        if bytes.is_empty() {
            return;
        }
        debug_assert!(bytes.len() <= layout.push.size as usize);
        // SAFETY: `new`'s contract; the layout has room for the push constants of its pass.
        unsafe { self.gpu.device.cmd_push_constants(self.raw, layout.raw, layout.push.stage_flags, 0, bytes) };
    }

    /// Copies the first `bytes` bytes of a buffer to another one, from `first_byte` of that on. Both were created for
    /// copies and are large enough.
    pub(crate) fn copy(&self, from: &Buffer, bytes: u64, to: &Buffer, first_byte: u64) {
        let region = vk::BufferCopy::default().dst_offset(first_byte).size(bytes);
        // SAFETY: as documented above.
        unsafe { self.copy_raw(from.raw, to.raw, &[region]) };
    }

    /// Copies regions of a buffer to another one, which may be the same.
    ///
    /// # Safety
    /// Both buffers were created for copies, contain the regions, and outlive the execution of the commands.
    pub(crate) unsafe fn copy_raw(&self, from: vk::Buffer, to: vk::Buffer, regions: &[vk::BufferCopy]) {
        let raw = self.before(&Accesses::copy(from, to));
        // SAFETY: `new`'s contract; the rest is guaranteed by the caller.
        unsafe { self.gpu.device.cmd_copy_buffer(raw, from, to, regions) };
    }

    /// Writes bytes to a buffer from `first_byte` on. Their number and `first_byte` are multiples of four.
    pub(crate) fn update(&self, buffer: &Buffer, first_byte: u64, bytes: &[u8]) {
        /// Largest number of bytes of an inline update.
        const AT_ONCE: usize = 65_536;
        let raw = self.writing(buffer.raw);
        for (chunk, bytes) in (0..).zip(bytes.chunks(AT_ONCE)) {
            let offset = first_byte + chunk * AT_ONCE as u64;
            // SAFETY: `new`'s contract; the buffer was created as a transfer destination, and callers respect its
            // size.
            unsafe { self.gpu.device.cmd_update_buffer(raw, buffer.raw, offset, bytes) };
        }
    }

    /// Buffer that the frame's sets show at a binding. The sets were named before.
    pub(crate) fn shown(&self, binding: Binding) -> vk::Buffer {
        let [of_frame, _] = &*self.shown.borrow();
        let buffer = of_frame.as_ref().and_then(|sets| sets.buffer(binding.number));
        debug_assert!(buffer.is_some(), "no set shows {}", binding.name);
        buffer.unwrap_or_default()
    }

    /// Fills the buffer that the frame's sets show at a binding with zeros.
    pub(crate) fn clear_shown(&self, binding: Binding) {
        self.fill_raw(self.shown(binding), vk::WHOLE_SIZE, 0);
    }

    /// Fills a buffer with zeros.
    pub fn clear(&self, buffer: &Buffer) {
        self.fill(buffer, vk::WHOLE_SIZE, 0);
    }

    /// Fills the first `bytes` bytes of a buffer with a word.
    pub fn fill(&self, buffer: &Buffer, bytes: u64, word: u32) {
        self.fill_raw(buffer.raw, bytes, word);
    }

    fn fill_raw(&self, buffer: vk::Buffer, bytes: u64, word: u32) {
        let raw = self.writing(buffer);
        // SAFETY: `new`'s contract; the buffer was created as a transfer destination, and callers respect its size.
        unsafe { self.gpu.device.cmd_fill_buffer(raw, buffer, 0, bytes, word) };
    }

    /// Command buffer for a command that writes a buffer.
    fn writing(&self, buffer: vk::Buffer) -> vk::CommandBuffer {
        let mut accesses = Accesses::default();
        accesses.write(buffer);
        self.before(&accesses)
    }

    /// Starts timing. Sections that were recorded before are not timed.
    pub fn begin(&self) {
        self.is_timed.set(true);
        if let Some(timings) = self.timings.borrow_mut().as_deref_mut() {
            timings.begin(self.raw);
        }
    }

    /// Continues timing in a command buffer that follows another one.
    pub fn go_on(&self) {
        self.is_timed.set(true);
        self.mark(None);
    }

    /// Attributes the time since the previous mark to a name, if it has one.
    fn mark(&self, name: Option<&'static str>) {
        if let Some(timings) = self.timings.borrow_mut().as_deref_mut() {
            timings.mark(self.raw, name);
        }
    }
}

/// Bind point and sets of the pipeline that was bound last, each set with its layout.
type Bound = (vk::PipelineBindPoint, [Option<(vk::DescriptorSetLayout, vk::DescriptorSet)>; SETS]);

/// The sets that a pipeline uses, by number, with what they show.
fn sets_of<'a>(
    pipeline: &Pipeline,
    shown: &'a [Option<Arc<ShownSets>>; 2],
) -> [Option<(vk::DescriptorSet, &'a ShownSets)>; SETS] {
    std::array::from_fn(|number| {
        let layout = pipeline.layout.sets.get(number)?;
        let mut shown = shown.iter().flatten();
        shown.find_map(|shown| Some((shown.of(layout)?, &**shown)))
    })
}

impl Drop for Recorder<'_> {
    fn drop(&mut self) {
        // Commands that the caller records next depend on any of these.
        self.raw();
    }
}

//! shadow: which receivers of light another triangle was found before.

use super::arguments::{After, Arguments};
use super::own_layout::{OwnSet, PipelineLayout, SetLayout, whole};
use super::{Argument, Cells, FrameLayout, Resources, SampleSet, spirv};
use crate::vulkan::{
    Buffer, Constants, Memory, MemoryUse, Pipeline, Recorder, VulkanError, compute_pipeline,
};
use ash::vk;
use std::sync::Arc;

/// What is pushed.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Push {
    first_place: u32,
    light: u32,
    ends: u32,
}

/// Words of what is left undone.
const LEFT_WORDS: usize = 2;

/// Writes the words of receivers, and counts what the passes before it left undone.
pub struct Shadow {
    arguments: Arguments,
    pipeline: Arc<Pipeline>,
    layout: PipelineLayout,
    set: OwnSet,
    _set_layout: SetLayout,
    left: Buffer,
    kept: Buffer,
}

impl Shadow {
    /// Makes the pipelines, which write the words of the receivers' resources.
    ///
    /// # Errors
    /// If the driver refuses one, or memory runs out.
    pub fn new(
        layout: &FrameLayout,
        memory: &Memory,
        receivers: &Resources,
    ) -> Result<Self, VulkanError> {
        let gpu = &layout.gpu;
        let kinds = [vk::DescriptorType::STORAGE_BUFFER; 2];
        let set_layout = SetLayout::new(gpu, &kinds)?;
        let sets = [layout.frame_set, set_layout.raw];
        let own_layout = PipelineLayout::new(gpu, &sets, size_of::<Push>() as u32)?;
        let words = receivers.sizes().shadow_words;
        let constants = Cells::Occluders.constants(Constants::new()).with(25, words);
        let pipeline = layout.cached(spirv::SHADOW, &constants, 0, || {
            compute_pipeline(gpu, own_layout.raw, spirv::SHADOW, &constants, None)
        })?;
        let words = |name, usage, place| memory.buffer(name, 4 * LEFT_WORDS as u64, usage, place);
        let transfer = vk::BufferUsageFlags::TRANSFER_DST;
        let storage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_SRC;
        let left = words("shadows left", storage | transfer, MemoryUse::Device)?;
        let kept = words("shadows left, read back", transfer, MemoryUse::Readback)?;
        let set = set_layout.allocate()?;
        // SAFETY: the set is new, and both buffers go with the frame that this is of.
        unsafe { set.write_buffers(0, &[whole(&receivers.shadow_words.buffer), whole(&left)]) };
        Ok(Self {
            arguments: Arguments::new(layout, After::Sample)?,
            pipeline,
            layout: own_layout,
            set,
            _set_layout: set_layout,
            left,
            kept,
        })
    }

    /// Records what begins a frame.
    pub fn record_begin(&self, recorder: &Recorder<'_>) {
        recorder.clear(&self.left);
        recorder.barrier();
    }

    /// Records it for the occluders of a round, whose set is bound, and which were found between a light and receivers that are
    /// places from one on.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        (occluders, set): (&Resources, &SampleSet),
        first_place: u32,
        light: u32,
    ) {
        self.arguments.record(recorder);
        self.bind(recorder, set, [first_place, light, 0]);
        let sort = Argument::Sort as u32;
        recorder.dispatch_indirect(&self.pipeline, &occluders.arguments, sort);
        occluders.record_bind(recorder, set);
    }

    /// Records what follows the last round.
    pub fn record_left(&self, recorder: &Recorder<'_>, set: &SampleSet) {
        self.bind(recorder, set, [0, 0, 1]);
        recorder.dispatch(&self.pipeline, 1);
    }

    /// Records what ends a frame.
    pub fn record_end(&self, recorder: &Recorder<'_>) {
        recorder.copy(&self.left, self.left.size(), &self.kept, 0);
        recorder.barrier();
    }

    /// Receivers and tiles that the last frame left undone, and whether kernels had other subgroups than they were made for.
    ///
    /// # Errors
    /// If these can't be read.
    pub fn left(&self) -> Result<(u32, bool), VulkanError> {
        let words: &[u32] = self.kept.read(LEFT_WORDS)?;
        let word = |index: usize| words.get(index).copied().unwrap_or(0);
        Ok((word(0), word(1) != 0))
    }

    fn bind(&self, recorder: &Recorder<'_>, set: &SampleSet, [first_place, light, ends]: [u32; 3]) {
        let push = Push {
            first_place,
            light,
            ends,
        };
        let sets = [set.descriptor(), self.set.raw];
        self.layout.bind(recorder, &sets, &push);
    }
}

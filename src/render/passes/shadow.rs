//! shadow: which receivers of light another triangle was found before.

use super::beside_frame::BesideFrame;
use crate::passes::arguments::{After, Arguments};
use crate::passes::own_layout::whole;
use crate::passes::spirv::{self, shadow_set};
use crate::passes::{Argument, FrameLayout, Resources, SampleSet};
use crate::vulkan::{Buffer, Memory, MemoryUse, Pipeline, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// What is done with what was found between a light and receivers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadowTarget {
    /// It is written down for places from one on.
    Words {
        /// The first place.
        first_place: u32,
    },
    /// Pixels of a region of some width are marked where their centres' words say otherwise.
    Marks {
        /// In pixels.
        width: u32,
    },
}

/// Words of what is left undone.
const LEFT_WORDS: usize = 2;

/// Writes the words of receivers, and counts what the passes before it left undone.
pub struct Shadow {
    arguments: Arguments,
    pipeline: Arc<Pipeline>,
    beside: BesideFrame<spirv::ShadowPush>,
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
        let words = |name, usage, place| memory.buffer(name, 4 * LEFT_WORDS as u64, usage, place);
        let transfer = vk::BufferUsageFlags::TRANSFER_DST;
        let storage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_SRC;
        let left = words("shadows left", storage | transfer, MemoryUse::Device)?;
        let kept = words("shadows left, read back", transfer, MemoryUse::Readback)?;
        let words = whole(&receivers.shadow_words.buffer);
        let shown = [
            (shadow_set::WORDS, words),
            (shadow_set::LEFT, whole(&left)),
            (shadow_set::MARKS_OF_PIXELS, whole(&receivers.marks)),
        ];
        // SAFETY: the buffers go with the frame that this is of.
        let beside = unsafe { BesideFrame::new(layout, &shadow_set::ALL, &shown) }?;
        let shadow_words = receivers.sizes().shadow_words;
        let pipeline = beside.pipeline(layout, &spirv::Shadow { shadow_words })?;
        Ok(Self {
            arguments: Arguments::new(layout, After::Sample)?,
            pipeline,
            beside,
            left,
            kept,
        })
    }

    /// Records what begins a frame.
    pub fn record_begin(&self, recorder: &Recorder<'_>) {
        recorder.clear(&self.left);
        recorder.barrier();
    }

    /// Records it for the occluders of a round, whose set is bound, and which were found between a light and receivers.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        (occluders, set): (&Resources, &SampleSet),
        target: ShadowTarget,
        light: u32,
    ) {
        self.arguments.record(recorder);
        let (first_place, width) = match target {
            ShadowTarget::Words { first_place } => (first_place, 0),
            ShadowTarget::Marks { width } => (0, width),
        };
        let push = spirv::ShadowPush {
            first_place,
            light,
            width,
            ..spirv::ShadowPush::default()
        };
        self.beside.bind(recorder, set, &push);
        let sort = Argument::Sort as u32;
        recorder.dispatch_indirect(&self.pipeline, &occluders.arguments, sort);
        occluders.record_bind(recorder, set);
    }

    /// Records what follows the last round.
    pub fn record_left(&self, recorder: &Recorder<'_>, set: &SampleSet) {
        let push = spirv::ShadowPush {
            ends: 1,
            ..spirv::ShadowPush::default()
        };
        self.beside.bind(recorder, set, &push);
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
}

//! shadow: finds the receivers of light that another triangle occludes. It is no [`Pass`](crate::engine::pipelines::Pass),
//! because the lights, and what is shadowed, are known only when a frame is recorded.

use crate::engine::data::{Argument, Resources};
use crate::engine::passes::arguments::{self, CountedBy};
use crate::engine::pipelines::{Dispatch, FrameLayout, Kernel};
use crate::engine::spirv::{self, shadow_set};
use crate::vulkan::{
    Buffer, DescriptorSets, Memory, MemoryUse, Recorder, Specialized, VulkanError,
};
use ash::vk;

/// Use of the occluders that were found between a light and its receivers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadowTarget {
    /// Sets bits in the shadow words of places.
    Words {
        /// Index of the first place.
        first_place: u32,
    },
    /// Marks pixels of a region in which a probe's shadow words differ from those of the centre.
    Marks {
        /// Width of the region in pixels.
        width: u32,
    },
}

/// Number of words in the counters of unfinished work.
const LEFT_WORDS: usize = 2;

/// Writes the shadow words of receivers, and counts what the passes before it could not finish.
pub struct Shadow {
    sizes: Dispatch,
    kernel: Kernel<spirv::Shadow>,
    own: DescriptorSets,
    left: Buffer,
    kept: Buffer,
}

impl Shadow {
    /// Makes the pipelines, which write the shadow words of the receivers' resources.
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
        let shown = [
            (shadow_set::WORDS, (&receivers.shadow_words.buffer).into()),
            (shadow_set::LEFT, (&left).into()),
            (shadow_set::MARKS_OF_PIXELS, (&receivers.marks).into()),
        ];
        let shadow_words = receivers.sizes().shadow_words;
        Ok(Self {
            sizes: arguments::dispatch(layout, CountedBy::Sample)?,
            kernel: layout.kernel(&spirv::Shadow { shadow_words })?,
            // SAFETY: the buffers live as long as the frame to which this belongs.
            own: unsafe { layout.own_set(spirv::Shadow::INTERFACE, &shown) }?,
            left,
            kept,
        })
    }

    /// Records the beginning of a frame.
    pub fn record_begin(&self, recorder: &Recorder<'_>) {
        recorder.clear(&self.left);
    }

    /// Records the pass for the occluders of a round, whose descriptor sets passes use.
    pub fn record(&self, recorder: &Recorder<'_>, target: ShadowTarget, light: u32) {
        self.sizes.record(recorder, 0);
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
        recorder.show(&self.own);
        self.kernel.record_indirect(recorder, &push, Argument::Sort);
    }

    /// Records the count of unfinished work, after the last round.
    pub fn record_left(&self, recorder: &Recorder<'_>) {
        let push = spirv::ShadowPush {
            ends: 1,
            ..spirv::ShadowPush::default()
        };
        recorder.show(&self.own);
        self.kernel.record(recorder, &push, 1_u32);
    }

    /// Records the end of a frame.
    pub fn record_end(&self, recorder: &Recorder<'_>) {
        recorder.copy(&self.left, self.left.size(), &self.kept, 0);
    }

    /// Number of receivers and tiles that the last frame could not finish, and whether kernels ran with another
    /// subgroup size than expected.
    ///
    /// # Errors
    /// If the counters can't be read.
    pub fn left(&self) -> Result<(u32, bool), VulkanError> {
        let words: &[u32] = self.kept.read(LEFT_WORDS)?;
        let word = |index: usize| words.get(index).copied().unwrap_or(0);
        Ok((word(0), word(1) != 0))
    }
}

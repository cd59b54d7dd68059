//! shadow: finds the receivers of light that another triangle occludes. It is no [`Pass`](crate::engine::pipelines::Pass),
//! because the lights, and what is shadowed, are known only when a frame is recorded.

use crate::engine::data::{Argument, Resources};
use crate::engine::passes::arguments::{self, CountedBy};
use crate::engine::pipelines::{Dispatch, FrameLayout, Kernel};
use crate::engine::spirv::{self, shadow_set};
use crate::render::passes::Unshadowed;
use crate::vulkan::{DescriptorSets, Recorder, Specialized, VulkanError};

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

impl ShadowTarget {
    /// Place of the first receiver, and the width of the region whose pixels are probed; 0 without probes.
    pub fn pushed(self) -> (u32, u32) {
        match self {
            Self::Words { first_place } => (first_place, 0),
            Self::Marks { width } => (0, width),
        }
    }
}

/// Writes the shadow words of receivers, and counts what the passes before it could not finish.
pub struct Shadow {
    sizes: Dispatch,
    kernel: Kernel<spirv::Shadow>,
    own: DescriptorSets,
}

impl Shadow {
    /// Makes the pipelines, which write the shadow words of the receivers' resources.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, receivers: &Resources, unshadowed: &Unshadowed) -> Result<Self, VulkanError> {
        let shown = [
            (shadow_set::WORDS, (&receivers.shadow_words.buffer).into()),
            (shadow_set::LEFT, unshadowed.buffer().into()),
            (shadow_set::MARKS_OF_PIXELS, (&receivers.marks).into()),
        ];
        let shadow_words = receivers.sizes().shadow_words;
        Ok(Self {
            sizes: arguments::dispatch(layout, CountedBy::Sample)?,
            kernel: layout.kernel(&spirv::Shadow { shadow_words })?,
            // SAFETY: the buffers live as long as the frame to which this belongs.
            own: unsafe { layout.own_set(spirv::Shadow::INTERFACE, &shown) }?,
        })
    }

    /// Records the pass for the occluders of a round, whose descriptor sets passes use.
    pub fn record(&self, recorder: &Recorder<'_>, target: ShadowTarget, light: u32) {
        self.sizes.record(recorder, 0);
        let (first_place, width) = target.pushed();
        let push = spirv::ShadowPush { first_place, light, width, ..spirv::ShadowPush::default() };
        recorder.show(&self.own);
        self.kernel.record_indirect(recorder, &push, Argument::Records);
    }

    /// Records the count of unfinished work, after the last round.
    pub fn record_left(&self, recorder: &Recorder<'_>) {
        let push = spirv::ShadowPush { ends: 1, ..spirv::ShadowPush::default() };
        recorder.show(&self.own);
        self.kernel.record(recorder, &push, 1_u32);
    }
}

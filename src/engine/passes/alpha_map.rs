//! alpha_map: a host's alpha maps as the alpha test reads them.

use super::spirv::{self, alpha_map_set};
use crate::engine::pipelines::own_layout::{OwnSet, PipelineLayout, SetLayout, whole};
use crate::vulkan::{
    Buffer, Compiled, Gpu, Pipeline, Recorder, Specialized, VulkanError, compute_pipeline,
};
use ash::vk;
use std::sync::Arc;

/// A level of an alpha map, of a size in texels, and its first word in the atlas. It repeats along u where `repeats` has 1, and along v
/// where it has 2.
pub(crate) use spirv::AlphaMapPush as AlphaLevel;

impl AlphaLevel {
    /// Places between 2 x 2 texels, the first of them half outside of the image: a word each.
    pub fn words(&self) -> u64 {
        let [width, height] = self.size.map(|side| u64::from(side) + 1);
        width * height
    }
}

/// Reads the levels of images.
pub(crate) struct AlphaMaps {
    layout: PipelineLayout,
    set_layout: SetLayout,
    pipeline: Pipeline,
}

impl AlphaMaps {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(gpu: &Arc<Gpu>) -> Result<Self, VulkanError> {
        let set_layout = SetLayout::new(gpu, &alpha_map_set::ALL)?;
        let layout = PipelineLayout::new(gpu, &[set_layout.raw], size_of::<AlphaLevel>() as u32)?;
        let constants = spirv::AlphaMap.constants();
        let code = spirv::AlphaMap::code();
        Ok(Self {
            pipeline: compute_pipeline(gpu, layout.raw, code, &constants, None)?
                .of(spirv::AlphaMap::INTERFACE),
            layout,
            set_layout,
        })
    }

    /// A set that shows a host's image and the atlas.
    ///
    /// # Safety
    /// The view outlives the set's use.
    pub unsafe fn set(&self, view: vk::ImageView, atlas: &Buffer) -> Result<OwnSet, VulkanError> {
        let set = self.set_layout.allocate()?;
        // SAFETY: the set is new; of the view as the caller says, the atlas goes with the frame.
        unsafe {
            set.write_image(alpha_map_set::MAP, view);
            set.write_buffers(&[(alpha_map_set::ATLAS, whole(atlas))]);
        }
        Ok(set)
    }

    /// Records one level, with no barrier after it: each writes words of its own.
    pub fn record(&self, recorder: &Recorder<'_>, set: &OwnSet, level: &AlphaLevel) {
        self.layout.bind(recorder, &[set.raw], level);
        recorder.dispatch_unordered(&self.pipeline, level.words().div_ceil(64));
    }
}

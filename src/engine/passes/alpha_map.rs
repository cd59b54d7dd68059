//! alpha_map: converts a host's alpha maps to the form that the alpha test reads.

use super::spirv::{self, alpha_map_set};
use crate::engine::pipelines::own_layout::{OwnSet, PipelineLayout, SetLayout};
use crate::vulkan::{
    Buffer, Compiled, Gpu, Pipeline, Recorder, Specialized, VulkanError, compute_pipeline,
    read_image,
};
use ash::vk;
use std::sync::Arc;

/// Level of an alpha map: its size in texels, and its first word in the atlas. Bits 0 and 1 of `repeats` say whether
/// the map repeats along u and v.
pub(crate) use spirv::AlphaMapPush as AlphaLevel;

impl AlphaLevel {
    /// Number of words of the level: (width + 1) x (height + 1). Each word belongs to a corner where 2 x 2 texels meet,
    /// including the corners at the border of the image.
    pub fn words(&self) -> u64 {
        let [width, height] = self.size.map(|side| u64::from(side) + 1);
        width * height
    }
}

/// Kernel that reads the levels of a host's images.
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
        let code = (spirv::AlphaMap::code(), spirv::AlphaMap::INTERFACE);
        Ok(Self {
            pipeline: compute_pipeline(gpu, layout.raw, code, &constants, None)?,
            layout,
            set_layout,
        })
    }

    /// Makes a set with a host's image and the atlas.
    ///
    /// # Safety
    /// The view outlives the use of the set.
    pub unsafe fn set(&self, view: vk::ImageView, atlas: &Buffer) -> Result<OwnSet, VulkanError> {
        let mut own = self.set_layout.allocate()?;
        // SAFETY: the set is new; the caller guarantees the view, and the atlas lives as long as the frame.
        unsafe {
            own.set
                .write_images(alpha_map_set::MAP, &[read_image(view)]);
            own.set.write(&[(alpha_map_set::ATLAS, atlas.into())]);
        }
        Ok(own)
    }

    /// Records the pass for a level. Each level writes its own words.
    pub fn record(&self, recorder: &Recorder<'_>, own: &OwnSet, level: &AlphaLevel) {
        self.layout.bind(recorder, &[&own.set], level);
        recorder.dispatch_each(&self.pipeline, level.words());
    }
}

//! alpha_map: a host's alpha maps as the alpha test reads them.

use super::own_layout::{OwnSet, PipelineLayout, SetLayout, whole};
use super::spirv;
use crate::vulkan::{Buffer, Constants, Gpu, Pipeline, Recorder, VulkanError, compute_pipeline};
use ash::vk;
use std::sync::Arc;

/// A level of an alpha map, and where it goes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct AlphaLevel {
    /// In texels.
    pub size: [u32; 2],
    pub level: u32,
    /// Its first word in the atlas.
    pub first: u32,
    /// 1 where it repeats along u, and 2 along v.
    pub repeats: u32,
}

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
        let kinds = [
            vk::DescriptorType::SAMPLED_IMAGE,
            vk::DescriptorType::STORAGE_BUFFER,
        ];
        let set_layout = SetLayout::new(gpu, &kinds)?;
        let layout = PipelineLayout::new(gpu, &[set_layout.raw], size_of::<AlphaLevel>() as u32)?;
        let constants = Constants::new();
        Ok(Self {
            pipeline: compute_pipeline(gpu, layout.raw, spirv::ALPHA_MAP, &constants, None)?,
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
            set.write_image(view);
            set.write_buffers(1, &[whole(atlas)]);
        }
        Ok(set)
    }

    /// Records one level, with no barrier after it: each writes words of its own.
    pub fn record(&self, recorder: &Recorder<'_>, set: &OwnSet, level: &AlphaLevel) {
        self.layout.bind(recorder, &[set.raw], level);
        recorder.dispatch_unordered(&self.pipeline, level.words().div_ceil(64));
    }
}

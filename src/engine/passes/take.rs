//! take: a host's image as what superpixels stand in.

use super::own_layout::{OwnSet, PipelineLayout, SetLayout};
use super::spirv::{self, take_set};
use super::{ColorConstants, FrameLayout};
use crate::vulkan::{Compiled, Pipeline, Recorder, Specialized, VulkanError, compute_pipeline};
use ash::vk;

/// Reads colours, and makes the codes that detection compares.
pub(crate) struct Take {
    layout: PipelineLayout,
    set_layout: SetLayout,
}

impl Take {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(frame: &FrameLayout) -> Result<Self, VulkanError> {
        let gpu = &frame.gpu;
        let set_layout = SetLayout::new(gpu, &take_set::ALL)?;
        let sets = [frame.frame_set, set_layout.raw];
        Ok(Self {
            layout: PipelineLayout::new(gpu, &sets, 0)?,
            set_layout,
        })
    }

    /// The pipeline for images that hold linear light or, `encoded`, sRGB codes as plain numbers; `output` are the colour
    /// constants of `shaders/include/color.glsl`.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline(
        &self,
        frame: &FrameLayout,
        encoded: bool,
        output: &ColorConstants,
    ) -> Result<Pipeline, VulkanError> {
        let shader = spirv::Take {
            encoded,
            tonemap: output.tonemap,
            tonemap_codes: output.tonemap_codes,
        };
        let (code, constants) = (spirv::Take::code(), shader.constants());
        let made = compute_pipeline(&frame.gpu, self.layout.raw, code, &constants, None)?;
        Ok(made.of(spirv::Take::INTERFACE))
    }

    /// A set that shows a host's image.
    ///
    /// # Safety
    /// The view outlives the set's use.
    pub unsafe fn set(&self, view: vk::ImageView) -> Result<OwnSet, VulkanError> {
        let set = self.set_layout.allocate()?;
        // SAFETY: the set is new; of the view as the caller says.
        unsafe { set.write_image(take_set::HOST_IMAGE, view) };
        Ok(set)
    }

    /// Records it for an image of so many pixels; afterwards the frame's set is no longer bound.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        pipeline: &Pipeline,
        sets: [vk::DescriptorSet; 2],
        pixels: u32,
    ) {
        // SAFETY: the recorder's contract; the sets are of the pipeline's layout.
        unsafe {
            recorder.device().cmd_bind_descriptor_sets(
                recorder.bindings(),
                vk::PipelineBindPoint::COMPUTE,
                self.layout.raw,
                0,
                &sets,
                &[],
            );
        }
        recorder.dispatch(pipeline, u64::from(pixels.div_ceil(64)));
    }
}

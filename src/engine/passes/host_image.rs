//! The image of colours that a host has drawn, as input of kernels.

use super::spirv::take_set;
use crate::engine::pipelines::FrameLayout;
use crate::engine::pipelines::own_layout::{OwnSet, PipelineLayout, SetLayout};
use crate::vulkan::{Pipeline, Recorder, Specialized, VulkanError, compute_pipeline};
use ash::vk;
use std::sync::Arc;

/// Layouts of kernels that read a host's image in a second descriptor set.
pub(crate) struct HostImageLayout {
    pipeline: PipelineLayout,
    set: SetLayout,
}

/// Descriptor set of a host's image, for the kernels of one frame.
pub(crate) struct HostImage {
    set: OwnSet,
    encoded: bool,
    layout: Arc<HostImageLayout>,
}

impl HostImageLayout {
    /// Makes the layouts.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(frame: &FrameLayout) -> Result<Arc<Self>, VulkanError> {
        let set = SetLayout::new(&frame.gpu, &take_set::ALL)?;
        Ok(Arc::new(Self {
            pipeline: PipelineLayout::beside_frame(frame, &set)?,
            set,
        }))
    }

    /// Makes the set of an image. [`HostImage::show`] sets the image, which holds linear light or, if `encoded`, sRGB
    /// codes as plain numbers.
    ///
    /// # Errors
    /// If the driver refuses the set.
    pub fn image(self: &Arc<Self>, encoded: bool) -> Result<HostImage, VulkanError> {
        Ok(HostImage {
            set: self.set.allocate()?,
            encoded,
            layout: self.clone(),
        })
    }
}

impl HostImage {
    /// Sets the image. It must be in the layout `SHADER_READ_ONLY_OPTIMAL` when kernels read it.
    ///
    /// # Safety
    /// No commands that use the set are pending, and the view outlives the commands that are recorded from now on.
    pub unsafe fn show(&self, view: vk::ImageView) {
        // SAFETY: guaranteed by the caller; the binding is that of an image.
        unsafe { self.set.write_image(take_set::HOST_IMAGE, view) };
    }

    /// Whether the image holds sRGB codes as plain numbers.
    pub fn encoded(&self) -> bool {
        self.encoded
    }

    /// Makes or finds the pipeline of a kernel that reads the image; `subgroup` fixes the size of its subgroups.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn pipeline<S: Specialized>(
        &self,
        frame: &FrameLayout,
        code: &'static [u8],
        shader: &S,
        subgroup: Option<u32>,
    ) -> Result<Arc<Pipeline>, VulkanError> {
        let constants = &shader.constants();
        let layout = self.layout.pipeline.raw;
        let made = || compute_pipeline(&frame.gpu, layout, code, constants, subgroup);
        frame.cached(code, S::INTERFACE, constants, subgroup.unwrap_or(0), made)
    }

    /// Binds the set of the image. The frame's set stays bound.
    pub fn bind(&self, recorder: &Recorder<'_>) {
        // SAFETY: the recorder's contract; the layout of the pipeline equals the frame's layout up to this set.
        unsafe {
            recorder.device().cmd_bind_descriptor_sets(
                recorder.bindings(),
                vk::PipelineBindPoint::COMPUTE,
                self.layout.pipeline.raw,
                1,
                &[self.set.raw],
                &[],
            );
        }
    }
}

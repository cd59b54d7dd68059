//! Colour image of a host as input of kernels.

use super::spirv::take_set;
use crate::engine::pipelines::FrameLayout;
use crate::engine::pipelines::own_layout::{OwnSet, PipelineLayout, SetLayout};
use crate::vulkan::{Pipeline, Recorder, Specialized, VulkanError, compute_pipeline, read_image};
use ash::vk;
use std::sync::Arc;

/// Layouts of kernels that read a host's image in a second descriptor set.
pub(crate) struct HostImageLayout {
    pipeline: PipelineLayout,
    set: SetLayout,
}

/// Descriptor set of a host's image, for the kernels of one frame.
pub(crate) struct HostImage {
    own: OwnSet,
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

    /// Makes the descriptor set of an image, which [`HostImage::show`] sets. The image holds linear light or, if
    /// `encoded`, sRGB codes as plain numbers.
    ///
    /// # Errors
    /// If the driver refuses the set.
    pub fn image(self: &Arc<Self>, encoded: bool) -> Result<HostImage, VulkanError> {
        Ok(HostImage {
            own: self.set.allocate()?,
            encoded,
            layout: self.clone(),
        })
    }
}

impl HostImage {
    /// Sets the image that the descriptor set shows. The image must have the layout `SHADER_READ_ONLY_OPTIMAL` when
    /// kernels read it.
    ///
    /// # Safety
    /// No commands that use the set are pending, and the view outlives the commands that are recorded from now on.
    pub unsafe fn show(&self, view: vk::ImageView) {
        // SAFETY: guaranteed by the caller; the binding is that of an image.
        unsafe {
            self.own
                .set
                .write_images(take_set::HOST_IMAGE, &[read_image(view)]);
        }
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
        let (layout, shader) = (self.layout.pipeline.raw, (code, S::INTERFACE));
        let made = || compute_pipeline(&frame.gpu, layout, shader, constants, subgroup);
        frame.cached(code, constants, subgroup.unwrap_or(0), made)
    }

    /// Binds the set of the image. The frame's set stays bound.
    pub fn bind(&self, recorder: &Recorder<'_>) {
        recorder.bind_sets(self.layout.pipeline.raw, 1, &[&self.own.set]);
    }
}

//! Colour image of a host as input of kernels.

use crate::engine::pipelines::FrameLayout;
use crate::engine::spirv::{self, take_set};
use crate::vulkan::{DescriptorSets, Specialized, VulkanError, read_image};
use ash::vk;
use std::sync::Arc;

/// A host's image, for the kernels of one frame that read it.
pub(crate) struct HostImage {
    /// Sets of `take` and `resolve`, in which the image has the same binding.
    pub sets: Arc<DescriptorSets>,
    encoded: bool,
}

impl HostImage {
    /// Makes the descriptor sets of an image, which [`Self::show`] sets. The image holds linear light or, if `encoded`,
    /// sRGB codes as plain numbers.
    ///
    /// # Errors
    /// If the driver refuses the sets.
    pub fn new(layout: &FrameLayout, encoded: bool) -> Result<Self, VulkanError> {
        let shaders = [spirv::Take::INTERFACE, spirv::Resolve::INTERFACE];
        Ok(Self { sets: Arc::new(layout.own_sets(&shaders, 1)?.remove(0)), encoded })
    }

    /// Sets the image that the descriptor sets show. The image must have the layout `SHADER_READ_ONLY_OPTIMAL` when
    /// kernels read it.
    ///
    /// # Safety
    /// No commands that use the sets are pending, and the view outlives the commands that are recorded from now on.
    pub unsafe fn show(&self, view: vk::ImageView) {
        // SAFETY: guaranteed by the caller; the binding is that of an image.
        unsafe { self.sets.write_images(take_set::HOST_IMAGE, &[read_image(view)]) };
    }

    /// Whether the image holds sRGB codes as plain numbers.
    pub fn encoded(&self) -> bool {
        self.encoded
    }
}

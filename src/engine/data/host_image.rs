//! Colour image of a host as input of kernels.

use crate::engine::pipelines::FrameLayout;
use crate::engine::spirv::{self, take_set};
use crate::vulkan::{DescriptorSets, Image, Memory, Recorder, Specialized, VulkanError, flat_image, read_image};
use ash::vk;
use std::sync::Arc;

/// A host's image, for the kernels of one frame that read it.
pub(crate) struct HostImage {
    /// Sets of `take` and `resolve`, in which the image has the same binding.
    pub sets: Arc<DescriptorSets>,
    encoded: bool,
    /// Image that the host's image is copied into, if kernels can't read that itself.
    copy: Option<Image>,
}

impl HostImage {
    /// Makes the descriptor sets of an image, which [`Self::show`] sets. The image holds linear light or, if `encoded`,
    /// sRGB codes as plain numbers. `copy` is an image [for a copy](Self::for_copy) of it.
    ///
    /// # Errors
    /// If the driver refuses the sets.
    pub fn new(layout: &FrameLayout, encoded: bool, copy: Option<Image>) -> Result<Self, VulkanError> {
        let shaders = [spirv::Take::INTERFACE, spirv::Resolve::INTERFACE];
        Ok(Self { sets: Arc::new(layout.own_sets(&shaders, 1)?.remove(0)), encoded, copy })
    }

    /// Makes an image for a copy of a part of a host's image, `size` pixels large.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn for_copy(memory: &Memory, format: vk::Format, size: [u32; 2]) -> Result<Image, VulkanError> {
        let usage = vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::SAMPLED;
        memory.image("copy of the colours", &flat_image(format, size, usage), vk::ImageAspectFlags::COLOR)
    }

    /// Records the copy of the part of a host's image that begins at `corner` of a layer, if kernels read a copy. The host's
    /// image has the layout `TRANSFER_SRC_OPTIMAL`.
    pub fn record_copy(&self, recorder: &Recorder<'_>, from: vk::Image, corner: [u32; 2], layer: u32) {
        let Some(copy) = &self.copy else {
            return;
        };
        let aspect = vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1);
        let [x, y] = corner.map(u32::cast_signed);
        let vk::Extent2D { width, height } = copy.extent;
        let region = vk::ImageCopy::default()
            .src_subresource(aspect.base_array_layer(layer))
            .src_offset(vk::Offset3D { x, y, z: 0 })
            .dst_subresource(aspect)
            .extent(vk::Extent3D { width, height, depth: 1 });
        let (source, target) = (vk::ImageLayout::TRANSFER_SRC_OPTIMAL, vk::ImageLayout::TRANSFER_DST_OPTIMAL);
        recorder.transition(copy, vk::ImageLayout::UNDEFINED, target);
        // SAFETY: the caller of the recording guarantees the host's image, which holds the part; the copy is as large as that.
        unsafe { recorder.device().cmd_copy_image(recorder.raw(), from, source, copy.raw, target, &[region]) };
        recorder.transition(copy, target, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
    }

    /// Sets the image that the descriptor sets show, unless they show a copy. The image must have the layout
    /// `SHADER_READ_ONLY_OPTIMAL` when kernels read it.
    ///
    /// # Safety
    /// No commands that use the sets are pending, and the view outlives the commands that are recorded from now on.
    pub unsafe fn show(&self, view: vk::ImageView) {
        let view = self.copy.as_ref().map_or(view, |copy| copy.view);
        // SAFETY: guaranteed by the caller; the binding is that of an image.
        unsafe { self.sets.write_images(take_set::HOST_IMAGE, &[read_image(view)]) };
    }

    /// Whether the image holds sRGB codes as plain numbers.
    pub fn encoded(&self) -> bool {
        self.encoded
    }
}

//! States of a host's images, and the barriers between them.

use crate::vulkan::Recorder;
use ash::vk;

/// State of a host's image with one mipmap level and one layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageState {
    /// Layout of the image.
    pub layout: vk::ImageLayout,
    /// Pipeline stages that use the image.
    pub stage: vk::PipelineStageFlags2,
    /// Memory accesses of these stages.
    pub access: vk::AccessFlags2,
}

impl ImageState {
    /// State in which shaders read the image; the caller's barriers wait for everything that was written before.
    pub(crate) const READ: Self = Self {
        layout: vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL,
        stage: vk::PipelineStageFlags2::COMPUTE_SHADER,
        access: vk::AccessFlags2::SHADER_SAMPLED_READ,
    };
    /// State in which the image is copied.
    pub(crate) const COPIED: Self = Self {
        layout: vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
        stage: vk::PipelineStageFlags2::COPY,
        access: vk::AccessFlags2::TRANSFER_READ,
    };
    /// State in which the image is drawn to, over its contents.
    pub(crate) const DRAWN: Self = Self {
        layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
        stage: vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT,
        access: vk::AccessFlags2::from_raw(
            vk::AccessFlags2::COLOR_ATTACHMENT_READ.as_raw() | vk::AccessFlags2::COLOR_ATTACHMENT_WRITE.as_raw(),
        ),
    };

    /// Records the barrier that changes the image from this state to another.
    pub(crate) fn change(
        self,
        recorder: &Recorder<'_>,
        image: vk::Image,
        aspect_mask: vk::ImageAspectFlags,
        layer: u32,
        to: Self,
    ) {
        let range = vk::ImageSubresourceRange {
            aspect_mask,
            base_mip_level: 0,
            level_count: 1,
            base_array_layer: layer,
            layer_count: 1,
        };
        recorder.change_image(
            vk::ImageMemoryBarrier2::default()
                .src_stage_mask(self.stage)
                .src_access_mask(self.access)
                .dst_stage_mask(to.stage)
                .dst_access_mask(to.access)
                .old_layout(self.layout)
                .new_layout(to.layout)
                .image(image)
                .subresource_range(range),
        );
    }
}

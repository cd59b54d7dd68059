//! Where a frame's colours go: a host's image, and its states, or a buffer.

use crate::vulkan::Recorder;
use ash::vk;

/// State of a host's image around the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageState {
    /// Its layout.
    pub layout: vk::ImageLayout,
    /// Stages that use it.
    pub stage: vk::PipelineStageFlags2,
    /// How they use it.
    pub access: vk::AccessFlags2,
}

/// Where a frame's colours go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A host's image, single-sampled, created as a transfer destination, of the encoding and the
    /// [output size](crate::render::Settings::output_size) that the frame was prepared with.
    Image {
        /// The image.
        image: vk::Image,
        /// Its state when the frame begins; what it holds is replaced.
        before: ImageState,
        /// Its state when the frame is done.
        after: ImageState,
    },
    /// A buffer of rows of linear premultiplied RGBA floats, from the top.
    Buffer {
        /// The buffer, a transfer destination of 16 bytes a pixel.
        colors: vk::Buffer,
        /// Where attributes are asked for, a transfer destination of 32 bytes a pixel: see `shaders/attributes.comp`.
        attributes: Option<vk::Buffer>,
    },
}

impl Target {
    /// Readies a host's image for copies.
    pub(super) fn record_begin(&self, recorder: &Recorder<'_>) {
        if let Self::Image { image, before, .. } = self {
            transition(recorder, *image, *before, COPIED_TO);
        }
    }

    /// Hands a host's image back.
    pub(super) fn record_end(&self, recorder: &Recorder<'_>) {
        if let Self::Image { image, after, .. } = self {
            transition(recorder, *image, COPIED_TO, *after);
        }
    }
}

/// The state in which an image is copied to.
pub(super) const COPIED_TO: ImageState = ImageState {
    layout: vk::ImageLayout::TRANSFER_DST_OPTIMAL,
    stage: vk::PipelineStageFlags2::COPY,
    access: vk::AccessFlags2::TRANSFER_WRITE,
};

fn transition(recorder: &Recorder<'_>, image: vk::Image, from: ImageState, to: ImageState) {
    let range = vk::ImageSubresourceRange {
        aspect_mask: vk::ImageAspectFlags::COLOR,
        base_mip_level: 0,
        level_count: 1,
        base_array_layer: 0,
        layer_count: 1,
    };
    let barriers = [vk::ImageMemoryBarrier2::default()
        .src_stage_mask(from.stage)
        .src_access_mask(from.access)
        .dst_stage_mask(to.stage)
        .dst_access_mask(to.access)
        .old_layout(from.layout)
        .new_layout(to.layout)
        .image(image)
        .subresource_range(range)];
    let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
    // SAFETY: the recorder's contract; the host vouches for its image and states.
    unsafe {
        recorder
            .device()
            .cmd_pipeline_barrier2(recorder.raw(), &info)
    };
}

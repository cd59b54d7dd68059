//! Where a frame's colours go: a host's image, and its states, or a buffer.

use crate::render::ImageState;
use crate::vulkan::Recorder;
use ash::vk;

const COLOR: vk::ImageAspectFlags = vk::ImageAspectFlags::COLOR;

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
            before.change(recorder, *image, COLOR, COPIED_TO);
        }
    }

    /// Hands a host's image back.
    pub(super) fn record_end(&self, recorder: &Recorder<'_>) {
        if let Self::Image { image, after, .. } = self {
            COPIED_TO.change(recorder, *image, COLOR, *after);
        }
    }
}

/// The state in which an image is copied to.
pub(super) const COPIED_TO: ImageState = ImageState {
    layout: vk::ImageLayout::TRANSFER_DST_OPTIMAL,
    stage: vk::PipelineStageFlags2::COPY,
    access: vk::AccessFlags2::TRANSFER_WRITE,
};

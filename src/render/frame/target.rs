//! Targets of frames: a host's image with its states, or a buffer.

use crate::render::ImageState;
use crate::vulkan::Recorder;
use ash::vk;

const COLOR: vk::ImageAspectFlags = vk::ImageAspectFlags::COLOR;

/// Destination of a frame's colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Target {
    /// An image of the host: single-sampled, created as a transfer destination, with the encoding and the [output
    /// size](crate::render::Settings::output_size) that the frame was prepared with.
    Image {
        /// Handle of the image.
        image: vk::Image,
        /// State of the image when the frame begins; its contents are overwritten.
        before: ImageState,
        /// State of the image when the frame is done.
        after: ImageState,
    },
    /// A buffer of pixels in the encoding that the frame was prepared with, otherwise of linear premultiplied RGBA floats; rows
    /// from the top.
    Buffer {
        /// Buffer for colours, a transfer destination: 16 bytes a pixel for floats of 32 bits, 8 for those of 16, 4 for codes.
        colors: vk::Buffer,
        /// Buffer for attributes, if these are wanted: a transfer destination of 32 bytes a pixel, laid out as in
        /// `shaders/attributes.comp`.
        attributes: Option<vk::Buffer>,
    },
}

impl Target {
    /// Prepares a host's image for copies.
    pub(super) fn record_begin(&self, recorder: &Recorder<'_>) {
        if let Self::Image { image, before, .. } = self {
            before.change(recorder, *image, COLOR, 0, COPIED_TO);
        }
    }

    /// Puts a host's image into its state after the frame.
    pub(super) fn record_end(&self, recorder: &Recorder<'_>) {
        if let Self::Image { image, after, .. } = self {
            COPIED_TO.change(recorder, *image, COLOR, 0, *after);
        }
    }
}

/// State of an image while it is copied to.
pub(super) const COPIED_TO: ImageState = ImageState {
    layout: vk::ImageLayout::TRANSFER_DST_OPTIMAL,
    stage: vk::PipelineStageFlags2::COPY,
    access: vk::AccessFlags2::TRANSFER_WRITE,
};

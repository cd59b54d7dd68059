//! Copies of a region's colours to the frame's target.

use super::recording::FrameRecording;
use super::target::{COPIED_TO, Target};
use crate::engine::data::Data;
use crate::engine::sampler::plan::Region;
use crate::render::passes::encode::FIRST_PIXEL;
use crate::vulkan::Recorder;
use ash::vk;

/// Buffer with the pixels of a region.
#[derive(Clone, Copy)]
struct Source {
    buffer: vk::Buffer,
    /// Place of the first pixel in bytes.
    first: u64,
    /// Bytes of a pixel.
    bytes: u64,
}

impl Source {
    /// Pixels from the beginning of a buffer on.
    fn floats(buffer: vk::Buffer, bytes: u64) -> Self {
        Self { buffer, first: 0, bytes }
    }
}

impl FrameRecording<'_> {
    /// Copies the wanted pixels of a region to their place in the target.
    pub(super) fn deliver(&self, recorder: &Recorder<'_>, region: &Region) {
        let resources = self.resources;
        let source = match &self.passes.encode {
            Some((encoding, _)) => Source {
                buffer: resources.buffer(Data::Encoded).handle(),
                first: FIRST_PIXEL,
                bytes: encoding.encoded_bytes(),
            },
            None => Source::floats(resources.buffer(Data::Color).handle(), 16),
        };
        match self.target {
            Target::Buffer { colors, attributes } => {
                self.copy_rows(recorder, region, source, *colors);
                if let (Some(to), Some(_)) = (attributes, &self.passes.attributes) {
                    let source = Source::floats(resources.buffer(Data::Attributes).handle(), 32);
                    self.copy_rows(recorder, region, source, *to);
                }
            }
            Target::Image { image, .. } => self.copy_to_image(recorder, region, source, *image),
        }
    }

    /// Place of a region's wanted pixels in the target.
    fn place(&self, region: &Region) -> [u32; 2] {
        let origin = self.settings.region.map_or([0, 0], |wanted| wanted.corner);
        [0, 1].map(|axis| region.wanted_low[axis] - origin[axis])
    }

    /// Copies the wanted pixels of a region to their place in a buffer.
    fn copy_rows(&self, recorder: &Recorder<'_>, region: &Region, from: Source, to: vk::Buffer) {
        let Source { first, bytes, .. } = from;
        let [width, height] = region.size().map(u64::from);
        let [left, top] = self.place(region).map(u64::from);
        let target_row = u64::from(self.settings.output_size()[0]);
        // If the rows are contiguous in both buffers, they are copied as one.
        let (rows, width) =
            if width == row(region) && width == target_row { (1, width * height) } else { (height, width) };
        let rows: Vec<_> = (0..rows)
            .map(|y| {
                vk::BufferCopy::default()
                    .src_offset(first + (first_wanted(region) + y * row(region)) * bytes)
                    .dst_offset(((top + y) * target_row + left) * bytes)
                    .size(width * bytes)
            })
            .collect();
        // SAFETY: guaranteed by the recorder's caller; the rows lie in both buffers, which have room for the region
        // and the image.
        unsafe { recorder.copy_raw(from.buffer, to, &rows) };
    }

    /// Copies the wanted pixels of a region to their place in an image.
    fn copy_to_image(&self, recorder: &Recorder<'_>, region: &Region, from: Source, to: vk::Image) {
        let [width, height] = region.size();
        let [left, top] = self.place(region);
        let copy = [vk::BufferImageCopy::default()
            .buffer_offset(from.first + first_wanted(region) * from.bytes)
            .buffer_row_length(row(region) as u32)
            .image_subresource(vk::ImageSubresourceLayers {
                aspect_mask: vk::ImageAspectFlags::COLOR,
                mip_level: 0,
                base_array_layer: 0,
                layer_count: 1,
            })
            .image_offset(vk::Offset3D { x: left as i32, y: top as i32, z: 0 })
            .image_extent(vk::Extent3D { width, height, depth: 1 })];
        // SAFETY: guaranteed by the recorder's caller; the buffer holds the region, and the host guarantees its image.
        unsafe { recorder.device().cmd_copy_buffer_to_image(recorder.raw(), from.buffer, to, COPIED_TO.layout, &copy) };
    }
}

/// Number of pixels of a region's row in memory.
fn row(region: &Region) -> u64 {
    u64::from(region.outer()[0])
}

/// Index in memory of the first wanted pixel of a region.
fn first_wanted(region: &Region) -> u64 {
    let [x, y] = region.first_wanted().map(u64::from);
    y * row(region) + x
}

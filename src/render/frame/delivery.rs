//! Copies of a region's colours to the frame's target.

use super::recording::Recording;
use super::target::{COPIED_TO, Target};
use crate::engine::sampler::plan::Region;
use crate::vulkan::Recorder;
use ash::vk;

impl Recording<'_> {
    /// Copies the wanted pixels of a region to their place in the target.
    pub(super) fn deliver(&self, recorder: &Recorder<'_>, region: &Region) {
        let resources = self.resources;
        let color = resources.color.buffer.handle();
        match self.target {
            Target::Buffer { colors, attributes } => {
                self.copy_rows(recorder, region, color, *colors, 16);
                if let (Some(to), Some(_)) = (attributes, &self.passes.attributes) {
                    let from = resources.attributes.handle();
                    self.copy_rows(recorder, region, from, *to, 32);
                }
            }
            Target::Image { image, .. } => {
                let (from, bytes) = if self.passes.encode.is_some() {
                    let sizes = &self.plan.sizes;
                    let bytes = sizes.encoded / u64::from(sizes.pixels()).max(1);
                    (resources.encoded.handle(), bytes)
                } else {
                    (color, 16)
                };
                self.copy_to_image(recorder, region, from, *image, bytes);
            }
        }
    }

    /// Place of a region's wanted pixels in the target.
    fn place(&self, region: &Region) -> [u32; 2] {
        let origin = self.settings.region.map_or([0, 0], |wanted| wanted.corner);
        [0, 1].map(|axis| region.wanted_low[axis] - origin[axis])
    }

    /// Copies the wanted pixels of a region to their place in a buffer; a pixel has `bytes` bytes.
    fn copy_rows(
        &self,
        recorder: &Recorder<'_>,
        region: &Region,
        from: vk::Buffer,
        to: vk::Buffer,
        bytes: u64,
    ) {
        let [width, height] = region.size().map(u64::from);
        let [left, top] = self.place(region).map(u64::from);
        let target_row = u64::from(self.settings.output_size()[0]);
        // If the rows are contiguous in both buffers, they are copied as one.
        let (rows, width) = if width == row(region) && width == target_row {
            (1, width * height)
        } else {
            (height, width)
        };
        let rows: Vec<_> = (0..rows)
            .map(|y| {
                vk::BufferCopy::default()
                    .src_offset((first_wanted(region) + y * row(region)) * bytes)
                    .dst_offset(((top + y) * target_row + left) * bytes)
                    .size(width * bytes)
            })
            .collect();
        // SAFETY: guaranteed by the recorder's caller; the rows lie in both buffers, which have room for the region
        // and the image.
        unsafe { recorder.copy_raw(from, to, &rows) };
    }

    /// Copies the wanted pixels of a region to their place in an image; a pixel has `bytes` bytes.
    fn copy_to_image(
        &self,
        recorder: &Recorder<'_>,
        region: &Region,
        from: vk::Buffer,
        to: vk::Image,
        bytes: u64,
    ) {
        let [width, height] = region.size();
        let [left, top] = self.place(region);
        let copy = [vk::BufferImageCopy::default()
            .buffer_offset(first_wanted(region) * bytes)
            .buffer_row_length(row(region) as u32)
            .image_subresource(vk::ImageSubresourceLayers {
                aspect_mask: vk::ImageAspectFlags::COLOR,
                mip_level: 0,
                base_array_layer: 0,
                layer_count: 1,
            })
            .image_offset(vk::Offset3D {
                x: left as i32,
                y: top as i32,
                z: 0,
            })
            .image_extent(vk::Extent3D {
                width,
                height,
                depth: 1,
            })];
        // SAFETY: guaranteed by the recorder's caller; the buffer holds the region, and the host guarantees its image.
        unsafe {
            recorder.device().cmd_copy_buffer_to_image(
                recorder.raw(),
                from,
                to,
                COPIED_TO.layout,
                &copy,
            )
        };
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

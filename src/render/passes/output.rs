//! What the cells of an output show, from the host to where `detect` reads it.

use crate::passes::{IdViews, Resources};
use crate::vulkan::{Buffer, Image, Memory, MemoryUse, Recorder, VulkanError};
use ash::vk;

/// A word a cell, row by row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// IDs of the nearest opaque or MASK triangles.
    Ids,
    /// IDs of the nearest BLEND triangles.
    BlendIds,
    /// Display codes.
    Codes,
    /// A bit for each light that something keeps from the place.
    Shadows,
}

impl Shown {
    const COUNT: usize = 4;
}

/// Some rows of an output, and images of their IDs.
pub struct Output {
    size: [u32; 2],
    /// All words of each [`Shown`], one after the other.
    words: Buffer,
    ids: Image,
    blend_ids: Image,
}

impl Output {
    /// Room for `width` x `height` cells.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn new(memory: &Memory, [width, height]: [u32; 2]) -> Result<Self, VulkanError> {
        let image = |name| {
            let info = vk::ImageCreateInfo::default()
                .image_type(vk::ImageType::TYPE_2D)
                .format(vk::Format::R32_UINT)
                .extent(vk::Extent3D {
                    width,
                    height,
                    depth: 1,
                })
                .mip_levels(1)
                .array_layers(1)
                .samples(vk::SampleCountFlags::TYPE_1)
                .usage(vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST);
            memory.image(name, &info, vk::ImageAspectFlags::COLOR)
        };
        Ok(Self {
            size: [width, height],
            words: memory.buffer(
                "what cells show",
                Self::bytes_of([width, height]) * Shown::COUNT as u64,
                vk::BufferUsageFlags::TRANSFER_SRC,
                MemoryUse::Upload,
            )?,
            ids: image("IDs of cells")?,
            blend_ids: image("BLEND IDs of cells")?,
        })
    }

    /// Bytes that so many cells take.
    #[must_use]
    pub fn bytes([width, height]: [u32; 2]) -> u64 {
        Self::bytes_of([width, height]) * (Shown::COUNT as u64 + 2)
    }

    fn bytes_of([width, height]: [u32; 2]) -> u64 {
        4 * u64::from(width) * u64::from(height)
    }

    /// What passes see of the IDs.
    #[must_use]
    pub fn views(&self) -> IdViews {
        IdViews {
            ids: self.ids.view,
            blend_ids: Some(self.blend_ids.view),
            depth: None,
            placeholder: None,
        }
    }

    /// The words of the first cells, to be written while the device is idle; nothing where the driver did not map the buffer.
    pub fn words_mut(&mut self, shown: Shown) -> &mut [u32] {
        let bytes = Self::bytes_of(self.size) as usize;
        let words = self.words.bytes_mut().chunks_exact_mut(bytes);
        words
            .take(Shown::COUNT)
            .nth(shown as usize)
            .map_or(&mut [], bytemuck::cast_slice_mut)
    }

    /// Records the way of the first `rows` rows to the images, and to the buffers of resources that have room for them.
    pub fn record(&self, recorder: &Recorder<'_>, resources: &Resources, rows: u32) {
        let plane = |shown: Shown| shown as u64 * Self::bytes_of(self.size);
        let bytes = Self::bytes_of([self.size[0], rows]);
        for (image, shown) in [(&self.ids, Shown::Ids), (&self.blend_ids, Shown::BlendIds)] {
            let written = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
            recorder.transition(image, vk::ImageLayout::UNDEFINED, written);
            let copies = [vk::BufferImageCopy::default()
                .buffer_offset(plane(shown))
                .image_subresource(vk::ImageSubresourceLayers {
                    aspect_mask: vk::ImageAspectFlags::COLOR,
                    mip_level: 0,
                    base_array_layer: 0,
                    layer_count: 1,
                })
                .image_extent(vk::Extent3D {
                    width: self.size[0],
                    height: rows,
                    depth: 1,
                })];
            // SAFETY: the recorder's contract; the buffer has the words of as many rows, and the image is as large and in this
            // layout.
            unsafe {
                recorder.device().cmd_copy_buffer_to_image(
                    recorder.raw(),
                    self.words.raw,
                    image.raw,
                    written,
                    &copies,
                );
            }
            recorder.transition(image, written, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
        }
        for (buffer, shown) in [
            (&resources.display.buffer, Shown::Codes),
            (&resources.shadow_words.buffer, Shown::Shadows),
        ] {
            let read = shown == Shown::Codes || resources.sizes().shadow_words > 0;
            if read {
                // SAFETY: both buffers have as many bytes, were made for copies, and go with what executes.
                unsafe {
                    recorder.copy_raw((self.words.raw, plane(shown)), (buffer.raw, 0), bytes);
                }
            }
        }
        recorder.barrier();
    }
}

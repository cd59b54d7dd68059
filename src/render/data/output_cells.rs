//! Contents of an output's cells, uploaded by the host for `detect`.

use crate::engine::data::tiles::tile_count;
use crate::engine::data::{Data, IdViews, Resources};
use crate::vulkan::{Buffer, Image, Memory, MemoryUse, Recorder, VulkanError, flat_image};
use ash::vk;

/// Kind of data about the cells, stored row by row. Each cell has one word, except for marks and colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputPlane {
    /// ID of the nearest opaque or MASK triangle.
    Ids,
    /// ID of the nearest BLEND triangle.
    BlendIds,
    /// Colour as detection compares it: 8-bit sRGB codes and alpha.
    Codes,
    /// A bit for each light that does not reach the place.
    Shadows,
    /// Cells that become superpixels whatever they show: a word for each tile of 8 x 4 cells.
    Marks,
    /// Colours of superpixels: four words for each cell.
    Colors,
}

impl OutputPlane {
    /// Number of words for a cell, over all planes.
    const WORDS: u64 = 9;

    /// Start and length of the plane, in words per cell.
    fn range(self) -> [u64; 2] {
        match self {
            Self::Colors => [5, 4],
            single => [single as u64, 1],
        }
    }
}

/// Contents of the cells of an output, and images of their triangle IDs.
pub struct OutputCells {
    size: [u32; 2],
    /// Words of all planes, each [`OutputPlane`] after the other.
    words: Buffer,
    ids: Image,
    blend_ids: Image,
}

impl OutputCells {
    /// Allocates memory for `size` = [width, height] cells.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn new(memory: &Memory, size: [u32; 2]) -> Result<Self, VulkanError> {
        let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST;
        let info = flat_image(vk::Format::R32_UINT, size, usage);
        let image = |name| memory.image(name, &info, vk::ImageAspectFlags::COLOR);
        Ok(Self {
            size,
            words: memory.buffer(
                "what cells show",
                Self::bytes_of(size) * OutputPlane::WORDS,
                vk::BufferUsageFlags::TRANSFER_SRC,
                MemoryUse::Upload,
            )?,
            ids: image("IDs of cells")?,
            blend_ids: image("BLEND IDs of cells")?,
        })
    }

    /// Number of bytes for `width` x `height` cells.
    #[must_use]
    pub fn bytes([width, height]: [u32; 2]) -> u64 {
        Self::bytes_of([width, height]) * (OutputPlane::WORDS + 2)
    }

    fn bytes_of([width, height]: [u32; 2]) -> u64 {
        4 * u64::from(width) * u64::from(height)
    }

    /// Views of the IDs for passes.
    #[must_use]
    pub fn views(&self) -> IdViews {
        IdViews { ids: self.ids.view, blend_ids: Some(self.blend_ids.view), depth: None, placeholder: None }
    }

    /// Words of a plane, to be written while the device is idle; empty if the driver did not map the buffer.
    pub fn words_mut(&mut self, plane: OutputPlane) -> &mut [u32] {
        let [first, bytes] = plane.range().map(|part| part * Self::bytes_of(self.size));
        let range = first as usize..(first + bytes) as usize;
        let words = self.words.bytes_mut().get_mut(range);
        words.map_or(&mut [], bytemuck::cast_slice_mut)
    }

    /// Records the upload of the first `rows` rows: to the images, and to the buffers of `resources`, which have room
    /// for them.
    pub fn record(&self, recorder: &Recorder<'_>, resources: &Resources, rows: u32) {
        let planes = [(&self.ids, OutputPlane::Ids), (&self.blend_ids, OutputPlane::BlendIds)];
        for (image, plane) in planes {
            let first_byte = plane.range()[0] * Self::bytes_of(self.size);
            recorder.fill_image(image, &self.words, [(first_byte, [self.size[0], rows])]);
        }
        let bytes = Self::bytes_of([self.size[0], rows]);
        self.record_copy(recorder, OutputPlane::Codes, resources.buffer(Data::Display), bytes);
        if resources.sizes().shadow_words > 0 {
            let shadows = resources.buffer(Data::ShadowWords);
            self.record_copy(recorder, OutputPlane::Shadows, shadows, bytes);
        }
        let tiles = tile_count([self.size[0], rows]);
        recorder.clear(resources.buffer(Data::Marks));
        self.record_copy(recorder, OutputPlane::Marks, resources.buffer(Data::Marks), 4 * tiles);
    }

    /// Records the upload of the colours of the first `rows` rows.
    pub fn record_colors(&self, recorder: &Recorder<'_>, resources: &Resources, rows: u32) {
        let bytes = 4 * Self::bytes_of([self.size[0], rows]);
        let colors = resources.buffer(Data::Color);
        self.record_copy(recorder, OutputPlane::Colors, colors, bytes);
    }

    /// Records a copy of the first bytes of a plane to a buffer, which is at least as large.
    fn record_copy(&self, recorder: &Recorder<'_>, plane: OutputPlane, to: &Buffer, bytes: u64) {
        let region = vk::BufferCopy::default().src_offset(plane.range()[0] * Self::bytes_of(self.size)).size(bytes);
        // SAFETY: both buffers have this many bytes, were created for copies, and outlive the execution.
        unsafe { recorder.copy_raw(self.words.raw, to.raw, &[region]) };
    }
}

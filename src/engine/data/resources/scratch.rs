//! Scratch memory: in each recording, passes write it before others read it.

use super::{ResourceSizes, STORAGE};
use crate::engine::data::Argument;
use crate::engine::data::locations::{LocationBuffers, LocationSizes};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Buffer, Memory, MemoryUse, TexelBuffer, VulkanError};
use ash::vk;

/// Buffers with the results that passes read from earlier passes. Frames whose commands run one after the other may
/// share them.
pub struct Scratch {
    sizes: ResourceSizes,
    bin_count: u32,
    pub(crate) display: TexelBuffer,
    pub(crate) color: TexelBuffer,
    /// A word for each tile, a bit for each superpixel.
    pub masks: Buffer,
    pub(crate) marks: Buffer,
    /// Four words for each tile, see `shaders/include/frame.glsl`.
    pub tiles: Buffer,
    /// The work lists, see `shaders/include/work.glsl`.
    pub tile_lists: Buffer,
    pub(super) survivors: Buffer,
    pub(super) corners: Buffer,
    pub(super) indexed_draws: Buffer,
    pub(super) pairs: TexelBuffer,
    pub(super) candidates: TexelBuffer,
    pub(super) headers: Buffer,
    pub(crate) records: TexelBuffer,
    pub(crate) shaded: TexelBuffer,
    pub(crate) shadow_words: TexelBuffer,
    pub(crate) shade_order: Buffer,
    pub(crate) bins: Buffer,
    /// Four words for each [`Argument`].
    pub arguments: Buffer,
    /// Word for conditional rendering: not 0 if another round has work. `None` if the device can't skip commands.
    pub(super) another_round: Option<Buffer>,
    pub(super) filtered: TexelBuffer,
    pub(crate) attributes: Buffer,
    pub(crate) encoded: Buffer,
    /// Buffers of lists of locations.
    pub locations: LocationBuffers,
}

const TEXELS: vk::BufferUsageFlags = vk::BufferUsageFlags::from_raw(
    STORAGE.as_raw()
        | vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER.as_raw()
        | vk::BufferUsageFlags::STORAGE_TEXEL_BUFFER.as_raw(),
);

impl Scratch {
    /// Allocates memory of these sizes, for `bin_count` material bins.
    ///
    /// # Errors
    /// If memory runs out or a buffer exceeds a limit of the device.
    pub(crate) fn new(
        layout: &FrameLayout,
        memory: &Memory,
        bin_count: u32,
        sizes: &ResourceSizes,
    ) -> Result<Self, VulkanError> {
        let pixels = sizes.colors();
        let tiles = u64::from(sizes.tiles());
        let records = u64::from(sizes.record_capacity);
        let location_sizes = sizes.locations.unwrap_or_default();
        let storage_in =
            |name: &str, bytes: u64, location: MemoryUse| memory.storage_buffer(name, bytes, STORAGE, location);
        let storage = |name: &str, bytes: u64| storage_in(name, bytes, MemoryUse::Device);
        let texels_in =
            |name: &str, elements: u64, format, location| memory.texel_buffer(name, elements, format, TEXELS, location);
        let texels = |name: &str, elements: u64, format| texels_in(name, elements, format, MemoryUse::Device);
        // The host reads the colours of its own locations after each run.
        let output = match sizes.locations {
            Some(LocationSizes { lent: false, .. }) => MemoryUse::Readback,
            _ => MemoryUse::Device,
        };
        let float4 = vk::Format::R32G32B32A32_SFLOAT;
        let uint4 = vk::Format::R32G32B32A32_UINT;
        Ok(Self {
            sizes: *sizes,
            bin_count,
            display: texels("display codes", pixels, vk::Format::R32_UINT)?,
            color: texels_in("colour", pixels, float4, output)?,
            masks: storage("superpixel mask", tiles * 4)?,
            marks: storage("marks of pixels", sizes.work_items() * ResourceSizes::MARK_BYTES)?,
            tiles: storage("tiles", sizes.tile_bytes())?,
            tile_lists: storage("tile lists", sizes.work_bytes())?,
            survivors: storage("survivors", u64::from(sizes.survivor_capacity) * 4)?,
            corners: memory.buffer(
                "corners of triangles",
                sizes.corner_bytes(),
                STORAGE | vk::BufferUsageFlags::INDEX_BUFFER,
                MemoryUse::Device,
            )?,
            indexed_draws: memory.buffer(
                "indirect draws",
                sizes.indexed_draw_bytes(),
                STORAGE | vk::BufferUsageFlags::INDIRECT_BUFFER,
                MemoryUse::Device,
            )?,
            pairs: texels("pairs", u64::from(sizes.pair_capacity), vk::Format::R32G32_UINT)?,
            candidates: texels("candidates", u64::from(sizes.list_capacity) * ResourceSizes::CANDIDATE_TEXELS, uint4)?,
            headers: storage("record headers", records * 8)?,
            records: texels("visibility samples", records, uint4)?,
            shaded: texels("shaded records", records, float4)?,
            shadow_words: texels("shadows", sizes.all_shadow_words(), vk::Format::R32_UINT)?,
            shade_order: storage("shading order", records.max(pixels) * 4)?,
            bins: storage("material bins", u64::from(bin_count) * 16)?,
            arguments: memory.buffer(
                "indirect dispatches",
                u64::from(Argument::Shade as u32 + bin_count) * 16,
                STORAGE | vk::BufferUsageFlags::INDIRECT_BUFFER,
                MemoryUse::Device,
            )?,
            another_round: layout
                .gpu
                .limits()
                .conditional_rendering
                .then(|| {
                    let usage = vk::BufferUsageFlags::CONDITIONAL_RENDERING_EXT | vk::BufferUsageFlags::TRANSFER_DST;
                    memory.buffer("another round", 4, usage, MemoryUse::Device)
                })
                .transpose()?,
            filtered: texels("filtered colour", u64::from(sizes.filtered), float4)?,
            attributes: storage_in("attributes", if sizes.attributes { 32 * pixels } else { 0 }, output)?,
            encoded: storage("encoded colour", sizes.encoded)?,
            locations: LocationBuffers::new(memory, &location_sizes, tiles)?,
        })
    }

    /// Whether the memory has room for a frame of pixels with these sizes and `bin_count` material bins. Always false
    /// for lists of locations, which share no memory.
    pub(crate) fn suffices(&self, sizes: &ResourceSizes, bin_count: u32) -> bool {
        self.sizes.suffice(sizes) && self.bin_count >= bin_count
    }
}

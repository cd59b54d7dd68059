//! The memory of one frame: sized when it is prepared, used again for every region and every frame.

mod descriptors;
mod record;
mod sample_set;
mod sizes;

pub use descriptors::{BoundTexels, IdViews};
pub use sample_set::{Offsets, SampleSet};
pub use sizes::ResourceSizes;

use super::locations::{LocationBuffers, LocationSizes};
use super::{Argument, Content, Counter};
use crate::engine::pipelines::FrameLayout;
use crate::engine::pipelines::pool::DescriptorPool;
use crate::vulkan::{Buffer, BufferView, Memory, MemoryUse, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Buffers that passes hand to each other.
pub struct Resources {
    sizes: ResourceSizes,
    pub(crate) display: BufferView,
    pub(crate) color: BufferView,
    /// A word for each [`Counter`].
    pub counters: Buffer,
    /// A word for each tile, a bit for each superpixel.
    pub masks: Buffer,
    pub(crate) marks: Buffer,
    /// Four words for each tile, see `shaders/include/frame.glsl`.
    pub tiles: Buffer,
    /// The work lists, see `shaders/include/work.glsl`.
    pub tile_lists: Buffer,
    survivors: Buffer,
    pairs: BufferView,
    candidates: BufferView,
    headers: Buffer,
    pub(crate) records: BufferView,
    pub(crate) shaded: BufferView,
    pub(crate) shadow_words: BufferView,
    pub(crate) shade_order: Buffer,
    pub(crate) bins: Buffer,
    /// Four words for each [`Argument`].
    pub arguments: Buffer,
    /// A word that says whether there is another round, where the device can skip those that there are not.
    another_round: Option<Buffer>,
    filtered: BufferView,
    pub(crate) attributes: Buffer,
    pub(crate) encoded: Buffer,
    /// What lists of locations need.
    pub locations: LocationBuffers,
    layout: Arc<FrameLayout>,
    _pool: DescriptorPool,
    sets: Vec<SampleSet>,
}

const STORAGE: vk::BufferUsageFlags = vk::BufferUsageFlags::from_raw(
    vk::BufferUsageFlags::STORAGE_BUFFER.as_raw()
        | vk::BufferUsageFlags::TRANSFER_DST.as_raw()
        | vk::BufferUsageFlags::TRANSFER_SRC.as_raw(),
);
const TEXELS: vk::BufferUsageFlags = vk::BufferUsageFlags::from_raw(
    vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER.as_raw()
        | vk::BufferUsageFlags::STORAGE_TEXEL_BUFFER.as_raw()
        | vk::BufferUsageFlags::STORAGE_BUFFER.as_raw()
        | vk::BufferUsageFlags::TRANSFER_DST.as_raw()
        | vk::BufferUsageFlags::TRANSFER_SRC.as_raw(),
);

impl Resources {
    /// Allocates a frame's memory and one descriptor set for each list of offsets of sub-samples. `texels_of_others` are the
    /// texel buffers that others own, as they own the lights.
    ///
    /// # Errors
    /// If memory runs out or a buffer passes the device's limits.
    pub fn new(
        layout: &Arc<FrameLayout>,
        memory: &Memory,
        scene: &dyn Content,
        (texels_of_others, lights): (&[BoundTexels], &Buffer),
        ids: &IdViews,
        sizes: ResourceSizes,
        offset_lists: &[Offsets<'_>],
    ) -> Result<Self, VulkanError> {
        let pixels = sizes.colors();
        let tiles = u64::from(sizes.tiles());
        let records = u64::from(sizes.record_capacity);
        let location_sizes = sizes.locations.unwrap_or_default();
        let storage_in = |name: &str, bytes: u64, location: MemoryUse| {
            memory.storage_buffer(name, bytes, STORAGE, location)
        };
        let storage = |name: &str, bytes: u64| storage_in(name, bytes, MemoryUse::Device);
        let texels_in = |name: &str, elements: u64, format, location| {
            memory.texel_buffer(name, elements, format, TEXELS, location)
        };
        let texels = |name: &str, elements: u64, format| {
            texels_in(name, elements, format, MemoryUse::Device)
        };
        // The host reads what its own locations see, run by run.
        let output = match sizes.locations {
            Some(LocationSizes { lent: false, .. }) => MemoryUse::Readback,
            _ => MemoryUse::Device,
        };
        let float4 = vk::Format::R32G32B32A32_SFLOAT;
        let uint4 = vk::Format::R32G32B32A32_UINT;
        let pool = layout.pool(offset_lists.len() as u32, 0)?;
        let sets = offset_lists
            .iter()
            .map(|offsets| SampleSet::new(layout, memory, &pool, offsets))
            .collect::<Result<Vec<_>, VulkanError>>()?;
        let resources = Self {
            sizes,
            display: texels("display codes", pixels, vk::Format::R32_UINT)?,
            color: texels_in("colour", pixels, float4, output)?,
            counters: storage("counters", Counter::BYTES)?,
            masks: storage("superpixel mask", tiles * 4)?,
            marks: storage(
                "marks of pixels",
                sizes.work_items() * ResourceSizes::MARK_BYTES,
            )?,
            tiles: storage("tiles", sizes.tile_bytes())?,
            tile_lists: storage("tile lists", sizes.work_bytes())?,
            survivors: storage("survivors", u64::from(sizes.survivor_capacity) * 4)?,
            pairs: texels(
                "pairs",
                u64::from(sizes.pair_capacity),
                vk::Format::R32G32_UINT,
            )?,
            candidates: texels(
                "candidates",
                u64::from(sizes.list_capacity) * ResourceSizes::CANDIDATE_TEXELS,
                uint4,
            )?,
            headers: storage("record headers", records * 8)?,
            records: texels("visibility samples", records, uint4)?,
            shaded: texels("shaded records", records, float4)?,
            shadow_words: texels("shadows", sizes.all_shadow_words(), vk::Format::R32_UINT)?,
            shade_order: storage("shading order", records.max(pixels) * 4)?,
            bins: storage("material bins", u64::from(scene.bin_count()) * 16)?,
            arguments: memory.buffer(
                "indirect dispatches",
                u64::from(Argument::Shade as u32 + scene.bin_count()) * 16,
                STORAGE | vk::BufferUsageFlags::INDIRECT_BUFFER,
                MemoryUse::Device,
            )?,
            another_round: layout
                .gpu
                .limits()
                .conditional_rendering
                .then(|| {
                    let usage = vk::BufferUsageFlags::CONDITIONAL_RENDERING_EXT
                        | vk::BufferUsageFlags::TRANSFER_DST;
                    memory.buffer("another round", 4, usage, MemoryUse::Device)
                })
                .transpose()?,
            filtered: texels("filtered colour", u64::from(sizes.filtered), float4)?,
            attributes: storage_in(
                "attributes",
                if sizes.attributes { 32 * pixels } else { 0 },
                output,
            )?,
            encoded: storage("encoded colour", sizes.encoded)?,
            locations: LocationBuffers::new(memory, &location_sizes, tiles)?,
            layout: layout.clone(),
            _pool: pool,
            sets,
        };
        for set in &resources.sets {
            resources.write_set(set, scene, (texels_of_others, lights), ids);
        }
        Ok(resources)
    }

    /// What was asked for.
    #[must_use]
    pub fn sizes(&self) -> &ResourceSizes {
        &self.sizes
    }

    /// The list of offsets of sub-samples at `index`.
    #[must_use]
    pub fn set(&self, index: usize) -> Option<&SampleSet> {
        self.sets.get(index)
    }
}

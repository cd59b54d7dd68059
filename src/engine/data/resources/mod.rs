//! Memory of one frame: allocated when the frame is prepared, and used again for every region and every recording.

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

/// Buffers through which passes exchange data.
pub struct Resources {
    sizes: ResourceSizes,
    pub(crate) display: BufferView,
    pub(crate) color: BufferView,
    /// Counters: a word for each [`Counter`].
    pub counters: Buffer,
    /// Masks: a word for each tile, with a bit for each superpixel.
    pub masks: Buffer,
    pub(crate) marks: Buffer,
    /// Tiles: four words for each, see `shaders/include/frame.glsl`.
    pub tiles: Buffer,
    /// Work lists, see `shaders/include/work.glsl`.
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
    /// Sizes of indirect dispatches: four words for each [`Argument`].
    pub arguments: Buffer,
    /// Word that says whether there is another round; `None` if the device can't skip commands.
    another_round: Option<Buffer>,
    filtered: BufferView,
    pub(crate) attributes: Buffer,
    pub(crate) encoded: Buffer,
    /// Buffers for lists of locations.
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
    /// Allocates a frame's memory, and a descriptor set for each list of sample offsets. `texels_of_others` are the
    /// texel buffers with other owners; the lights have another owner too.
    ///
    /// # Errors
    /// If memory runs out or a buffer exceeds a limit of the device.
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
        // The host reads the results of its own locations, run by run.
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

    /// Sizes of the memory.
    #[must_use]
    pub fn sizes(&self) -> &ResourceSizes {
        &self.sizes
    }

    /// Set of the list of sample offsets with this index.
    #[must_use]
    pub fn set(&self, index: usize) -> Option<&SampleSet> {
        self.sets.get(index)
    }
}

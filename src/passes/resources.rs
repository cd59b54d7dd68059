//! The memory of one frame: sized when it is prepared, used again for every region and every frame.

use super::pool::DescriptorPool;
use super::sites::SiteBuffers;
use super::{Argument, Counter, FrameLayout, FrameUniform, GpuScene, RasterTargets, SiteSizes};
use crate::vulkan::{Buffer, BufferView, Memory, MemoryUse, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// How much room a frame needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResourceSizes {
    /// Largest region, in pixels.
    pub region: [u32; 2],
    /// Sites of a region, where cells are these instead of pixels.
    pub sites: Option<SiteSizes>,
    /// Pairs of a triangle and a tile of all rounds.
    pub pair_capacity: u32,
    /// Candidates of all lists of a round.
    pub list_capacity: u32,
    /// Visibility records of a round; 0 where no cell is ever sampled.
    pub record_capacity: u32,
    /// Pixels of a region after the box filter; 0 without one.
    pub filtered: u32,
    /// Whether attributes are asked for.
    pub attributes: bool,
    /// Bytes of a region encoded for a host's image; 0 without one.
    pub encoded: u64,
}

impl ResourceSizes {
    /// Bytes of a pair.
    pub const PAIR_BYTES: u64 = 16;
    /// Bytes of a candidate.
    pub const CANDIDATE_BYTES: u64 = 64;
    /// Bytes of the work lists for a tile or group of sites: six lists of up to four entries.
    pub const WORK_BYTES: u64 = 96;

    /// Bytes of the largest storage buffer.
    #[must_use]
    pub fn largest_storage(&self) -> u64 {
        let colors = self.colors() * 16;
        let records = u64::from(self.record_capacity) * 16;
        let candidates = u64::from(self.list_capacity) * Self::CANDIDATE_BYTES;
        let attributes = if self.attributes { 2 * colors } else { 0 };
        let pairs = u64::from(self.pair_capacity) * Self::PAIR_BYTES;
        let work = self.work_owners() * Self::WORK_BYTES;
        [attributes, colors, records, candidates, pairs, work]
            .into_iter()
            .fold(0, u64::max)
    }

    /// Pixels of a region.
    #[must_use]
    pub fn pixels(&self) -> u32 {
        self.region[0] * self.region[1]
    }

    /// Colours of a region.
    #[must_use]
    pub fn colors(&self) -> u64 {
        self.sites
            .map_or(u64::from(self.pixels()), |sites| u64::from(sites.sites))
    }

    /// Owners of cells: tiles or, where there are more, groups of sites.
    fn work_owners(&self) -> u64 {
        let groups = self.sites.map_or(0, |sites| sites.groups);
        self.tiles().max(groups).into()
    }

    /// Tiles of 8 x 4 pixels of a region.
    #[must_use]
    pub fn tiles(&self) -> u32 {
        self.region[0].div_ceil(8) * self.region[1].div_ceil(4)
    }

    /// About how many bytes [`Resources`] of this size take, for a scene of `triangles` triangles.
    #[must_use]
    pub fn bytes(&self, triangles: u64) -> u64 {
        let pixels = self.colors();
        let tiles = u64::from(self.tiles());
        let records = u64::from(self.record_capacity);
        pixels * (16 + 4 + 4 + 4)
            + tiles * 20
            + self.work_owners() * (8 + Self::WORK_BYTES)
            + u64::from(self.list_capacity) * Self::CANDIDATE_BYTES
            + u64::from(self.pair_capacity) * Self::PAIR_BYTES
            + records * 40
            + records.max(pixels) * 4
            + triangles * 4
            + u64::from(self.filtered) * 16
            + if self.attributes { pixels * 32 } else { 0 }
            + self.encoded
            + self.sites.map_or(0, |sites| sites.bytes(tiles))
    }
}

/// Sub-sample locations relative to the pixel's centre, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Locations<'a> {
    /// Those of a cell, and then those of a first run of few samples where there is one.
    pub all: &'a [[f32; 2]],
    /// Samples of a cell.
    pub count: u32,
}

/// Sub-sample locations and the descriptor set that reads them.
pub struct SampleSet {
    uniform: Buffer,
    locations: BufferView,
    upload: Option<Buffer>,
    count: u32,
    bytes: u64,
    pub(super) set: vk::DescriptorSet,
}

impl SampleSet {
    /// Number of locations.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.count
    }

    /// The descriptor set.
    pub(crate) fn descriptor(&self) -> vk::DescriptorSet {
        self.set
    }
}

/// Buffers that passes hand to each other.
pub struct Resources {
    sizes: ResourceSizes,
    display: BufferView,
    pub(crate) color: BufferView,
    pub(crate) counters: Buffer,
    pub(crate) masks: Buffer,
    pub(crate) marks: Buffer,
    tiles: Buffer,
    tile_lists: Buffer,
    survivors: Buffer,
    pairs: BufferView,
    candidates: BufferView,
    headers: Buffer,
    records: BufferView,
    shaded: BufferView,
    shade_order: Buffer,
    pub(crate) bins: Buffer,
    pub(crate) arguments: Buffer,
    pub(crate) filtered: BufferView,
    pub(crate) attributes: Buffer,
    pub(crate) encoded: Buffer,
    pub(crate) sites: SiteBuffers,
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
    /// Allocates a frame's memory and one descriptor set for each list of sub-sample locations.
    ///
    /// # Errors
    /// If memory runs out or a buffer passes the device's limits.
    pub fn new(
        layout: &Arc<FrameLayout>,
        memory: &Memory,
        scene: &GpuScene,
        targets: &RasterTargets,
        sizes: ResourceSizes,
        location_lists: &[Locations<'_>],
    ) -> Result<Self, VulkanError> {
        let pixels = sizes.colors();
        let tiles = u64::from(sizes.tiles());
        let records = u64::from(sizes.record_capacity);
        let site_sizes = sizes.sites.unwrap_or_default();
        let triangles = u64::from(scene.triangle_count());
        let storage_in = |name: &str, bytes: u64, location: MemoryUse| {
            let limit = memory.gpu().limits().max_storage_bytes;
            if bytes > limit {
                return Err(VulkanError::TooLarge {
                    what: name.to_owned(),
                    needed: bytes,
                    unit: "bytes",
                    limit,
                });
            }
            memory.buffer(name, bytes, STORAGE, location)
        };
        let storage = |name: &str, bytes: u64| storage_in(name, bytes, MemoryUse::Device);
        let texels_in = |name: &str, elements: u64, format, location| {
            memory.texel_buffer(name, elements, format, TEXELS, location)
        };
        let texels = |name: &str, elements: u64, format| {
            texels_in(name, elements, format, MemoryUse::Device)
        };
        // The host writes the masks of sites and reads what they see, run by run.
        let (input, output) = if sizes.sites.is_some() {
            (MemoryUse::Upload, MemoryUse::Readback)
        } else {
            (MemoryUse::Device, MemoryUse::Device)
        };
        let float4 = vk::Format::R32G32B32A32_SFLOAT;
        let uint4 = vk::Format::R32G32B32A32_UINT;
        let pool = layout.pool(location_lists.len() as u32, 0)?;
        let sets = location_lists
            .iter()
            .map(|Locations { all, count }| {
                let view = texels(
                    "sub-sample locations",
                    all.len() as u64,
                    vk::Format::R32G32_SFLOAT,
                )?;
                let upload = memory.upload("location upload", bytemuck::cast_slice(all))?;
                Ok(SampleSet {
                    uniform: memory.buffer(
                        "frame uniform",
                        size_of::<FrameUniform>().next_multiple_of(16) as u64,
                        vk::BufferUsageFlags::UNIFORM_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
                        MemoryUse::Device,
                    )?,
                    locations: view,
                    upload: Some(upload),
                    count: *count,
                    bytes: size_of_val(*all) as u64,
                    set: pool.allocate(layout.frame_set)?,
                })
            })
            .collect::<Result<Vec<_>, VulkanError>>()?;
        let resources = Self {
            sizes,
            display: texels("display codes", pixels, vk::Format::R32_UINT)?,
            color: texels_in("colour", pixels, float4, output)?,
            counters: storage("counters", Counter::BYTES)?,
            masks: storage_in("superpixel mask", tiles * 4, input)?,
            marks: storage("marks of pixels", sizes.work_owners() * 8)?,
            tiles: storage("tiles", tiles * 16)?,
            tile_lists: storage(
                "tile lists",
                sizes.work_owners() * ResourceSizes::WORK_BYTES,
            )?,
            survivors: storage("survivors", triangles * 4)?,
            pairs: texels("pairs", u64::from(sizes.pair_capacity), uint4)?,
            candidates: texels("candidates", u64::from(sizes.list_capacity) * 4, uint4)?,
            headers: storage("record headers", records * 8)?,
            records: texels("visibility records", records, vk::Format::R32G32B32A32_UINT)?,
            shaded: texels("shaded records", records, float4)?,
            shade_order: storage("shading order", records.max(pixels) * 4)?,
            bins: storage("material bins", u64::from(scene.bin_count()) * 16)?,
            arguments: memory.buffer(
                "indirect dispatches",
                u64::from(Argument::Shade as u32 + scene.bin_count()) * 16,
                STORAGE | vk::BufferUsageFlags::INDIRECT_BUFFER,
                MemoryUse::Device,
            )?,
            filtered: texels("filtered colour", u64::from(sizes.filtered), float4)?,
            attributes: storage_in(
                "attributes",
                if sizes.attributes { 32 * pixels } else { 0 },
                output,
            )?,
            encoded: storage("encoded colour", sizes.encoded)?,
            sites: SiteBuffers::new(memory, &site_sizes, tiles)?,
            layout: layout.clone(),
            _pool: pool,
            sets,
        };
        for set in &resources.sets {
            resources.write(set, scene, targets);
        }
        Ok(resources)
    }

    /// What was asked for.
    #[must_use]
    pub fn sizes(&self) -> &ResourceSizes {
        &self.sizes
    }

    /// The list of sub-sample locations at `index`.
    pub(crate) fn set(&self, index: usize) -> Option<&SampleSet> {
        self.sets.get(index)
    }

    /// Copies the locations to the device, once.
    pub fn record_upload(&self, recorder: &Recorder<'_>) {
        for set in &self.sets {
            if let Some(upload) = &set.upload {
                let region = [vk::BufferCopy::default().size(set.bytes)];
                // SAFETY: the recorder's contract; both buffers hold all locations.
                unsafe {
                    recorder.device().cmd_copy_buffer(
                        recorder.raw(),
                        upload.raw,
                        set.locations.buffer.raw,
                        &region,
                    )
                };
            }
        }
        recorder.barrier();
    }

    /// Begins work on a region: its uniform block, cleared counters and tiles, bound sets.
    pub(crate) fn record_begin(
        &self,
        recorder: &Recorder<'_>,
        set: &SampleSet,
        uniform: &FrameUniform,
    ) {
        recorder.barrier();
        // SAFETY: the recorder's contract; the block is below the 65,536 bytes that an inline update can have.
        unsafe {
            recorder.device().cmd_update_buffer(
                recorder.raw(),
                set.uniform.raw,
                0,
                bytemuck::bytes_of(uniform),
            )
        };
        recorder.clear(&self.counters);
        recorder.clear(&self.tiles);
        recorder.barrier();
        // SAFETY: the recorder's contract; the set matches the layout of all pipelines.
        unsafe {
            recorder.device().cmd_bind_descriptor_sets(
                recorder.raw(),
                vk::PipelineBindPoint::COMPUTE,
                self.layout.pipeline,
                0,
                &[set.set],
                &[],
            );
        }
    }

    /// Sets counters, where the host knows what other frames detect.
    pub(crate) fn record_counters(&self, recorder: &Recorder<'_>, values: &[(Counter, u32)]) {
        for (counter, value) in values {
            // SAFETY: the recorder's contract; the counter lies in the buffer.
            unsafe {
                recorder.device().cmd_fill_buffer(
                    recorder.raw(),
                    self.counters.raw,
                    4 * *counter as u64,
                    4,
                    *value,
                )
            };
        }
        recorder.barrier();
    }

    /// Copies the counters to slot `slot` of a read-back buffer.
    pub(crate) fn record_keep_counters(&self, recorder: &Recorder<'_>, to: &Buffer, slot: u64) {
        let size = Counter::BYTES;
        let region = [vk::BufferCopy::default().dst_offset(slot * size).size(size)];
        // SAFETY: the recorder's contract; callers have sized the buffer for the slot.
        unsafe {
            recorder
                .device()
                .cmd_copy_buffer(recorder.raw(), self.counters.raw, to.raw, &region)
        };
    }

    /// Fills the first `pixels` pixels with the background, premultiplied as in the output, and its display code.
    pub(crate) fn record_background(
        &self,
        recorder: &Recorder<'_>,
        pixels: u32,
        background: [f32; 4],
        code: u32,
    ) {
        /// Pixels written inline; the rest is copied from what is there, twice as much each time.
        const SEED: u64 = 4096;
        let (device, raw) = (recorder.device(), recorder.raw());
        let (color, display) = (self.color.buffer.raw, self.display.buffer.raw);
        let total = u64::from(pixels);
        // SAFETY: the recorder's contract; the seed has the 65,536 bytes that an inline update can have, sizes are
        // multiples of 4, and each copy reads what the copies before it wrote and writes past it.
        unsafe {
            device.cmd_fill_buffer(raw, display, 0, vk::WHOLE_SIZE, code);
            if background == [0.0; 4] {
                device.cmd_fill_buffer(raw, color, 0, vk::WHOLE_SIZE, 0);
            } else {
                let mut filled = SEED.min(total);
                let seed = vec![background; filled as usize];
                device.cmd_update_buffer(raw, color, 0, bytemuck::cast_slice(&seed));
                while filled < total {
                    recorder.barrier();
                    let size = filled.min(total - filled) * 16;
                    let part = [vk::BufferCopy::default().dst_offset(filled * 16).size(size)];
                    device.cmd_copy_buffer(raw, color, color, &part);
                    filled = (2 * filled).min(total);
                }
            }
        }
        recorder.barrier();
    }

    fn write(&self, set: &SampleSet, scene: &GpuScene, targets: &RasterTargets) {
        let texel = |binding: u32, view: &BufferView, storage: bool| (binding, view.view, storage);
        let texel_writes = [
            texel(1, &scene.positions, false),
            texel(2, &scene.triangles, false),
            texel(3, &scene.normals, false),
            texel(4, &scene.tangents, false),
            texel(5, &scene.uvs, false),
            texel(6, &scene.colors, false),
            texel(7, &scene.materials, false),
            texel(9, &scene.alpha_atlas, false),
            texel(10, &scene.clip, false),
            texel(11, &scene.clip, true),
            texel(16, &self.display, false),
            texel(24, &self.candidates, false),
            texel(27, &self.records, false),
            texel(29, &self.shaded, false),
            texel(32, &set.locations, false),
            texel(35, &self.filtered, true),
            texel(38, &self.pairs, false),
            texel(42, &self.sites.sites, false),
            texel(43, &self.sites.cells, false),
            texel(44, &self.sites.groups, false),
        ];
        let views: Vec<[vk::BufferView; 1]> =
            texel_writes.iter().map(|(_, view, _)| [*view]).collect();
        let mut writes: Vec<vk::WriteDescriptorSet<'_>> = texel_writes
            .iter()
            .zip(&views)
            .map(|((binding, _, storage), view)| {
                let kind = if *storage {
                    vk::DescriptorType::STORAGE_TEXEL_BUFFER
                } else {
                    vk::DescriptorType::UNIFORM_TEXEL_BUFFER
                };
                vk::WriteDescriptorSet::default()
                    .dst_set(set.set)
                    .dst_binding(*binding)
                    .descriptor_type(kind)
                    .texel_buffer_view(view)
            })
            .collect();
        let buffer = |buffer: &Buffer| {
            [vk::DescriptorBufferInfo::default()
                .buffer(buffer.raw)
                .range(vk::WHOLE_SIZE)]
        };
        let storage = [
            (8, buffer(&scene.lights)),
            (17, buffer(&self.display.buffer)),
            (18, buffer(&self.color.buffer)),
            (25, buffer(&self.candidates.buffer)),
            (28, buffer(&self.records.buffer)),
            (30, buffer(&self.shaded.buffer)),
            (39, buffer(&self.pairs.buffer)),
            (19, buffer(&self.counters)),
            (20, buffer(&self.masks)),
            (21, buffer(&self.tiles)),
            (22, buffer(&self.tile_lists)),
            (23, buffer(&self.survivors)),
            (26, buffer(&self.headers)),
            (31, buffer(&self.shade_order)),
            (33, buffer(&self.bins)),
            (34, buffer(&self.arguments)),
            (36, buffer(&self.attributes)),
            (37, buffer(&self.encoded)),
            (41, buffer(&self.marks)),
            (45, buffer(&self.sites.loads)),
        ];
        for (binding, info) in &storage {
            writes.push(
                vk::WriteDescriptorSet::default()
                    .dst_set(set.set)
                    .dst_binding(*binding)
                    .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                    .buffer_info(info),
            );
        }
        let uniform = buffer(&set.uniform);
        writes.push(
            vk::WriteDescriptorSet::default()
                .dst_set(set.set)
                .dst_binding(0)
                .descriptor_type(vk::DescriptorType::UNIFORM_BUFFER)
                .buffer_info(&uniform),
        );
        // A set shows either single-sampled or multisampled IDs; pipelines that could read the former but are
        // specialised not to see a placeholder. Without BLEND its binding shows the opaque IDs, which is not read either.
        let image = |view| {
            [vk::DescriptorImageInfo::default()
                .image_view(view)
                .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)]
        };
        let blend_view = targets.blend_ids.as_ref().unwrap_or(&targets.ids).view;
        let first = if targets.multisampled() { 14 } else { 12 };
        let images = [
            (first, image(targets.ids.view)),
            (first + 1, image(blend_view)),
        ];
        let stand_in = targets.placeholder.as_ref().map(|p| image(p.view));
        if let Some(info) = &stand_in {
            for binding in [12, 13] {
                writes.push(
                    vk::WriteDescriptorSet::default()
                        .dst_set(set.set)
                        .dst_binding(binding)
                        .descriptor_type(vk::DescriptorType::SAMPLED_IMAGE)
                        .image_info(info),
                );
            }
        }
        let depth = image(targets.depth.view);
        if !targets.multisampled() {
            writes.push(
                vk::WriteDescriptorSet::default()
                    .dst_set(set.set)
                    .dst_binding(40)
                    .descriptor_type(vk::DescriptorType::SAMPLED_IMAGE)
                    .image_info(&depth),
            );
        }
        for (binding, info) in &images {
            writes.push(
                vk::WriteDescriptorSet::default()
                    .dst_set(set.set)
                    .dst_binding(*binding)
                    .descriptor_type(vk::DescriptorType::SAMPLED_IMAGE)
                    .image_info(info),
            );
        }
        // SAFETY: the set was just allocated and no frame uses it; every handle is alive and outlives the set.
        unsafe { self.layout.gpu.device.update_descriptor_sets(&writes, &[]) };
    }
}

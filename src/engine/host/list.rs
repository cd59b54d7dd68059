//! Lists of sample locations that a host lends. They are sampled instead of an image's pixels.

use super::draw::PlacedDraws;
use super::growth::Growth;
use super::lending::Lending;
use super::sampling::Sampling;
use super::shading::ShadeSamples;
use super::uniform::{check_size, plane_block, scene_block};
use super::viewport::ClipPlane;
use super::{Draw, Geometry, HostError, IndirectCounts, ListOptions, Member, Outcome, Shared};
use crate::engine::data::{Cells, FrameUniform, Offsets, ResourceRequest, ShownIds, VisibilityUniform};
use crate::engine::sampler::Capacity;
use crate::engine::sampler::footprint::{Footprints, TextureFilter};
use crate::engine::sampler::uniform::{PlaneBlock, frame_uniform};
use crate::engine::sampler::{Job, JobRecording, ListCells, SamplerRun, Statistics, check_image_size};
use crate::engine::spirv::frame_set;
use crate::vulkan::{DescriptorSets, Memory, TexelView};
use ash::vk;
use std::sync::Arc;

/// Buffers of a host for a list: sample locations, and the resulting colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LocationList {
    /// Buffer of [`Location`]s, created with `STORAGE_BUFFER` and `UNIFORM_TEXEL_BUFFER`. Its contents may change with
    /// every recording.
    pub locations: vk::Buffer,
    /// Offset of the first location in bytes: a multiple of 256, or of the device's offset alignment for buffer
    /// descriptors.
    pub offset: u64,
    /// Largest number of locations of a recording.
    pub capacity: u32,
    /// Buffer for the colours of the locations, created with `TRANSFER_DST`. Each location, in the order of the list,
    /// gets four floats: linear light, premultiplied by opacity, and opacity.
    pub colors: vk::Buffer,
    /// Offset of the first location's colour in bytes: a multiple of 4.
    pub colors_offset: u64,
}

/// Sample location on the image plane: 32 bytes, an element of a [`LocationList`].
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Location {
    /// Column and row of the pixel that contains the location, from the upper left corner of the image of size
    /// [`ListOptions::size`].
    pub pixel: [i32; 2],
    /// Position in that pixel: x to the right and y down, from 0 to 1.
    pub within: [f32; 2],
    /// Jacobian of the location's mapping, in pixels: the changes of x and y to the next column, and those to the next
    /// row, of the host's output. Sub-samples and texture filters cover this parallelogram.
    pub jacobian: [[f32; 2]; 2],
}

/// Result of the last recording of a [`List`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ListOutcome {
    /// Statistics of the recording.
    pub statistics: Statistics,
    /// Number of cells and tiles for which memory or [`ListOptions::max_rounds`] did not suffice; these show the
    /// background. The list's next recording has more memory, unless [`ListOptions::fixed_memory`] is set.
    pub left_over: u64,
    /// Counts of [`IndirectDraws`](super::IndirectDraws).
    pub indirect: IndirectCounts,
    /// Number of locations that lie outside of the image or are not finite; these show the background.
    pub left_out: u32,
}

/// Pipelines and memory to sample a host's locations, for one of its frames in flight.
pub struct List {
    lending: Lending,
    work: Work,
    list: LocationList,
    options: ListOptions,
    growth: Growth,
    /// Number of triangles of the last recording.
    triangles: u32,
    /// Dropped last, because layouts must outlive the objects that were made with them.
    shared: Arc<Shared>,
}

/// Objects of a list that depend on its capacity.
struct Work {
    sampling: Sampling,
    visibility_set: DescriptorSets,
    _locations: TexelView,
}

impl LocationList {
    const LOCATION_BYTES: u64 = size_of::<Location>() as u64;
    const COLOR_BYTES: u64 = 16;

    fn check(&self, alignment: u64, most: u32) -> Result<(), HostError> {
        if self.locations == vk::Buffer::null() {
            return Err(HostError::Null(Member::Locations));
        }
        if self.colors == vk::Buffer::null() {
            return Err(HostError::Null(Member::Colors));
        }
        HostError::check_count(Member::LocationCapacity, self.capacity, most)?;
        HostError::check_offset(Member::LocationsOffset, self.offset, alignment)?;
        HostError::check_offset(Member::ColorsOffset, self.colors_offset, 4)
    }

    fn bytes(&self) -> u64 {
        u64::from(self.capacity) * Self::LOCATION_BYTES
    }

    fn info(&self) -> vk::DescriptorBufferInfo {
        vk::DescriptorBufferInfo::default().buffer(self.locations).offset(self.offset).range(self.bytes())
    }
}

impl Work {
    /// # Safety
    /// The buffers of the list are as [`LocationList`] says, and outlive the returned value.
    unsafe fn new(
        shared: &Shared,
        lending: &Lending,
        list: &LocationList,
        options: &ListOptions,
        capacity: Capacity,
    ) -> Result<Self, HostError> {
        let (gpu, layout) = (&shared.gpu, &shared.frame);
        let settings = options.sampler();
        let allowed = options.max_memory;
        let allowed = allowed.map(|most| most.saturating_sub(lending.bytes()));
        let memory = Memory::new(gpu.clone(), allowed);
        let content = &lending.content;
        let cells = ListCells {
            cells: if options.samples == 1 { Cells::Points } else { Cells::Superpixels },
            attributes: false,
            shadow_words: 0,
            lent: true,
            spread: None,
        };
        let region = padded(options.size);
        let sizes = cells.sizes(layout, content, &settings.cells, list.capacity, region, capacity);
        sizes.check(gpu.limits())?;
        let (offsets, count) = cells.offsets(layout, &settings.cells)?;
        let uint4 = vk::Format::R32G32B32A32_UINT;
        // SAFETY: passed on to the caller.
        let locations = unsafe { TexelView::new(gpu, list.locations, uint4, list.offset, list.bytes()) }?;
        let mut shown = content.shown();
        shown.push((frame_set::LOCATIONS, locations.texels().into()));
        let request = ResourceRequest {
            sizes,
            others: &shown,
            ids: ShownIds::Unread,
            offsets: &[Offsets { all: &offsets, count }],
            scratch: None,
        };
        let job = Job::new(layout, memory, &settings, capacity, &request)?;
        // SAFETY: the caller guarantees the list's buffers; the others live as long as this value.
        let (mut sampler, visibility_set) = unsafe {
            (
                cells.sampler(&job.context(content, 1), job.resources(), locations.texels().into())?,
                lending.visibility_set(shared, job.resources(), Some(list.info()))?,
            )
        };
        if let Some(most) = options.max_rounds {
            sampler.limit_rounds(most);
        }
        Ok(Self { sampling: Sampling { job, sampler }, visibility_set, _locations: locations })
    }
}

impl List {
    /// # Safety
    /// As [`super::Antialiaser::prepare_list`].
    pub(super) unsafe fn new(
        shared: &Arc<Shared>,
        geometry: &Geometry,
        list: &LocationList,
        options: &ListOptions,
        capacity: Capacity,
    ) -> Result<Self, HostError> {
        let gpu = &shared.gpu;
        let limits = gpu.limits();
        options.sampler().check()?;
        check_image_size(options.size)?;
        geometry.check(gpu)?;
        check_size(options.size)?;
        let texels = limits.max_texel_elements / 2;
        let most = texels.min(limits.max_storage_bytes / LocationList::LOCATION_BYTES);
        list.check(limits.buffer_alignment.max(16), most.min(1 << 30) as u32)?;
        let memory = Memory::new(gpu.clone(), options.max_memory);
        // SAFETY: passed on to the caller.
        let (lending, work) = unsafe {
            let lending = Lending::new(shared, memory, geometry)?;
            let work = Work::new(shared, &lending, list, options, capacity)?;
            (lending, work)
        };
        Ok(Self {
            lending,
            work,
            list: *list,
            options: options.clone(),
            growth: Growth::default(),
            triangles: 0,
            shared: shared.clone(),
        })
    }

    /// Options with which the list was prepared.
    #[must_use]
    pub fn options(&self) -> &ListOptions {
        &self.options
    }

    /// Number of bytes of device memory in use, without the host's buffers.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        self.lending.bytes() + self.work.sampling.job.memory().used()
    }

    /// Makes a list for the same buffers, with more of the memory that the last recording lacked. If it lacked none,
    /// the new list has as much memory as this one. [`ListOptions::max_rounds`] stays the same. With
    /// [`ListOptions::fixed_memory`], this is the way to more memory; otherwise [`Self::record`] takes care of it.
    ///
    /// # Errors
    /// If memory runs out, or in the cases of [`Self::outcome`] if the last recording is not done.
    ///
    /// # Safety
    /// As [`super::Antialiaser::prepare_list`].
    pub unsafe fn grow(&self) -> Result<Self, HostError> {
        let capacity = self.work.sampling.next_capacity()?;
        // SAFETY: passed on to the caller.
        unsafe { Self::new(&self.shared, &self.lending.geometry, &self.list, &self.options, capacity) }
    }

    /// Gives the list more of the memory that the last recording lacked, if its commands are done and the host allows it.
    ///
    /// # Safety
    /// The buffers of the list outlive this value.
    unsafe fn make_room(&mut self) -> Result<(), HostError> {
        if self.options.fixed_memory {
            return Ok(());
        }
        // SAFETY: passed on to the caller.
        let make = |capacity| unsafe { Work::new(&self.shared, &self.lending, &self.list, &self.options, capacity) };
        if let Some(larger) = self.growth.larger(&self.work.sampling, make)? {
            self.lending.note(&self.work.sampling.job);
            self.work = larger;
        }
        Ok(())
    }

    /// Records the sampling of the first `count` locations. `shading` is called once for each round. The call neither
    /// submits nor waits.
    ///
    /// It allocates no device memory and updates no descriptor, with one exception: if the last recording left work
    /// [over](ListOutcome::left_over) for want of memory, the list first gets more of it. If the device has no more, the
    /// list keeps what it has. [`ListOptions::fixed_memory`] forbids this.
    ///
    /// # Errors
    /// If the draws or locations exceed a capacity, or a draw is invalid; if the device is lost while the list gets more
    /// memory. Nothing is recorded then.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass and of conditional rendering, for the antialiaser's
    ///   device and a queue family with compute. The caller must bind and push its state again afterwards.
    /// - The commands of this list's last recording are done, or will never be executed, because its memory is used
    ///   again.
    /// - If the commands are submitted again, results are read only when that submission is done: until the device begins
    ///   it, it is taken for done.
    /// - Alpha maps are in `SHADER_READ_ONLY_OPTIMAL` in all recordings up to the first one that is executed. Earlier
    ///   writes to them were made on the same queue or made visible to it.
    /// - The device's earlier writes to the lent buffers were recorded into the same queue or made visible to it;
    ///   earlier writes to the buffer of colours are done. The results are visible to all later commands on the queue.
    /// - The list, the buffers and the objects that `shading` records outlive the execution of the commands.
    /// - The commands that `shading` records are valid, and write no memory of the list except by `gpc_store`.
    pub unsafe fn record(
        &mut self,
        commands: vk::CommandBuffer,
        draws: &[Draw],
        count: u32,
        shading: &dyn ShadeSamples,
    ) -> Result<(), HostError> {
        let placed = PlacedDraws::new(&self.lending.geometry, draws)?;
        if count > self.list.capacity {
            return Err(HostError::Capacity {
                counted: "locations",
                found: u64::from(count),
                member: Member::LocationCapacity,
                capacity: self.list.capacity,
            });
        }
        // SAFETY: passed on to the caller.
        unsafe { self.make_room() }?;
        let uniform = self.uniform(&placed);
        let plane = self.plane();
        let footprints = self.footprints();
        self.triangles = placed.drawn_triangles;
        self.lending.note(&self.work.sampling.job);
        let (work, lending) = (&mut self.work, &self.lending);
        let Sampling { job, sampler } = &mut work.sampling;
        // SAFETY: passed on to the caller.
        let recording = unsafe { job.begin(commands, |_| ()) };
        let JobRecording { recorder, resources, settings, .. } = &recording;
        let Some(set) = resources.set(0) else {
            return Ok(());
        };
        recorder.begin();
        lending.record_alpha(recorder);
        lending.record_triangles(recorder, &placed);
        let boxes = settings.filter == TextureFilter::Boxes;
        let visible = VisibilityUniform { list: 1, ..Lending::visible(&plane, footprints.place, boxes) };
        lending.record_visible(recorder, &visible);
        if count > 0 {
            resources.record_background(recorder, count, uniform.background, 0);
        }
        resources.record_begin(recorder, set, &uniform);
        let shading = lending.shading(shading, &work.visibility_set, resources);
        let run = SamplerRun { resources, set, uniform: &uniform, locations: count, index: 0 };
        sampler.record(recorder, &run, &shading);
        let bytes = LocationList::COLOR_BYTES * u64::from(count);
        // SAFETY: the host guarantees that the buffer has room for the colours of `capacity` locations.
        unsafe { resources.record_keep_colors(recorder, self.list.colors, self.list.colors_offset, bytes) };
        recording.end();
        Ok(())
    }

    /// Result of the last recording, available once its commands are done, until the next recording begins. This does
    /// not wait.
    ///
    /// # Errors
    /// [`VulkanError::NotDone`](crate::vulkan::VulkanError::NotDone) if the last recording was not submitted or still
    /// runs, [`VulkanError::NotRecorded`](crate::vulkan::VulkanError::NotRecorded) if there was none; also if counters
    /// or timestamps can't be read.
    pub fn outcome(&self) -> Result<ListOutcome, HostError> {
        let sampling = &self.work.sampling;
        let Outcome { statistics, left_over, indirect } =
            sampling.outcome(self.triangles, &self.lending, self.lending.bytes())?;
        Ok(ListOutcome { statistics, left_over, indirect, left_out: sampling.sampler.left_out()? })
    }

    fn footprints(&self) -> Footprints {
        let settings = self.work.sampling.job.settings();
        Footprints::new(settings.filter, settings.cells.samples)
    }

    fn plane(&self) -> ClipPlane {
        ClipPlane::of_size(&self.lending.geometry.clip, self.options.size)
    }

    fn uniform(&self, placed: &PlacedDraws) -> FrameUniform {
        let (job, geometry) = (&self.work.sampling.job, &self.lending.geometry);
        let (settings, sizes) = (job.settings(), job.resources().sizes());
        let plane = PlaneBlock {
            // Locations may lie anywhere in the tiles at the border, also outside of the image.
            size: sizes.region,
            ..plane_block(&geometry.clip, &self.plane(), self.options.size)
        };
        let samples = self.work.sampling.sampler.samples();
        frame_uniform(&scene_block(geometry, placed), &plane, settings, samples, &self.footprints(), sizes)
    }
}

/// Rounds a size up to whole tiles.
fn padded([width, height]: [u32; 2]) -> [u32; 2] {
    [width.next_multiple_of(8), height.next_multiple_of(4)]
}

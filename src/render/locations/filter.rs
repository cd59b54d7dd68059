//! Pixel filters of images that are made of locations: the pass that filters frames averages the cells of the output, in
//! bands of rows that the host uploads and reads back.

use super::image::OutputImage;
use super::sampler::CellSpread;
use crate::engine::data::tiles::{mask_bit, tile_count};
use crate::engine::data::{Data, Offsets, ResourceRequest, ResourceSizes, ShownIds};
use crate::engine::passes::pixel_filter::{self, Alpha, Superpixels};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::sampler::footprint::Footprints;
use crate::engine::sampler::uniform::{PlaneBlock, SceneBlock, frame_uniform};
use crate::engine::sampler::{Capacity, Job, JobRecording};
use crate::render::{Headless, PreparedScene, RenderError, Settings, Statistics};
use crate::vulkan::{Buffer, Limits, Memory, MemoryUse};
use ash::vk;
use std::ops::Range;
use std::sync::Arc;

/// Largest number of cells of a band, including the rows around it that the filter reaches.
const MOST_CELLS: u64 = 1 << 18;
/// Number of bytes of a cell's colour.
const COLOR: usize = size_of::<[f32; 4]>();
/// Number of bytes of a cell's spread, as `resolve` stores it.
const SPREAD: usize = size_of::<CellSpread>();

/// Pipeline and memory for filtering bands of an output.
struct CellFilter {
    width: u32,
    settings: Settings,
    filter: Pass,
    /// Colours of a band's cells, their spreads, and masks of its superpixels.
    cells: Buffer,
    filtered: Buffer,
    job: Job,
}

impl Headless {
    /// Filters the colours of an image by the settings' pixel filter.
    pub(super) fn filter_cells(
        &mut self,
        scene: &PreparedScene,
        settings: &Settings,
        image: &mut OutputImage,
    ) -> Result<Statistics, RenderError> {
        let layout = self.renderer.layout.clone();
        let taken = scene.memory_bytes();
        let mut filter = CellFilter::new(&layout, settings, taken)?;
        let ([width, height], reach) = (settings.size, settings.pixel_filter.reach());
        let rows = filter.job.resources().sizes().region[1] - 2 * reach;
        let mut filtered = Vec::with_capacity(image.len());
        let mut statistics = Statistics::default();
        for first in (0..height).step_by(rows as usize) {
            let end = height.min(first + rows);
            let seen = first.saturating_sub(reach)..height.min(end + reach);
            filter.show(&seen, image);
            // SAFETY: the previous submission has run; the filter outlives this one, which is waited for.
            self.submit(|commands| unsafe { filter.record(seen.len() as u32, commands) })?;
            let cells: &[[f32; 4]] = filter.filtered.read(seen.len() * width as usize)?;
            let own = (first - seen.start) * width..(end - seen.start) * width;
            filtered.extend_from_slice(&cells[own.start as usize..own.end as usize]);
            statistics.append(filter.job.statistics(None, &[], 0, taken)?);
        }
        image.colors = filtered;
        Ok(statistics)
    }
}

impl CellFilter {
    /// Makes the pipeline, and memory for the bands. `taken` is the memory of the scene in bytes.
    fn new(layout: &Arc<FrameLayout>, settings: &Settings, taken: u64) -> Result<Self, RenderError> {
        let left = settings.scene.max_memory.map(|limit| limit.saturating_sub(taken));
        let sizes = band_sizes(layout.gpu.limits(), settings, left);
        sizes.check(layout.gpu.limits())?;
        let memory = Memory::new(layout.gpu.clone(), left);
        let cells = u64::from(sizes.pixels());
        let upload = cells * (COLOR + SPREAD) as u64 + 4 * u64::from(sizes.tiles());
        let (from, to) = (vk::BufferUsageFlags::TRANSFER_SRC, vk::BufferUsageFlags::TRANSFER_DST);
        let (upload, filtered) = (
            memory.buffer("cells before a filter", upload, from, MemoryUse::Upload)?,
            memory.buffer("cells after a filter", cells * COLOR as u64, to, MemoryUse::Readback)?,
        );
        let request = ResourceRequest {
            sizes,
            others: &[],
            ids: ShownIds::Unread,
            offsets: &[Offsets { all: &[[0.0; 2]], count: 1 }],
            scratch: None,
        };
        Ok(Self {
            width: settings.size[0],
            settings: settings.clone(),
            filter: pixel_filter::pass(
                layout,
                &settings.pixel_filter,
                false,
                Superpixels::Detected,
                Alpha::Premultiplied,
            )?,
            cells: upload,
            filtered,
            job: Job::new(layout, memory, &settings.sampler(), Capacity::default(), &request)?,
        })
    }

    /// Starts of the spreads and of the masks in the buffer of cells, in bytes.
    fn starts(&self) -> [usize; 2] {
        let cells = self.job.resources().sizes().pixels() as usize;
        [cells * COLOR, cells * (COLOR + SPREAD)]
    }

    /// Writes the cells of the rows `seen`. The device must be idle.
    fn show(&mut self, seen: &Range<u32>, image: &OutputImage) {
        let width = self.width as usize;
        let range = seen.start as usize * width..seen.end as usize * width;
        let [spreads, masks] = self.starts();
        let (colors, rest) = self.cells.bytes_mut().split_at_mut(spreads);
        let (spreads, masks) = rest.split_at_mut(masks - spreads);
        copy(colors, &image.colors[range.clone()]);
        copy(spreads, &image.spreads[range.clone()]);
        let masks: &mut [u32] = bytemuck::cast_slice_mut(masks);
        masks.fill(0);
        for (index, attributes) in (0_u32..).zip(&image.attributes[range]) {
            let (tile, bit) = mask_bit([index % self.width, index / self.width], self.width);
            masks[tile] |= if attributes.superpixel == 1 { bit } else { 0 };
        }
    }

    /// Records filtering of the cells of `rows` rows, and the copy of their colours to host memory.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass, for the device and queue family of the renderer.
    /// - The commands of the last recording have run: its memory is used again.
    unsafe fn record(&mut self, rows: u32, commands: vk::CommandBuffer) {
        let size = [self.width, rows];
        let count = size[0] * size[1];
        let [spreads, masks] = self.starts().map(|start| start as u64);
        let Self { settings, filter, cells, filtered, job, .. } = self;
        // SAFETY: guaranteed by the caller.
        let recording = unsafe { job.begin(commands, |_| ()) };
        let JobRecording { recorder, resources, settings: of_sampler, .. } = &recording;
        let Some(set) = resources.set(0) else {
            return;
        };
        let plane = PlaneBlock { size, ..PlaneBlock::default() };
        let footprints = Footprints::new(settings.filter(), 1);
        let uniform = frame_uniform(&SceneBlock::default(), &plane, of_sampler, 1, &footprints, resources.sizes());
        recorder.begin();
        resources.record_begin(recorder, set, &uniform);
        for (start, bytes, to) in [
            (0, u64::from(count) * COLOR as u64, Data::Color),
            (spreads, u64::from(count) * SPREAD as u64, Data::Spreads),
            (masks, 4 * tile_count(size), Data::Masks),
        ] {
            let region = vk::BufferCopy::default().src_offset(start).size(bytes);
            // SAFETY: both buffers have room for the cells of these rows, were created for copies, and outlive the execution.
            unsafe { recorder.copy_raw(cells.raw, resources.buffer(to).raw, &[region]) };
        }
        filter.record_for(recorder, pixel_filter::columns(tile_count(size) as u32));
        recorder.copy(resources.buffer(Data::Filtered), u64::from(count) * COLOR as u64, filtered, 0);
        recording.end();
    }
}

/// Copies values to the first bytes of `to`, which has room for them.
fn copy<T: bytemuck::NoUninit>(to: &mut [u8], values: &[T]) {
    let bytes: &[u8] = bytemuck::cast_slice(values);
    to[..bytes.len()].copy_from_slice(bytes);
}

/// Sizes for a band with as many rows as the device allows and as fit into a quarter of `left`, the free memory in bytes, and
/// the rows around it.
fn band_sizes(limits: &Limits, settings: &Settings, left: Option<u64>) -> ResourceSizes {
    let [width, height] = settings.size;
    let halo = 2 * settings.pixel_filter.reach();
    let sizes_of = |rows: u32| {
        let pixels = width * (rows + halo);
        ResourceSizes { filtered: pixels, spreads: true, ..ResourceSizes::new([width, rows + halo], 0, limits) }
    };
    let fits = |sizes: &ResourceSizes| {
        let bytes = sizes.bytes() + u64::from(sizes.pixels()) * (2 * COLOR + SPREAD) as u64;
        u64::from(sizes.pixels()) <= MOST_CELLS
            && sizes.check(limits).is_ok()
            && left.is_none_or(|left| 4 * bytes <= left)
    };
    let mut rows = height;
    while rows > 1 && !fits(&sizes_of(rows)) {
        rows = rows.div_ceil(2);
    }
    sizes_of(rows)
}

//! One of a host's frames in flight.

use super::base::Base;
use super::draw::PlacedDraws;
use super::growth::Growth;
use super::lending::Lending;
use super::sampling::Sampling;
use super::scratch::{FrameScratch, ScratchRequest};
use super::shading::ShadeSamples;
use super::uniform::{check_size, plane_block, scene_block};
use super::viewport::{ClipPlane, Viewport};
use super::{Draw, Geometry, HostError, ImageKinds, Images, IndirectCounts, LentImage, Member, Options, Shared};
use crate::engine::data::{Data, FrameUniform, HostImage, IdViews, Offsets, ResourceRequest, ShownIds};
use crate::engine::passes::pixel_filter::{self, Alpha, Superpixels};
use crate::engine::passes::{Patch, Patched, RasterTargets};
use crate::engine::pipelines::Pass;
use crate::engine::sampler::Capacity;
use crate::engine::sampler::footprint::{Footprints, TextureFilter};
use crate::engine::sampler::plan::Plan;
use crate::engine::sampler::uniform::{PlaneBlock, frame_uniform};
use crate::engine::sampler::{Job, JobRecording, PixelCells, SamplerRun, Statistics};
use crate::vulkan::{DescriptorSets, Memory};
use ash::vk;
use std::sync::Arc;

/// Draws, projection and viewport of a recording.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Scenery<'a> {
    /// Runs of triangles. IDs count from 1 in their order.
    pub draws: &'a [Draw],
    /// The projection that positions in clip space were made with, in columns: from view space, in which distances are the world's, to
    /// clip space. It tells how far apart two depths are.
    pub projection: [[f32; 4]; 4],
    /// Where clip space lies on the images: the host's viewport, which holds the frame's part of the images. That part, of
    /// [`Options::size`] from [`Images::corner`] on, is the host's scissor rectangle. `None` for a viewport that is the part.
    pub viewport: Option<Viewport>,
}

impl<'a> Scenery<'a> {
    /// Draws that are seen through a projection, with a viewport that is the frame's part of the images.
    #[must_use]
    pub fn new(draws: &'a [Draw], projection: [[f32; 4]; 4]) -> Self {
        Self { draws, projection, viewport: None }
    }

    /// Sets the viewport.
    #[must_use]
    pub fn viewport(mut self, viewport: Option<Viewport>) -> Self {
        self.viewport = viewport;
        self
    }
}

/// Result of the last recording of a [`Frame`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Outcome {
    /// Statistics of the recording.
    pub statistics: Statistics,
    /// Number of superpixels and tiles for which memory or [`Options::max_rounds`] did not suffice; these keep the colours that
    /// they had. The frame's next recording has more memory, unless [`Options::fixed_memory`] is set.
    pub left_over: u64,
    /// Counts of [`IndirectDraws`](super::IndirectDraws).
    pub indirect: IndirectCounts,
}

/// Pipelines and memory to antialias one frame in flight of a host.
pub struct Frame {
    lending: Lending,
    work: Work,
    kinds: ImageKinds,
    options: Options,
    growth: Growth,
    /// Number of triangles of the last recording.
    triangles: u32,
    /// Last: layouts go after what was made with them.
    shared: Arc<Shared>,
}

/// Largest size of a pixel of a colour image, in bytes.
const MOST_COLOR_BYTES: u64 = 16;

/// What a frame has for images of its size.
struct Work {
    sampling: Sampling,
    base: Base,
    /// The host's image of colours, where these are read.
    image: Option<Arc<HostImage>>,
    /// The pixel filter, unless it is the box.
    filter: Option<Pass>,
    patch: Patch,
    visibility_set: DescriptorSets,
    scratch: Arc<FrameScratch>,
}

impl Work {
    fn new(
        shared: &Shared,
        lending: &Lending,
        kinds: &ImageKinds,
        options: &Options,
        capacity: Capacity,
    ) -> Result<Self, HostError> {
        let gpu = &shared.gpu;
        let layout = &shared.frame;
        let (settings, superpixels) = (options.sampler(), options.superpixels());
        let method = superpixels.clone().into();
        let image = options.image(&method);
        image.check(gpu.limits())?;
        settings.check()?;
        check_size(options.size)?;
        let content = &lending.content;
        let copies = kinds.color_copied && !options.shade_all;
        let pixels = options.size.map(u64::from).iter().product::<u64>();
        let reserved = lending.bytes() + if copies { MOST_COLOR_BYTES * pixels } else { 0 };
        let mut plan = Plan::whole(&image, content, gpu.limits(), capacity, reserved)?;
        if kinds.ids {
            plan.sizes.filtered_triangles = 0;
        }
        let filters = plan.sizes.filtered_triangles > 0;
        let allowed = |taken| options.max_memory.map(|most| most.saturating_sub(taken));
        let scratch = shared.scratch.get(
            layout,
            &ScratchRequest { sizes: plan.sizes, targets: !kinds.ids, allowed: allowed(lending.bytes()) },
        )?;
        let memory = Memory::new(gpu.clone(), allowed(lending.bytes() + scratch.bytes()));
        let copy = copies.then(|| HostImage::for_copy(&memory, kinds.color_format, options.size)).transpose()?;
        let offsets = method.offsets()?;
        let count = offsets.len() as u32;
        let request = ResourceRequest {
            sizes: plan.sizes,
            others: &content.shown(),
            ids: ShownIds::Later,
            offsets: &[Offsets { all: &offsets, count }],
            scratch: Some(&scratch.passes),
        };
        let job = Job::new(layout, memory, &settings, capacity, &request)?;
        let context = job.context(content, 1);
        let drawn =
            (!options.shade_all).then(|| HostImage::new(layout, kinds.color_encoded, copy)).transpose()?.map(Arc::new);
        let cells = PixelCells {
            behind: drawn.clone().filter(|_| options.shows_drawn()),
            blend_ids: false,
            ..PixelCells::superpixels(&superpixels).filtered(&options.pixel_filter)
        };
        let cells = PixelCells {
            depth_of_image: if kinds.ids { lending.geometry.clip.depth_of_image() } else { cells.depth_of_image },
            ..cells
        };
        let mut sampler = cells.sampler(&context)?;
        if let Some(most) = options.max_rounds {
            sampler.limit_rounds(most);
        }
        // SAFETY: the set goes with the frame, as does what it shows.
        let visibility_set = unsafe { lending.visibility_set(shared, job.resources(), None) }?;
        let filters_pixels = !options.pixel_filter.is_box();
        let among = if sampler.growths() > 0 { Superpixels::Grown } else { Superpixels::Detected };
        // A host need not keep opacity in alpha.
        let filter = || pixel_filter::pass(layout, &options.pixel_filter, false, among, Alpha::Apart);
        let patched = match (options.shade_all || filters_pixels, sampler.growths()) {
            (true, _) => Patched::All,
            (false, 0) => Patched::Superpixels,
            (false, _) => Patched::Grown,
        };
        Ok(Self {
            base: Base::new(shared, content, drawn.as_ref(), (!kinds.ids).then_some(filters), &context.output)?,
            patch: Patch::new(layout, kinds.color_format, kinds.color_encoded, options.keep_alpha, patched)?,
            sampling: Sampling { job, sampler },
            image: drawn,
            filter: filters_pixels.then(filter).transpose()?,
            visibility_set,
            scratch,
        })
    }

    /// Has the passes read a host's images.
    ///
    /// # Safety
    /// The commands of the last recording are done, or will never be executed; the images outlive those of the next one.
    unsafe fn show(&self, images: &Images) {
        let lent = |ids: LentImage| IdViews {
            ids: ids.view,
            blend_ids: None,
            depth: images.depth.map(|depth| depth.view),
            placeholder: None,
        };
        let drawn = || self.scratch.targets().map(RasterTargets::views);
        // SAFETY: passed on to the caller.
        unsafe {
            if let Some(views) = images.ids.map(lent).or_else(drawn) {
                self.sampling.job.resources().show_ids(&views);
            }
            if let Some(image) = &self.image {
                image.show(images.color.view);
            }
        }
    }
}

impl Frame {
    /// # Safety
    /// As [`super::Antialiaser::prepare`].
    pub(super) unsafe fn new(
        shared: &Arc<Shared>,
        geometry: &Geometry,
        kinds: &ImageKinds,
        options: &Options,
        capacity: Capacity,
    ) -> Result<Self, HostError> {
        let gpu = &shared.gpu;
        options.image(&options.superpixels().into()).check(gpu.limits())?;
        options.sampler().check()?;
        geometry.check(gpu)?;
        if geometry.blended && options.shade_all {
            return Err(HostError::BlendedCentres);
        }
        if geometry.blended && options.shows_drawn() {
            return Err(HostError::BlendedBackground);
        }
        kinds.check(options)?;
        if kinds.ids && !geometry.indirect.is_empty() {
            return Err(HostError::IndirectIds);
        }
        let memory = Memory::new(gpu.clone(), options.max_memory);
        // SAFETY: passed on to the caller.
        let lending = unsafe { Lending::new(shared, memory, geometry) }?;
        Ok(Self {
            work: Work::new(shared, &lending, kinds, options, capacity)?,
            lending,
            kinds: *kinds,
            options: options.clone(),
            growth: Growth::default(),
            triangles: 0,
            shared: shared.clone(),
        })
    }

    /// Options with which the frame was prepared.
    #[must_use]
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Number of bytes of device memory in use, without the host's buffers and images: the frame's own, and those that it shares.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        self.lending.bytes() + self.work.sampling.job.memory().used() + self.shared_memory_bytes()
    }

    /// Number of those bytes that the frames of the antialiaser share.
    #[must_use]
    pub fn shared_memory_bytes(&self) -> u64 {
        self.work.scratch.bytes()
    }

    /// Number of rounds of a recording, with or without work: so many times the host's shading is called.
    /// [`Options::shade_all`] adds one call.
    #[must_use]
    pub fn rounds(&self) -> u32 {
        self.work.sampling.sampler.rounds()
    }

    /// Changes the size of the images, in pixels. Pipelines are kept, and so is shared memory that suffices. Memory of the frame alone,
    /// which is small, is made anew. If shared memory does not suffice, the first frame that is resized makes more, and the others
    /// share it.
    ///
    /// # Errors
    /// As [`super::Antialiaser::prepare`]; the frame is then as it was.
    ///
    /// # Safety
    /// As [`super::Antialiaser::prepare`]; the commands of the last recording are done, or will never be executed.
    pub unsafe fn resize(&mut self, size: [u32; 2]) -> Result<(), HostError> {
        let options = Options { size, ..self.options.clone() };
        let capacity = self.work.sampling.job.capacity();
        let (shared, lending) = (&self.shared, &self.lending);
        let resized = Work::new(shared, lending, &self.kinds, &options, capacity)?;
        self.lending.note(&self.work.sampling.job);
        self.work = resized;
        self.options = options;
        self.growth = Growth::default();
        Ok(())
    }

    /// Gives the frame more of the memory that the last recording lacked, if its commands are done and the host allows it.
    fn make_room(&mut self) -> Result<(), HostError> {
        if self.options.fixed_memory {
            return Ok(());
        }
        let make = |capacity| Work::new(&self.shared, &self.lending, &self.kinds, &self.options, capacity);
        if let Some(larger) = self.growth.larger(&self.work.sampling, make)? {
            self.lending.note(&self.work.sampling.job);
            self.work = larger;
        }
        Ok(())
    }

    /// Makes a frame for the same buffers and kinds of images, with more of the memory that the last recording lacked. If it lacked
    /// none, the new frame has as much. [`Options::max_rounds`] stays as it is. With [`Options::fixed_memory`], this is the way to more
    /// memory; otherwise [`Self::record`] takes care of it.
    ///
    /// # Errors
    /// If memory runs out; as [`Self::outcome`] where the last recording is not done.
    ///
    /// # Safety
    /// As [`super::Antialiaser::prepare`].
    pub unsafe fn grow(&self) -> Result<Self, HostError> {
        let capacity = self.work.sampling.next_capacity()?;
        // SAFETY: passed on to the caller.
        unsafe { Self::new(&self.shared, &self.lending.geometry, &self.kinds, &self.options, capacity) }
    }

    /// Records the antialiasing of a frame, of which the host has drawn what it lends: in any images of the kinds and the size
    /// that the frame was prepared for, such as the swapchain's image at hand. It submits nothing and waits for nothing.
    /// It updates descriptor sets of the frame's own, for which the last recording has to be done.
    ///
    /// It allocates nothing on the device, with one exception: if the last recording left work [over](Outcome::left_over) for
    /// want of memory, the frame first gets more of it, as by [`Self::resize`]. If the device has no more, the frame keeps what it
    /// has. [`Options::fixed_memory`] forbids this.
    ///
    /// # Errors
    /// If images or scenery do not fit what the frame was prepared for; if the device is lost while the frame gets more memory.
    /// Nothing is recorded then.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass and of conditional rendering, for the device of the antialiaser and a queue family with
    ///   graphics and compute. What was bound and pushed before has to be bound and pushed again.
    /// - The commands of this frame's last recording are done, or will never be executed: its memory is used again.
    /// - If the commands are submitted again, results are read only when that submission is done: until the device begins
    ///   it, it is taken for done.
    /// - The commands are executed on the queue that those of all frames of the antialiaser are executed on.
    /// - Images and views are alive, of this device, of the size and formats that the frame was prepared for, made with the usage flags
    ///   that [`Images`] names, and in the states named. Those of IDs and depth and, without [`Options::shade_all`], of colours hold
    ///   what the host has drawn of the same draws and positions.
    /// - In the frame's recordings, up to the first one that is executed, alpha maps are in `SHADER_READ_ONLY_OPTIMAL`, and were written before on the same queue
    ///   or made visible to it.
    /// - Writes to the lent buffers by the device were recorded into the same queue before, or made visible to it.
    /// - The frame, the buffers, the images and what `shading` records outlive the execution of the commands.
    /// - What `shading` records is valid, and writes no memory of the frame but by `gpc_store`.
    pub unsafe fn record(
        &mut self,
        commands: vk::CommandBuffer,
        images: &Images,
        scenery: &Scenery<'_>,
        shading: &dyn ShadeSamples,
    ) -> Result<(), HostError> {
        let placed = PlacedDraws::new(&self.lending.geometry, scenery.draws)?;
        if !scenery.projection.as_flattened().iter().all(|n| n.is_finite()) {
            return Err(HostError::NotFinite(Member::Projection));
        }
        if scenery.projection[1][1] == 0.0 {
            return Err(HostError::FlatProjection);
        }
        images.check(&self.kinds, &self.options, self.shared.gpu.limits().max_image_side)?;
        let plane = self.plane(scenery, images)?;
        self.make_room()?;
        let uniform = self.uniform(&placed, scenery, images, &plane);
        let work = &mut self.work;
        // SAFETY: passed on to the caller.
        unsafe { work.show(images) };
        self.triangles = placed.drawn_triangles;
        self.lending.note(&work.sampling.job);
        let lending = &self.lending;
        let Sampling { job, sampler } = &mut work.sampling;
        // SAFETY: passed on to the caller.
        let recording = unsafe { job.begin(commands, |_| ()) };
        let JobRecording { recorder, resources, settings, .. } = &recording;
        let Some(set) = resources.set(0) else {
            return Ok(());
        };
        recorder.begin();
        lending.record_alpha(recorder);
        images.record_begin(recorder, &self.kinds);
        if let Some(image) = &work.image {
            image.record_copy(recorder, images.color.image, images.corner, images.layer);
        }
        lending.record_triangles(recorder, &placed);
        let shading = lending.shading(shading, &work.visibility_set, resources);
        let footprints = Footprints::new(settings.filter, settings.cells.samples);
        let boxes = settings.filter == TextureFilter::Boxes;
        let at_centres = Lending::visible(&plane, footprints.centre, false);
        let at_places = Lending::visible(&plane, footprints.place, boxes);
        let shades_all = self.options.shade_all;
        let first = if shades_all { at_centres } else { at_places };
        lending.record_visible(recorder, &first);
        resources.record_begin(recorder, set, &uniform);
        let targets = work.scratch.targets();
        work.base.record(recorder, resources, &uniform, &placed, targets, &shading);
        if shades_all {
            lending.record_visible(recorder, &at_places);
            // What the centres counted is not of superpixels.
            resources.record_begin(recorder, set, &uniform);
        }
        let run = SamplerRun { resources, set, uniform: &uniform, locations: 0, index: 0 };
        if work.filter.is_some() {
            // Superpixels that are left over have no spread.
            recorder.clear(resources.buffer(Data::Spreads));
        }
        sampler.record_unmarked(recorder, resources);
        sampler.record(recorder, &run, &shading);
        if let Some(filter) = &work.filter {
            let [width, height] = uniform.size;
            filter.record_for(recorder, pixel_filter::columns(uniform.tiles[0] * uniform.tiles[1]));
            resources.record_keep_filtered(recorder, width * height);
        }
        images.record_draw(recorder, &self.kinds);
        let part = images.part(self.options.size);
        if self.kinds.color_copied {
            // Until here the colours were those of the copy. They are drawn to where the part lies in the host's image.
            let corner = std::mem::offset_of!(FrameUniform, color_corner) as u64;
            recorder.update(&set.uniform, corner, bytemuck::bytes_of(&images.corner));
        }
        work.patch.record(recorder, images.color.view, part);
        images.record_end(recorder);
        recording.end();
        Ok(())
    }

    /// Result of the last recording, available once its commands are done, until the next recording. This does not wait.
    ///
    /// # Errors
    /// [`VulkanError::NotDone`](crate::vulkan::VulkanError::NotDone) if the last recording was not submitted or still runs, and
    /// [`VulkanError::NotRecorded`](crate::vulkan::VulkanError::NotRecorded) if there was none; if what was counted or timed can't be read.
    pub fn outcome(&self) -> Result<Outcome, HostError> {
        let beside = self.lending.bytes() + self.shared_memory_bytes();
        self.work.sampling.outcome(self.triangles, &self.lending, beside)
    }

    /// Where clip space lies on the images.
    fn plane(&self, scenery: &Scenery<'_>, images: &Images) -> Result<ClipPlane, HostError> {
        let (clip, size) = (&self.lending.geometry.clip, self.options.size);
        match &scenery.viewport {
            Some(viewport) => ClipPlane::of_viewport(clip, viewport, images.corner, size),
            None => Ok(ClipPlane::of_size(clip, size)),
        }
    }

    fn uniform(&self, placed: &PlacedDraws, scenery: &Scenery<'_>, images: &Images, plane: &ClipPlane) -> FrameUniform {
        let (job, geometry) = (&self.work.sampling.job, &self.lending.geometry);
        let settings = job.settings();
        let threshold = u32::from(self.options.superpixels().threshold());
        let plane = PlaneBlock {
            gap: gap(&scenery.projection, plane.scale[1].abs()),
            contrast: threshold,
            // Materials that are filtered over their pixel vary within it by more than centres tell.
            alike: threshold.div_ceil(4),
            seen_corner: images.ids.map_or([0, 0], |_| images.corner),
            color_corner: if self.kinds.color_copied { [0, 0] } else { images.corner },
            ..plane_block(&geometry.clip, plane, self.options.size)
        };
        let samples = settings.cells.samples;
        let footprints = Footprints::new(settings.filter, samples);
        frame_uniform(&scene_block(geometry, placed), &plane, settings, samples, &footprints, job.resources().sizes())
    }
}

/// Change of depth between surfaces a pixel's width apart, as a factor on the depth and a constant. `half_height` is half the height
/// of clip space, in pixels.
fn gap(projection: &[[f32; 4]; 4], half_height: f32) -> [f32; 2] {
    let pixel = 1.0 / (projection[1][1].abs().max(f32::MIN_POSITIVE) * half_height);
    // Depth is near / distance in perspective, up to a constant, and linear in distance without.
    if projection[2][3] == 0.0 { [0.0, projection[2][2].abs() * pixel] } else { [pixel, 0.0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixels_width_in_depth() {
        let mut perspective = [[0.0; 4]; 4];
        perspective[1][1] = 2.0;
        perspective[2][3] = -1.0;
        assert_eq!(gap(&perspective, 50.0), [0.01, 0.0]);
        let mut parallel = [[0.0; 4]; 4];
        parallel[1][1] = 2.0;
        parallel[2][2] = -0.5;
        assert_eq!(gap(&parallel, 50.0), [0.0, 0.005]);
    }
}

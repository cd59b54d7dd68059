//! One frame: its passes and memory, and the order in which they are recorded.

use super::engine::{Engine, EngineKind, record_shading};
use super::plan::{Effort, Plan, Region};
use super::renderer::PreparedScene;
use super::statistics::Shortfall;
use super::{Detection, Footprint, Method, PassTime, Reference, RenderError, Settings, Statistics};
use crate::camera::{Camera, Projection};
use crate::passes::{
    Attributes, BoxFilter, Counter, DetectMode, Encode, Encoding, FrameLayout, FrameUniform,
    GpuScene, Locations, Multisample, Raster, RasterTargets, Resolve, Resources, Sample, Shade,
    ShadeSource, Sort, Spans, Transform,
};
use crate::sampling::Pattern;
use crate::vulkan::{Buffer, Constants, Memory, MemoryUse, Recorder, Timings};
use ash::vk;
use std::sync::Arc;

/// State of a host's image around the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageState {
    /// Its layout.
    pub layout: vk::ImageLayout,
    /// Stages that use it.
    pub stage: vk::PipelineStageFlags2,
    /// How they use it.
    pub access: vk::AccessFlags2,
}

/// Where a frame's colours go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A host's image, single-sampled, created as a transfer destination, of the frame's size and encoding.
    Image {
        /// The image.
        image: vk::Image,
        /// Its state when the frame begins; what it holds is replaced.
        before: ImageState,
        /// Its state when the frame is done.
        after: ImageState,
    },
    /// A buffer of rows of linear premultiplied RGBA floats, from the top.
    Buffer {
        /// The buffer, a transfer destination of 16 bytes a pixel.
        colors: vk::Buffer,
        /// Where attributes are asked for, a transfer destination of 32 bytes a pixel: see `shaders/attributes.comp`.
        attributes: Option<vk::Buffer>,
    },
}

/// What shades the centres of pixels.
struct PixelShading {
    spans: Spans,
    shade: Shade,
}

/// What turns the device's multisampling into colours.
struct Multisampling {
    multisample: Multisample,
    sort: Sort,
    shade: Arc<Shade>,
    resolve: Resolve,
}

/// Pipelines and memory for frames of one scene, size and method.
pub struct Frame {
    settings: Settings,
    plan: Plan,
    has_blend: bool,
    transform: Transform,
    raster: Raster,
    targets: RasterTargets,
    pixels: Option<PixelShading>,
    multisampling: Option<Multisampling>,
    blended: Option<Engine>,
    superpixels: Option<Engine>,
    box_filter: Option<BoxFilter>,
    attributes: Option<Attributes>,
    encode: Option<Encode>,
    resources: Resources,
    counters: Buffer,
    timings: Timings,
    memory: Memory,
    uploaded: bool,
}

/// Descriptor set with one sample at the pixel's centre.
const CENTRE: usize = 0;
/// Descriptor set with the method's sample locations.
const LOCATIONS: usize = 1;

impl Frame {
    pub(super) fn new(
        layout: &Arc<FrameLayout>,
        prepared: &PreparedScene,
        settings: &Settings,
        encoding: Option<Encoding>,
        effort: Effort,
    ) -> Result<Self, RenderError> {
        let scene = &prepared.gpu_scene;
        let gpu = prepared.memory.gpu().clone();
        let taken = prepared.memory_bytes();
        let plan = Plan::new(settings, scene, gpu.limits(), encoding, effort, taken)?;
        let memory = Memory::new(
            gpu.clone(),
            settings.max_memory.map(|limit| limit.saturating_sub(taken)),
        );
        let has_blend = scene.has_blend();
        let samples = if settings.method == Method::Msaa {
            vk::SampleCountFlags::from_raw(settings.samples)
        } else {
            vk::SampleCountFlags::TYPE_1
        };
        let multisampled = settings.method == Method::Msaa;
        let [width, height] = plan.sizes.region;
        let targets = RasterTargets::new(&memory, width, height, samples, has_blend)?;
        let mut locations = settings.locations()?;
        let sample_count = locations.len() as u32;
        locations.extend(Pattern::Sobol.offsets(Sample::PROBES)?);
        let resources = Resources::new(
            layout,
            &memory,
            scene,
            &targets,
            plan.sizes,
            &[
                Locations {
                    all: &[[0.0, 0.0]],
                    count: 1,
                },
                Locations {
                    all: &locations,
                    count: sample_count,
                },
            ],
        )?;

        let display = settings.reference == Reference::Display;
        let output = Constants::new()
            .flag(30, display && settings.tonemapped_detection)
            .flag(31, settings.tonemapped_detection);
        let detects = settings.method == Method::Superpixel
            && settings.detection != Detection::Exact
            && settings.detection != Detection::Every;
        let pixels = if multisampled {
            None
        } else {
            let display_codes = detects;
            Some(PixelShading {
                spans: Spans::new(layout, scene.bin_count() == 1)?,
                shade: Shade::new(
                    layout,
                    scene,
                    ShadeSource::Pixels { display_codes },
                    &output,
                )?,
            })
        };
        let cells = has_blend || settings.method == Method::Superpixel || multisampled;
        let shading = cells
            .then(|| Engine::shading(layout, scene, &output))
            .transpose()?;
        let engine = |kind: EngineKind| {
            shading
                .as_ref()
                .map(|shade| Engine::new(layout, scene, settings, &plan, shade, &output, &kind))
                .transpose()
        };
        let blended = if has_blend {
            let samples = if multisampled { settings.samples } else { 1 };
            engine(EngineKind {
                mode: DetectMode::Blended,
                thin: false,
                multisampled,
                samples,
                display_codes: detects,
            })?
        } else {
            None
        };
        let superpixels = if settings.method == Method::Superpixel {
            let mode = match settings.detection {
                Detection::Contrast => DetectMode::Contrast,
                Detection::Exact => DetectMode::Exact,
                Detection::Colour => DetectMode::Colour,
                Detection::Every => DetectMode::Every,
            };
            engine(EngineKind {
                mode,
                thin: settings.thin && settings.detection != Detection::Every,
                multisampled: false,
                samples: settings.samples,
                display_codes: false,
            })?
        } else {
            None
        };
        let multisampling = match &shading {
            Some(shade) if multisampled => Some(Multisampling {
                multisample: Multisample::new(layout)?,
                sort: Sort::new(layout, scene.bin_count() == 1)?,
                shade: shade.clone(),
                resolve: Resolve::for_multisample(layout, settings.samples, false, &output)?,
            }),
            _ => None,
        };
        let regions = plan.regions.len() as u64;
        let marks = regions as u32 * (16 + 2 * (4 + 8 * plan.rounds)) + 8;
        Ok(Self {
            has_blend,
            transform: Transform::new(layout)?,
            raster: Raster::new(layout, samples, scene.has_mask())?,
            targets,
            pixels,
            multisampling,
            blended,
            superpixels,
            box_filter: (settings.side() > 1)
                .then(|| BoxFilter::new(layout))
                .transpose()?,
            attributes: settings
                .attributes
                .then(|| Attributes::new(layout, settings.method == Method::Superpixel))
                .transpose()?,
            encode: encoding
                .filter(|e| *e != Encoding::Rgba32Float)
                .map(|e| Encode::new(layout, e))
                .transpose()?,
            resources,
            counters: memory.buffer(
                "counter read-back",
                regions * 2 * Counter::BYTES,
                vk::BufferUsageFlags::TRANSFER_DST,
                MemoryUse::Readback,
            )?,
            timings: Timings::new(&gpu, marks)?,
            settings: settings.clone(),
            plan,
            memory,
            uploaded: false,
        })
    }

    /// The settings it was prepared with.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// What it was planned for.
    pub(super) fn effort(&self) -> Effort {
        self.plan.effort
    }

    /// What the last frame could not finish.
    pub(super) fn shortfall(&self) -> Shortfall {
        let mut shortfall = Shortfall::default();
        for (tiles, blended, superpixels) in self.counted() {
            if self.blended.is_some() {
                shortfall.add(blended, tiles);
            }
            if self.superpixels.is_some() {
                shortfall.add(superpixels, tiles);
            }
        }
        shortfall
    }

    /// Tiles of each region, and what the last frame counted over them for BLEND pixels and for superpixels.
    fn counted(&self) -> impl Iterator<Item = (u32, &[u32], &[u32])> {
        let words: &[u32] = bytemuck::try_cast_slice(self.counters.bytes()).unwrap_or(&[]);
        self.plan
            .regions
            .iter()
            .zip(words.chunks_exact(2 * Counter::COUNT))
            .map(|(region, runs)| {
                let [width, height] = region.outer().map(|side| side * self.settings.side());
                let (blended, superpixels) = runs.split_at(Counter::COUNT);
                (width.div_ceil(8) * height.div_ceil(4), blended, superpixels)
            })
    }

    /// Whether [`Effort::with_doubled_lists`] makes any difference.
    pub(super) fn lists_can_grow(&self) -> bool {
        self.plan.lists_can_grow && self.settings.max_memory.is_none()
    }

    /// Bytes of device memory that it takes.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        self.memory.used()
    }

    /// Records a frame. It submits nothing, waits for nothing and allocates nothing.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass, for the device and queue family of the renderer.
    /// - `scene` is the one that the frame was prepared with and its upload was recorded before.
    /// - The commands of this frame's last recording are done: its memory is used again.
    /// - The target's handles are alive, of the frame's size, and as [`Target`] says.
    pub unsafe fn record(
        &mut self,
        scene: &PreparedScene,
        camera: &Camera,
        commands: vk::CommandBuffer,
        target: &Target,
    ) {
        let scene = &scene.gpu_scene;
        let gpu = self.memory.gpu().clone();
        // SAFETY: passed on to the caller.
        let mut recorder = unsafe { Recorder::new(&gpu, commands, Some(&mut self.timings)) };
        let recorder = &mut recorder;
        if !self.uploaded {
            self.resources.record_upload(recorder);
            self.uploaded = true;
        }
        if let Target::Image { image, before, .. } = target {
            transition(recorder, *image, *before, COPIED_TO);
        }
        recorder.begin();
        let passes = Passes {
            settings: &self.settings,
            plan: &self.plan,
            transform: &self.transform,
            raster: &self.raster,
            targets: &self.targets,
            pixels: self.pixels.as_ref(),
            multisampling: self.multisampling.as_ref(),
            blended: self.blended.as_ref(),
            superpixels: self.superpixels.as_ref(),
            box_filter: self.box_filter.as_ref(),
            attributes: self.attributes.as_ref(),
            encode: self.encode.as_ref(),
            resources: &self.resources,
            counters: &self.counters,
        };
        for (index, region) in self.plan.regions.iter().enumerate() {
            passes.record(recorder, scene, camera, index, region, target);
        }
        if let Target::Image { image, after, .. } = target {
            transition(recorder, *image, COPIED_TO, *after);
        }
    }

    /// Figures of the last frame. Call it when its commands are done.
    ///
    /// # Errors
    /// [`RenderError::Unfinished`] if records did not fit in memory in all rounds, [`RenderError::Vulkan`] if
    /// timestamps can't be read.
    pub fn statistics(&self, scene: &PreparedScene) -> Result<Statistics, RenderError> {
        let mut statistics = Statistics {
            regions: self.plan.regions.len() as u64,
            memory_bytes: self.memory.used() + scene.memory_bytes(),
            ..Statistics::default()
        };
        statistics.triangles.total = u64::from(scene.triangle_count());
        self.shortfall().check()?;
        for (tiles, _, superpixels) in self.counted() {
            if self.superpixels.is_some() {
                statistics.tiles += u64::from(tiles);
                statistics.add(superpixels);
            }
        }
        if !self.has_blend {
            statistics.skipped_passes.push("blend");
        }
        if self.superpixels.is_some() && statistics.superpixels == 0 {
            statistics
                .skipped_passes
                .extend(["cull", "bin", "sample", "resolve"]);
        }
        statistics.passes = self
            .timings
            .read()?
            .into_iter()
            .map(|(pass, ms)| PassTime { pass, ms })
            .collect();
        Ok(statistics)
    }
}

/// The state in which an image is copied to.
const COPIED_TO: ImageState = ImageState {
    layout: vk::ImageLayout::TRANSFER_DST_OPTIMAL,
    stage: vk::PipelineStageFlags2::COPY,
    access: vk::AccessFlags2::TRANSFER_WRITE,
};

fn transition(recorder: &Recorder<'_>, image: vk::Image, from: ImageState, to: ImageState) {
    let range = vk::ImageSubresourceRange {
        aspect_mask: vk::ImageAspectFlags::COLOR,
        base_mip_level: 0,
        level_count: 1,
        base_array_layer: 0,
        layer_count: 1,
    };
    let barriers = [vk::ImageMemoryBarrier2::default()
        .src_stage_mask(from.stage)
        .src_access_mask(from.access)
        .dst_stage_mask(to.stage)
        .dst_access_mask(to.access)
        .old_layout(from.layout)
        .new_layout(to.layout)
        .image(image)
        .subresource_range(range)];
    let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
    // SAFETY: the recorder's contract; the host vouches for its image and states.
    unsafe {
        recorder
            .device()
            .cmd_pipeline_barrier2(recorder.raw(), &info)
    };
}

/// A frame's passes, borrowed apart from its timings.
struct Passes<'a> {
    settings: &'a Settings,
    plan: &'a Plan,
    transform: &'a Transform,
    raster: &'a Raster,
    targets: &'a RasterTargets,
    pixels: Option<&'a PixelShading>,
    multisampling: Option<&'a Multisampling>,
    blended: Option<&'a Engine>,
    superpixels: Option<&'a Engine>,
    box_filter: Option<&'a BoxFilter>,
    attributes: Option<&'a Attributes>,
    encode: Option<&'a Encode>,
    resources: &'a Resources,
    counters: &'a Buffer,
}

impl Passes<'_> {
    fn record(
        &self,
        recorder: &mut Recorder<'_>,
        scene: &GpuScene,
        camera: &Camera,
        index: usize,
        region: &Region,
        target: &Target,
    ) {
        let resources = self.resources;
        let (Some(centre), Some(locations)) = (resources.set(CENTRE), resources.set(LOCATIONS))
        else {
            return;
        };
        let side = self.settings.side();
        let whole = self.uniform(scene, camera, region, false);
        let [width, height] = whole.size;
        let pixels = width * height;
        let tiles = whole.tiles[0] * whole.tiles[1];
        let main = if self.multisampling.is_some() {
            locations
        } else {
            centre
        };
        let with = |samples: u32, uniform: FrameUniform| FrameUniform {
            sample_count: samples,
            ..uniform
        };

        resources.record_begin(recorder, main, &with(main.count(), whole));
        if index == 0 {
            self.transform.record(recorder, scene.vertex_count());
            recorder.mark("transform");
        }
        self.raster.record(
            recorder,
            main.descriptor(),
            scene,
            self.targets,
            [width, height],
        );
        recorder.mark("raster");
        if let Some(PixelShading { spans, shade }) = self.pixels {
            let background = whole.background;
            resources.record_background(recorder, pixels, background, display_code(background));
            recorder.mark("background");
            spans.record(recorder, &resources.bins, [width, height]);
            recorder.mark("spans");
            shade.record(recorder, scene, &resources.arguments);
            recorder.mark("shade");
        }
        if let Some(Multisampling {
            multisample,
            sort,
            shade,
            resolve,
        }) = self.multisampling
        {
            multisample.record(recorder, tiles);
            recorder.mark("multisample");
            record_shading(recorder, scene, resources, sort, shade);
            resolve.record(recorder, &resources.arguments);
            recorder.mark("resolve");
        }
        if let Some(engine) = self.blended {
            resources.record_begin(recorder, main, &with(main.count(), whole));
            engine.record(recorder, scene, resources, tiles, self.plan.rounds);
            resources.record_keep_counters(recorder, self.counters, 2 * index as u64);
        }
        if let Some(engine) = self.superpixels {
            resources.record_begin(
                recorder,
                locations,
                &with(locations.count(), self.uniform(scene, camera, region, true)),
            );
            engine.record(recorder, scene, resources, tiles, self.plan.rounds);
            resources.record_keep_counters(recorder, self.counters, 2 * index as u64 + 1);
        }
        if let Some(attributes) = self.attributes {
            attributes.record(recorder, pixels / (side * side));
            recorder.mark("attributes");
        }
        if let Some(filter) = self.box_filter {
            let filtered = pixels / (side * side);
            filter.record(recorder, filtered, side);
            copy(
                recorder,
                resources.filtered.buffer.handle(),
                resources.color.buffer.handle(),
                &[(0, 0, u64::from(filtered) * 16)],
            );
            recorder.barrier();
            recorder.mark("box_filter");
        }
        if let Some(encode) = self.encode {
            encode.record(recorder, pixels);
            recorder.mark("encode");
        }
        self.deliver(recorder, region, target);
        recorder.barrier();
        recorder.mark("copy");
    }

    /// Copies what the region owns to its place in the target.
    fn deliver(&self, recorder: &Recorder<'_>, region: &Region, target: &Target) {
        let row = u64::from(region.outer()[0]);
        let first = u64::from(region.halo[1]) * row + u64::from(region.halo[0]);
        let [width, height] = region.size();
        let rows = |bytes: u64| -> Vec<(u64, u64, u64)> {
            let image_row = u64::from(self.settings.size[0]);
            (0..u64::from(height))
                .map(|y| {
                    let to = (u64::from(region.low[1]) + y) * image_row + u64::from(region.low[0]);
                    (
                        (first + y * row) * bytes,
                        to * bytes,
                        u64::from(width) * bytes,
                    )
                })
                .collect()
        };
        match target {
            Target::Buffer { colors, attributes } => {
                copy(
                    recorder,
                    self.resources.color.buffer.handle(),
                    *colors,
                    &rows(16),
                );
                if let (Some(attributes), Some(_)) = (attributes, self.attributes) {
                    copy(
                        recorder,
                        self.resources.attributes.handle(),
                        *attributes,
                        &rows(32),
                    );
                }
            }
            Target::Image { image, .. } => {
                let encoded = self.encode.is_some();
                let bytes = self.plan.sizes.encoded / u64::from(self.plan.sizes.pixels()).max(1);
                let (buffer, bytes) = if encoded {
                    (self.resources.encoded.handle(), bytes)
                } else {
                    (self.resources.color.buffer.handle(), 16)
                };
                let copy = [vk::BufferImageCopy::default()
                    .buffer_offset(first * bytes)
                    .buffer_row_length(row as u32)
                    .image_subresource(vk::ImageSubresourceLayers {
                        aspect_mask: vk::ImageAspectFlags::COLOR,
                        mip_level: 0,
                        base_array_layer: 0,
                        layer_count: 1,
                    })
                    .image_offset(vk::Offset3D {
                        x: region.low[0] as i32,
                        y: region.low[1] as i32,
                        z: 0,
                    })
                    .image_extent(vk::Extent3D {
                        width,
                        height,
                        depth: 1,
                    })];
                // SAFETY: the recorder's contract; the buffer holds the region, the host vouches for its image.
                unsafe {
                    recorder.device().cmd_copy_buffer_to_image(
                        recorder.raw(),
                        buffer,
                        *image,
                        COPIED_TO.layout,
                        &copy,
                    )
                };
            }
        }
    }

    /// The uniform block of a region; with `owned`, only pixels that the region owns become cells.
    fn uniform(
        &self,
        scene: &GpuScene,
        camera: &Camera,
        region: &Region,
        owned: bool,
    ) -> FrameUniform {
        let side = self.settings.side();
        let scale = f64::from(side);
        let [image_width, image_height] =
            self.settings.size.map(|pixels| f64::from(pixels) * scale);
        let [width, height] = region.outer().map(|pixels| pixels * side);
        let corner = [0, 1].map(|axis| f64::from(region.low[axis] - region.halo[axis]) * scale);
        let left_top = [
            corner[0] - 0.5 * image_width,
            corner[1] - 0.5 * image_height,
        ];
        let to_device = [2.0 / f64::from(width), 2.0 / f64::from(height)];
        let low = [region.halo[0] * side, region.halo[1] * side];
        let [own_width, own_height] = region.size().map(|pixels| pixels * side);
        let (interior_low, interior_high) = if owned {
            (low, [low[0] + own_width, low[1] + own_height])
        } else {
            ([0, 0], [width, height])
        };
        let eye = (camera.eye - scene.origin()).as_vec3();
        let direction = camera.direction().as_vec3();
        let parallel = if camera.is_orthographic() { 1.0 } else { 0.0 };
        FrameUniform {
            transform: camera
                .pixel_matrix(scene.origin(), image_width, image_height)
                .as_mat4()
                .to_cols_array(),
            eye: [eye.x, eye.y, eye.z, 1.0],
            view_direction: [direction.x, direction.y, direction.z, parallel],
            background: self
                .settings
                .background
                .map_or([0.0; 4], |[r, g, b]| [r, g, b, 1.0]),
            raster_scale: to_device.map(|scale| scale as f32),
            raster_offset: [0, 1].map(|axis| (-left_top[axis] * to_device[axis] - 1.0) as f32),
            origin: left_top.map(|position| (position + 0.5) as f32),
            size: [width, height],
            tiles: [width.div_ceil(8), height.div_ceil(4)],
            interior_low,
            interior_high,
            gap: gap(camera, image_height),
            vertex_count: scene.vertex_count(),
            triangle_count: scene.triangle_count(),
            first_mask: scene.first_mask(),
            first_blend: scene.first_blend(),
            sample_count: 1,
            pair_capacity: self.plan.sizes.pair_capacity,
            list_capacity: self.plan.sizes.list_capacity,
            record_capacity: self.plan.sizes.record_capacity,
            bin_count: scene.bin_count(),
            light_count: scene.light_features().count,
            contrast: u32::from(self.settings.contrast),
            exposure: self.settings.exposure.exp2(),
            footprint: match self.settings.footprint {
                Footprint::Pixel => side as f32,
                Footprint::Sample => 1.0,
            },
            reach: 0.5,
            group_count: 0,
        }
    }
}

/// Factor on a depth, and constant, by which a surface nearer by a pixel's width has a larger depth.
fn gap(camera: &Camera, image_height: f64) -> [f32; 2] {
    match camera.projection {
        // Depth is near / distance, so that a relative difference is one of distances.
        Projection::Perspective { fov, .. } => {
            [(2.0 * (0.5 * fov).tan() / image_height) as f32, 0.0]
        }
        Projection::Orthographic {
            half_height,
            near,
            far,
        } => [
            0.0,
            (2.0 * half_height / image_height / (far - near)) as f32,
        ],
    }
}

/// The 8-bit sRGB codes of a premultiplied colour, as `display_code` of `shaders/include/color.glsl` packs them.
pub(super) fn display_code(color: [f32; 4]) -> u32 {
    let [r, g, b, a] = color.map(f64::from);
    let rgb = [r, g, b].map(crate::reference::srgb::encode_u8);
    u32::from_le_bytes([
        rgb[0],
        rgb[1],
        rgb[2],
        (a.clamp(0.0, 1.0) * 255.0).round() as u8,
    ])
}

/// Copies (from, to, bytes) between buffers.
fn copy(recorder: &Recorder<'_>, from: vk::Buffer, to: vk::Buffer, parts: &[(u64, u64, u64)]) {
    let regions: Vec<_> = parts
        .iter()
        .map(|(src, dst, size)| {
            vk::BufferCopy::default()
                .src_offset(*src)
                .dst_offset(*dst)
                .size(*size)
        })
        .collect();
    // SAFETY: the recorder's contract; the parts lie in both buffers, which callers have sized for them.
    unsafe {
        recorder
            .device()
            .cmd_copy_buffer(recorder.raw(), from, to, &regions)
    };
}

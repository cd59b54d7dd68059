//! The passes and memory that sample locations: the engine of superpixels with the caller's cells in the place of pixels.

use super::layout::CellSizes;
use super::partition::Window;
use super::plan::LocationPlan;
use crate::camera::Pinhole;
use crate::passes::{
    Bin, Cells, Content, Counter, Cull, FrameGeometry, FrameLayout, FrameLook, FrameUniform,
    GpuScene, Groups, LocationData, Offsets, Points, RasterTargets, RecordRate, Resolve, Resources,
    Sample, SampleOptions, Schedule, Setup, Shade, ShadeSource, Sort, Stroke, StrokeSizes, Then,
    VisibilitySample,
};
use crate::render::engine::{can_settle, record_rate, record_shading, with_probes};
use crate::render::footprint::Footprints;
use crate::render::frame::recording::SceneShading;
use crate::render::renderer::PreparedScene;
use crate::render::statistics::Shortfall;
use crate::render::{Coverage, PassTime, RenderError, Settings, Statistics};
use crate::vulkan::{Buffer, Memory, MemoryUse, Recorder, Timings, VulkanError};
use ash::vk;
use glam::{DMat4, DVec2};
use std::sync::Arc;

/// Locations of a cell that are sampled once each, at the least; a subgroup may hold more.
const POINTS_IN_CELL: u32 = 16;
/// BLEND layers of a list, and half the lists of a block, that tiles are admitted with.
const LAYERS: u32 = 4;

/// What is sampled, and what is asked of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sampling {
    pub cells: Cells,
    /// Whether the host says which lights reach the records before these are shaded.
    pub shadows: bool,
}

impl Sampling {
    /// Whether the host is given the records, all of which then are one round's.
    pub fn hands_over_records(self) -> bool {
        self.shadows || !self.shades()
    }

    /// Whether records are shaded.
    fn shades(self) -> bool {
        self.cells != Cells::Occluders
    }
}

/// What makes values of shaded records.
enum Finish {
    Points(Points),
    Resolve(Resolve),
}

/// Pipelines and memory to sample runs of locations of one scene.
pub(super) struct LocationEngine {
    settings: Settings,
    /// Rounds of lists and records recorded for a run.
    rounds: u32,
    stroke: Option<Stroke>,
    cull: Cull,
    bin: Bin,
    schedule: Schedule,
    groups: Groups,
    setup: Setup,
    sample: Sample,
    /// Nothing where records are all that is asked for.
    shading: Option<Shading>,
    /// Where the host is given the records, and how many there may be.
    records: Option<Buffer>,
    handed: u32,
    geometry: FrameGeometry,
    resources: Resources,
    targets: RasterTargets,
    counters: Buffer,
    timings: Timings,
    memory: Memory,
    uploaded: bool,
}

/// The passes that make values of records.
struct Shading {
    sort: Sort,
    shade: Shade,
    finish: Finish,
}

/// What the locations of a run saw, in their order.
pub(super) struct LocationValues<'a> {
    /// Where the host is given them.
    pub records: &'a [VisibilitySample],
    /// Where records are shaded.
    pub colors: &'a [[f32; 4]],
    /// What `shaders/points.comp` wrote; nothing for superpixels.
    pub attributes: &'a [[[u32; 4]; 2]],
}

/// How locations share cells and groups on a device.
pub(super) fn cell_sizes(layout: &FrameLayout, cells: Cells, samples: u32) -> CellSizes {
    let lanes = layout.gpu.limits().lanes;
    let in_cell = match cells {
        Cells::Points | Cells::Occluders => POINTS_IN_CELL.next_multiple_of(lanes),
        Cells::Superpixels | Cells::Pixels => 1,
    };
    CellSizes {
        in_cell: in_cell as usize,
        in_group: lanes as usize,
        samples,
    }
}

/// From the space of a scene's geometry to clip space around a window's middle.
fn to_clip(scene: &GpuScene, pinhole: &Pinhole, window: &Window) -> DMat4 {
    pinhole.pixel_matrix(scene.origin(), DVec2::from_array(window.middle))
}

impl Shading {
    fn record(&self, recorder: &mut Recorder<'_>, resources: &Resources, scene: &GpuScene) {
        let shade = Some(&self.shade);
        record_shading(
            recorder,
            resources,
            &self.sort,
            &SceneShading { scene, shade },
        );
        match &self.finish {
            Finish::Points(points) => {
                points.record(recorder, &resources.arguments);
                recorder.mark("points");
            }
            Finish::Resolve(resolve) => {
                resolve.record(recorder, &resources.arguments);
                recorder.mark("resolve");
            }
        }
    }
}

impl LocationEngine {
    /// Makes the pipelines, and memory for the runs of a plan.
    pub fn new(
        layout: &Arc<FrameLayout>,
        prepared: &PreparedScene,
        settings: &Settings,
        sampling: Sampling,
        plan: &LocationPlan,
        apart: bool,
    ) -> Result<Self, RenderError> {
        let LocationPlan {
            sizes,
            rounds,
            handed,
            ..
        } = plan;
        let scene = &*prepared.gpu_scene;
        let gpu = scene.memory().gpu().clone();
        let taken = prepared.memory_bytes();
        let memory = Memory::new(
            gpu.clone(),
            settings.max_memory.map(|limit| limit.saturating_sub(taken)),
        );
        let cells = sampling.cells;
        let points = cells.are_points();
        let CellSizes { in_cell, .. } = cell_sizes(layout, cells, settings.samples);
        let options = SampleOptions {
            cells,
            samples: if points {
                in_cell as u32
            } else {
                settings.samples
            },
            records: if points {
                RecordRate::Sample
            } else {
                record_rate(settings, scene)
            },
            exact_areas: settings.coverage == Coverage::Area && settings.samples > 1 && !points,
            can_settle: can_settle(settings, scene),
            apart,
            unlisted: true,
            has_mask: scene.has_mask(),
            has_blend: scene.has_blend(),
            always_blends: false,
        };
        let offsets = with_probes(if points {
            vec![[0.0; 2]]
        } else {
            settings.pattern.offsets(settings.samples)?
        })?;
        let offsets = Offsets {
            all: &offsets,
            count: options.samples,
        };
        let targets = RasterTargets::new(
            &memory,
            1,
            1,
            vk::SampleCountFlags::TYPE_1,
            scene.has_blend(),
        )?;
        let geometry = FrameGeometry::new(&memory, scene, false)?;
        let look = FrameLook::default();
        let mut texels = geometry.texels(scene);
        texels.push(look.texels(scene));
        let resources = Resources::new(
            layout,
            &memory,
            scene,
            (&texels, look.lights(scene)),
            &targets.views(),
            *sizes,
            &[offsets],
        )?;
        let output = settings.color_constants(scene);
        let sample = Sample::new(layout, scene, &options)?;
        let finish = || -> Result<Finish, RenderError> {
            Ok(if points {
                Finish::Points(Points::new(layout, scene, &output)?)
            } else {
                Finish::Resolve(Resolve::new(
                    layout,
                    &sample,
                    scene.has_blend(),
                    Then::Nothing,
                    &output,
                )?)
            })
        };
        let source = ShadeSource::Records {
            cells,
            shadows: sampling.shadows,
        };
        let shading = || -> Result<Shading, RenderError> {
            Ok(Shading {
                sort: Sort::new(layout, scene, scene.bin_count() == 1)?,
                shade: Shade::new(layout, scene, source, &output)?,
                finish: finish()?,
            })
        };
        let records = || {
            memory.buffer(
                "records for the host",
                16 * u64::from(*handed),
                vk::BufferUsageFlags::TRANSFER_DST,
                MemoryUse::Readback,
            )
        };
        Ok(Self {
            settings: settings.clone(),
            stroke: scene
                .has_strokes()
                .then(|| Stroke::new(layout))
                .transpose()?,
            cull: Cull::new(layout, scene)?,
            bin: Bin::new(layout, scene)?,
            schedule: Schedule::new(layout, &sample, LAYERS)?,
            groups: Groups::new(layout, &sample)?,
            setup: Setup::new(layout, scene)?,
            shading: sampling.shades().then(shading).transpose()?,
            records: sampling.hands_over_records().then(records).transpose()?,
            sample,
            geometry,
            resources,
            targets,
            counters: memory.buffer(
                "counter read-back",
                Counter::BYTES,
                vk::BufferUsageFlags::TRANSFER_DST,
                MemoryUse::Readback,
            )?,
            rounds: *rounds,
            handed: *handed,
            timings: Timings::new(&gpu, 16 + 8 * rounds)?,
            memory,
            uploaded: false,
        })
    }

    /// Writes a run's locations for the device to read.
    pub fn write(&mut self, data: &LocationData) -> Result<(), VulkanError> {
        self.resources.write_locations(data)
    }

    /// Writes a word for each record: a bit for each light that it lies in the shadow of.
    pub fn write_shadows(&mut self, words: &[u32]) -> Result<(), VulkanError> {
        self.resources.write_shadows(words)
    }

    /// Records a run whose locations have been written: all of it or, where the host is given the records, up to these.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass, for the device and queue family of the renderer.
    /// - `scene` is the one that the engine was made for and its upload was recorded before.
    /// - The commands of the engine's last recording are done: its memory is used again.
    pub unsafe fn record(
        &mut self,
        scene: &PreparedScene,
        pinhole: &Pinhole,
        window: &Window,
        data: &LocationData,
        commands: vk::CommandBuffer,
    ) {
        let uniform = self.uniform(&scene.gpu_scene, pinhole, window, data);
        let to_clip = to_clip(&scene.gpu_scene, pinhole, window);
        self.geometry.place(&scene.gpu_scene, &to_clip, None);
        let scene = &*scene.gpu_scene;
        let gpu = self.memory.gpu().clone();
        // SAFETY: passed on to the caller.
        let mut recorder = unsafe { Recorder::new(&gpu, commands, Some(&mut self.timings)) };
        let recorder = &mut recorder;
        let resources = &self.resources;
        let arguments = &resources.arguments;
        if !self.uploaded {
            self.geometry.record_upload(recorder, scene);
            resources.record_upload(recorder);
            self.targets.record_unused(recorder);
            self.uploaded = true;
        }
        recorder.begin();
        let Some(set) = resources.set(0) else {
            return;
        };
        resources.record_begin(recorder, set, &uniform);
        let superpixels = match self.sample.options().cells {
            Cells::Superpixels | Cells::Pixels => data.cells.len() as u32,
            Cells::Points | Cells::Occluders => 0,
        };
        let tiles = data.loads.iter().filter(|[cells, _]| *cells > 0).count() as u32;
        resources.record_counters(
            recorder,
            &[(Counter::Superpixels, superpixels), (Counter::Tiles, tiles)],
        );
        if let Some(stroke) = &self.stroke {
            let sizes = StrokeSizes {
                line_width: self.settings.line_width,
                point_size: self.settings.point_size,
                edge_width: self.settings.edge_width,
                side: 1,
            };
            stroke.record(recorder, scene, &self.geometry, &to_clip, sizes);
            recorder.mark("stroke");
        }
        self.cull.record(recorder, arguments);
        recorder.mark("cull");
        self.bin.record(recorder, arguments);
        recorder.mark("bin");
        if self.sample.options().probes() {
            recorder.clear(&resources.marks);
            recorder.barrier();
        }
        self.schedule.record_tally(recorder, arguments);
        for _ in 0..self.rounds {
            self.schedule.record(recorder, arguments);
            self.groups.record(recorder, arguments);
            recorder.mark("schedule");
            self.setup.record(recorder, arguments);
            recorder.mark("setup");
            self.sample.record(recorder, arguments);
            recorder.mark("sample");
            match (&self.records, &self.shading) {
                (Some(records), _) => resources.record_keep_records(recorder, records, self.handed),
                (None, Some(shading)) => shading.record(recorder, resources, scene),
                (None, None) => {}
            }
        }
        resources.record_keep_counters(recorder, &self.counters, 0);
        recorder.barrier();
    }

    /// Records what is left of a run once the host has written the shadows of its records.
    ///
    /// # Safety
    /// As [`Self::record`], whose commands are done.
    pub unsafe fn record_shading(&mut self, scene: &PreparedScene, commands: vk::CommandBuffer) {
        let gpu = self.memory.gpu().clone();
        // SAFETY: passed on to the caller.
        let mut recorder = unsafe { Recorder::new(&gpu, commands, Some(&mut self.timings)) };
        let resources = &self.resources;
        recorder.go_on();
        if let (Some(shading), Some(set)) = (&self.shading, resources.set(0)) {
            resources.record_bind(&recorder, set);
            shading.record(&mut recorder, resources, &scene.gpu_scene);
        }
        resources.record_keep_counters(&recorder, &self.counters, 0);
        recorder.barrier();
    }

    /// The records of the last run, where the host is given them.
    pub fn records(&self) -> Result<&[VisibilitySample], VulkanError> {
        match &self.records {
            Some(records) => records.read(self.recorded()? as usize),
            None => Ok(&[]),
        }
    }

    /// Records of the last round.
    fn recorded(&self) -> Result<u32, VulkanError> {
        let counted = self.counted()?.get(Counter::Records as usize);
        Ok(counted.copied().unwrap_or(0))
    }

    /// What the last run's `locations` locations saw.
    pub fn values(&self, locations: usize) -> Result<LocationValues<'_>, VulkanError> {
        let Resources {
            color, attributes, ..
        } = &self.resources;
        Ok(LocationValues {
            records: self.records()?,
            colors: match &self.shading {
                Some(_) => color.buffer.read(locations)?,
                None => &[],
            },
            attributes: match self.resources.sizes().attributes {
                true => attributes.read(locations)?,
                false => &[],
            },
        })
    }

    /// Device memory of the engine alone, in bytes.
    pub fn memory_bytes(&self) -> u64 {
        self.memory.used()
    }

    fn counted(&self) -> Result<&[u32], VulkanError> {
        self.counters.read(Counter::COUNT)
    }

    /// What the last run could not finish.
    pub fn shortfall(&self, window: &Window) -> Result<Shortfall, VulkanError> {
        let mut shortfall = Shortfall::default();
        let room = self.resources.sizes().survivor_capacity;
        shortfall.add(self.counted()?, (window.tile_count(), room), true);
        shortfall.add_subgroups(self.counted()?);
        if self.records.is_some() {
            shortfall.crowded += u64::from(self.recorded()?.saturating_sub(self.handed));
        }
        Ok(shortfall)
    }

    /// Fails where records of the last run did not fit, or lists were too long.
    ///
    /// # Errors
    /// [`RenderError::Unfinished`], or [`RenderError::Vulkan`] if what was counted can't be read.
    pub fn check(&self, window: &Window) -> Result<(), RenderError> {
        self.shortfall(window)?.check(self.resources.sizes().lanes)
    }

    /// Adds the figures of the last run.
    ///
    /// # Errors
    /// If what was counted or timed can't be read.
    pub fn add_statistics(
        &self,
        scene: &PreparedScene,
        window: &Window,
        total: &mut Statistics,
    ) -> Result<(), VulkanError> {
        total.add(self.counted()?);
        total.tiles += u64::from(window.tile_count());
        total.regions += 1;
        total.triangles.total = scene.triangle_count();
        total.memory_bytes = total
            .memory_bytes
            .max(self.memory.used() + scene.memory_bytes());
        for (pass, ms) in self.timings.read()? {
            total.add_time(PassTime { pass, ms });
        }
        Ok(())
    }

    fn uniform(
        &self,
        scene: &GpuScene,
        pinhole: &Pinhole,
        window: &Window,
        data: &LocationData,
    ) -> FrameUniform {
        let middle = window.middle;
        let eye = (pinhole.eye() - scene.origin()).as_vec3();
        // Parallel rays need not be at right angles to the plane.
        let direction = pinhole
            .parallel_direction()
            .map_or(pinhole.direction(), |to_centre| -to_centre)
            .as_vec3();
        let parallel = if pinhole.is_parallel() { 1.0 } else { 0.0 };
        let points = self.sample.options().cells.are_points();
        let samples = self.sample.options().samples;
        let footprints = Footprints::new(&self.settings, if points { 1 } else { samples });
        FrameUniform {
            transform: to_clip(scene, pinhole, window).as_mat4().to_cols_array(),
            eye: [eye.x, eye.y, eye.z, 1.0],
            view_direction: [direction.x, direction.y, direction.z, parallel],
            irradiance: scene.environment().irradiance,
            environment: scene.environment().axes,
            background: self.settings.background_rgba(),
            origin: [0, 1].map(|axis| (window.low[axis] as f64 + 0.5 - middle[axis]) as f32),
            size: window.size(),
            tiles: window.tiles,
            triangle_count: scene.index_count(),
            first_mask: scene.first_mask(),
            first_blend: scene.first_blend(),
            sample_count: samples,
            survivor_capacity: self.resources.sizes().survivor_capacity,
            pair_capacity: self.resources.sizes().pair_capacity,
            list_capacity: self.resources.sizes().list_capacity,
            record_capacity: self.resources.sizes().record_capacity,
            bin_count: scene.bin_count(),
            light_count: scene.light_features().count,
            material_vectors: scene.material_vectors(),
            exposure: self.settings.exposure.exp2(),
            footprint: footprints.centre,
            place_footprint: footprints.place,
            sample_footprint: footprints.sample,
            side: 1,
            reach: window.reach as f32,
            group_count: data.groups.len() as u32,
            ..FrameUniform::default()
        }
    }
}

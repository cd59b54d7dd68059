//! The passes and memory that sample locations: the engine of superpixels with the caller's cells in the place of pixels.

use super::partition::Window;
use super::plan::LocationPlan;
use crate::camera::Pinhole;
use crate::passes::{
    Cells, Content, Counter, FrameGeometry, FrameLayout, FrameLook, FrameUniform, GpuScene,
    ListedLocation, Offsets, RasterTargets, Resources, Shade, ShadeSource, Stroke, StrokeSizes,
    VisibilitySample,
};
use crate::render::footprint::Footprints;
use crate::render::frame::recording::SceneShading;
use crate::render::list::{ListEngine, ListKind};
use crate::render::plan::Capacity;
use crate::render::renderer::PreparedScene;
use crate::render::statistics::Shortfall;
use crate::render::{PassTime, RenderError, Settings, Statistics};
use crate::vulkan::{Buffer, Memory, MemoryUse, Recorder, Timings, VulkanError};
use ash::vk;
use glam::{DMat4, DVec2};
use std::sync::Arc;

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

    /// What the engine is made for; `apart` says whether a subgroup samples one cell at a time.
    pub fn kind(self, apart: bool) -> ListKind {
        let Capacity {
            layers, unlisted, ..
        } = Capacity::default();
        ListKind {
            cells: self.cells,
            attributes: self.cells == Cells::Points,
            lent: false,
            apart,
            unlisted,
            layers,
        }
    }
}

/// Pipelines and memory to sample runs of locations of one scene.
pub(super) struct LocationEngine {
    settings: Settings,
    /// Rounds of lists and records recorded for a run.
    rounds: u32,
    stroke: Option<Stroke>,
    engine: ListEngine,
    /// Nothing where records are all that is asked for.
    shade: Option<Shade>,
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

/// What the locations of a run saw, in their order.
pub(super) struct LocationValues<'a> {
    /// Where the host is given them.
    pub records: &'a [VisibilitySample],
    /// Where records are shaded.
    pub colors: &'a [[f32; 4]],
    /// What `shaders/points.comp` wrote; nothing for superpixels.
    pub attributes: &'a [[[u32; 4]; 2]],
}

/// From the space of a scene's geometry to clip space around a window's middle.
fn to_clip(scene: &GpuScene, pinhole: &Pinhole, window: &Window) -> DMat4 {
    pinhole.pixel_matrix(scene.origin(), DVec2::from_array(window.middle))
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
        let kind = sampling.kind(apart);
        let (offsets, count) = kind.offsets(layout, settings)?;
        let offsets = Offsets {
            all: &offsets,
            count,
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
        let source = ShadeSource::Records {
            cells: sampling.cells,
            shadows: sampling.shadows,
        };
        let read_back = |name, bytes| {
            let usage = vk::BufferUsageFlags::TRANSFER_DST;
            memory.buffer(name, bytes, usage, MemoryUse::Readback)
        };
        let records = || read_back("records for the host", 16 * u64::from(*handed));
        let listed = resources.listed()?;
        // SAFETY: the list goes with the resources, and has room for as many locations.
        let engine = unsafe {
            ListEngine::new(
                layout,
                scene,
                settings,
                &kind,
                (&resources, listed),
                &output,
            )
        }?;
        let shade = || Shade::new(layout, scene, source, &output);
        Ok(Self {
            settings: settings.clone(),
            stroke: scene
                .has_strokes()
                .then(|| Stroke::new(layout))
                .transpose()?,
            shade: engine.shades().then(shade).transpose()?,
            engine,
            records: sampling.hands_over_records().then(records).transpose()?,
            geometry,
            resources,
            targets,
            counters: read_back("counter read-back", Counter::BYTES)?,
            rounds: *rounds,
            handed: *handed,
            timings: Timings::new(&gpu, 16 + 8 * rounds)?,
            memory,
            uploaded: false,
        })
    }

    /// The list of a run of so many locations, to be written while the device is idle.
    pub fn listed_mut(&mut self, count: usize) -> Result<&mut [ListedLocation], VulkanError> {
        self.resources.listed_mut(count)
    }

    /// Writes a word for each record: a bit for each light that it lies in the shadow of.
    pub fn write_shadows(&mut self, words: &[u32]) -> Result<(), VulkanError> {
        self.resources.write_shadows(words)
    }

    /// Records a run of so many locations, which have been written: all of it or, where the host is given the records, up to these.
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
        count: usize,
        commands: vk::CommandBuffer,
    ) {
        let uniform = self.uniform(&scene.gpu_scene, pinhole, window);
        let to_clip = to_clip(&scene.gpu_scene, pinhole, window);
        self.geometry.place(&scene.gpu_scene, &to_clip, None);
        let scene = &*scene.gpu_scene;
        let gpu = self.memory.gpu().clone();
        // SAFETY: passed on to the caller.
        let mut recorder = unsafe { Recorder::new(&gpu, commands, Some(&mut self.timings)) };
        let recorder = &mut recorder;
        let resources = &self.resources;
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
        let region = window.region(count);
        let engine = &self.engine;
        engine.record_candidates(recorder, (resources, set), &region);
        let shade = self.shade.as_ref();
        let shading = SceneShading { scene, shade };
        for _ in 0..self.rounds {
            engine.record_round(recorder, resources);
            match &self.records {
                Some(records) => resources.record_keep_records(recorder, records, self.handed),
                None => engine.record_values(recorder, resources, &shading),
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
        if let Some(set) = resources.set(0) {
            let (scene, shade) = (&*scene.gpu_scene, self.shade.as_ref());
            let shading = SceneShading { scene, shade };
            resources.record_bind(&recorder, set);
            self.engine
                .record_values(&mut recorder, resources, &shading);
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
            colors: match self.engine.shades() {
                true => color.buffer.read(locations)?,
                false => &[],
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

    fn uniform(&self, scene: &GpuScene, pinhole: &Pinhole, window: &Window) -> FrameUniform {
        let middle = window.middle;
        let eye = (pinhole.eye() - scene.origin()).as_vec3();
        // Parallel rays need not be at right angles to the plane.
        let direction = pinhole
            .parallel_direction()
            .map_or(pinhole.direction(), |to_centre| -to_centre)
            .as_vec3();
        let parallel = if pinhole.is_parallel() { 1.0 } else { 0.0 };
        let points = self.engine.options().cells.are_points();
        let samples = self.engine.options().samples;
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
            bin_count: scene.bin_count(),
            light_count: scene.light_features().count,
            material_vectors: scene.material_vectors(),
            exposure: self.settings.exposure.exp2(),
            footprint: footprints.centre,
            place_footprint: footprints.place,
            sample_footprint: footprints.sample,
            side: 1,
            ..FrameUniform::with_room(self.resources.sizes())
        }
    }
}

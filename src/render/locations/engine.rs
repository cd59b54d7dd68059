//! The passes and memory that sample locations: the engine of superpixels with the caller's cells in the place of pixels.

use super::plan::LocationPlan;
use crate::passes::{
    Cells, Content, Counter, FrameGeometry, FrameLayout, FrameLook, ListLength, ListedLocation,
    Offsets, RasterTargets, Resources, SampleOptions, Shade, ShadeSource, Stroke, StrokeSizes,
};
use crate::render::frame::recording::SceneShading;
use crate::render::list::{ListEngine, ListKind};
use crate::render::plan::Capacity;
use crate::render::plane::Window;
use crate::render::renderer::PreparedScene;
use crate::render::shadows::{ShadowEngine, Shadowed, Sight};
use crate::render::statistics::Shortfall;
use crate::render::{PassTime, RenderError, Settings, Statistics};
use crate::vulkan::{Buffer, Memory, MemoryUse, Recorder, Timings, VulkanError};
use ash::vk;
use std::sync::Arc;

/// What the engine of lists is made for, where places have so many words of shadows; `apart` says whether a subgroup samples one cell at a time.
pub(super) fn kind(cells: Cells, shadow_words: u32, apart: bool) -> ListKind {
    let Capacity {
        layers, unlisted, ..
    } = Capacity::default();
    ListKind {
        cells,
        attributes: cells == Cells::Points,
        shadow_words,
        lent: false,
        apart,
        unlisted,
        layers,
    }
}

/// Pipelines and memory to sample runs of locations of one scene.
pub(super) struct LocationEngine {
    settings: Settings,
    rounds: u32,
    stroke: Option<Stroke>,
    engine: ListEngine,
    shade: Shade,
    shadows: Option<ShadowEngine>,
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
    pub colors: &'a [[f32; 4]],
    /// What `shaders/points.comp` wrote; nothing for superpixels.
    pub attributes: &'a [[[u32; 4]; 2]],
}

impl LocationEngine {
    /// Makes the pipelines, and memory for the runs of a plan.
    pub fn new(
        layout: &Arc<FrameLayout>,
        prepared: &PreparedScene,
        settings: &Settings,
        plan: &LocationPlan,
        apart: bool,
    ) -> Result<Self, RenderError> {
        let LocationPlan {
            cells,
            places,
            sizes,
            ..
        } = plan;
        let scene = &*prepared.gpu_scene;
        let gpu = scene.memory().gpu().clone();
        let taken = prepared.memory_bytes();
        let memory = Memory::new(
            gpu.clone(),
            settings.max_memory.map(|limit| limit.saturating_sub(taken)),
        );
        let kind = kind(*cells, sizes.shadow_words, apart);
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
        let source = ShadeSource::Records { cells: *cells };
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
        let shadows = |casters| {
            let shading = (scene, *cells, &resources);
            let capacity = Capacity {
                apart,
                ..Capacity::default()
            };
            ShadowEngine::new(
                layout, &memory, casters, settings, capacity, shading, *places,
            )
        };
        let casters = prepared.casters.as_ref().filter(|_| kind.shadow_words > 0);
        let shadows = casters.map(shadows).transpose()?;
        Ok(Self {
            settings: settings.clone(),
            stroke: scene
                .has_strokes()
                .then(|| Stroke::new(layout))
                .transpose()?,
            shade: Shade::new(layout, scene, (source, kind.shadow_words), &output)?,
            shadows,
            rounds: engine.most_rounds(sizes, scene.index_count()),
            engine,
            geometry,
            resources,
            targets,
            counters: memory.buffer(
                "counter read-back",
                Counter::BYTES,
                vk::BufferUsageFlags::TRANSFER_DST,
                MemoryUse::Readback,
            )?,
            timings: Timings::new(&gpu, 32)?,
            memory,
            uploaded: false,
        })
    }

    /// The list of a run of so many locations, to be written while the device is idle.
    pub fn listed_mut(&mut self, count: usize) -> Result<&mut [ListedLocation], VulkanError> {
        self.resources.listed_mut(count)
    }

    /// Records a run of so many locations, which have been written, in a window of what is seen.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass, for the device and queue family of the renderer.
    /// - `scene` is the one that the engine was made for and its upload was recorded before.
    /// - The commands of the engine's last recording are done: its memory is used again.
    pub unsafe fn record(
        &mut self,
        scene: &PreparedScene,
        sight: &Sight,
        window: &Window,
        count: usize,
        commands: vk::CommandBuffer,
    ) {
        let scene = &*scene.gpu_scene;
        let SampleOptions { cells, samples, .. } = *self.engine.options();
        let (settings, sizes) = (&self.settings, self.resources.sizes());
        let uniform = window.uniform(scene, &sight.pinhole, settings, (cells, samples), sizes);
        let to_clip = window.to_clip(scene, &sight.pinhole);
        self.geometry.place(scene, &to_clip, None);
        let gpu = self.memory.gpu().clone();
        // SAFETY: passed on to the caller.
        let mut recorder = unsafe { Recorder::new(&gpu, commands, Some(&mut self.timings)) };
        let recorder = &mut recorder;
        let resources = &self.resources;
        if !self.uploaded {
            self.geometry.record_upload(recorder, scene);
            resources.record_upload(recorder);
            self.targets.record_unused(recorder);
            if let Some(shadows) = &self.shadows {
                shadows.record_upload(recorder);
            }
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
        if let Some(shadows) = &mut self.shadows {
            shadows.record_begin(recorder);
        }
        let region = window.region(count);
        let engine = &self.engine;
        engine.record_candidates(recorder, (resources, set), &region, ListLength::Known);
        let views = self.shadows.as_ref().map(|shadows| shadows.views(sight));
        let views = views.unwrap_or_default();
        let shadowed = Shadowed {
            resources,
            set,
            size: [0; 2],
            views: &views,
        };
        let shading = SceneShading {
            scene,
            shade: Some(&self.shade),
            shadows: self.shadows.as_ref().map(|shadows| (shadows, shadowed)),
        };
        resources.record_rounds(recorder, self.rounds, |recorder| {
            engine.record_round(recorder, resources);
            engine.record_values(recorder, resources, &shading);
        });
        if let Some(shadows) = &self.shadows {
            shadows.record_end(recorder);
        }
        resources.record_keep_counters(recorder, &self.counters, 0);
        recorder.barrier();
    }

    /// What the last run's `locations` locations saw.
    pub fn values(&self, locations: usize) -> Result<LocationValues<'_>, VulkanError> {
        let Resources {
            color, attributes, ..
        } = &self.resources;
        Ok(LocationValues {
            colors: color.buffer.read(locations)?,
            attributes: match self.resources.sizes().attributes {
                true => attributes.read(locations)?,
                false => &[],
            },
        })
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
        if let Some(shadows) = &self.shadows {
            shadows.add_shortfall(&mut shortfall)?;
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
}

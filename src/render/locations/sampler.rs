//! Passes and memory that sample locations: the engine's sampler with the caller's cells instead of pixels.

use super::ListSettings;
use super::plan::LocationPlan;
use super::run::{ListRun, RunMemory};
use crate::engine::data::{Cells, Data, ListedLocation, Offsets};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::sampler::{ListCells, Sampler, SamplerRun, Shortfall};
use crate::engine::spirv::SPREAD_VECTORS;
use crate::render::frame::recording::SceneShading;
use crate::render::passes::{ShadeSource, merge, shade};
use crate::render::plane::PlaneWindow;
use crate::render::renderer::PreparedScene;
use crate::render::shadows::{ShadowFinder, Shadowed, Sight};
use crate::render::{RenderError, Statistics};
use crate::sampling::Bend;
use crate::vulkan::{PassTime, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Cells of a list with `shadow_words` words of shadows for each place, whose `spread` is stored for a pixel filter.
pub(super) fn list_cells(cells: Cells, shadow_words: u32, spread: Option<Bend>) -> ListCells {
    ListCells { cells, attributes: cells == Cells::Points, shadow_words, lent: false, spread }
}

/// Pipelines and memory for sampling runs of locations of one scene.
pub(super) struct LocationSampler {
    cells: Cells,
    sampler: Sampler,
    /// Merging and sorting of visibility samples.
    merge: Option<Pass>,
    shade: Pass,
    shadows: Option<ShadowFinder>,
    run: RunMemory,
}

/// Values at the locations of a run, in their order.
pub(super) struct LocationValues<'a> {
    pub colors: &'a [[f32; 4]],
    /// Output of `shaders/points.comp`; empty for superpixels.
    pub attributes: &'a [[[u32; 4]; 2]],
    /// How the light of superpixels is spread over their cells; empty without a pixel filter.
    pub spreads: &'a [CellSpread],
}

/// How the light of a superpixel is spread over its cell; `shaders/include/spread.glsl` has the layout.
pub(super) type CellSpread = [[u32; 4]; SPREAD_VECTORS as usize];

impl LocationSampler {
    /// Makes the pipelines, and memory for the runs of a plan.
    pub fn new(
        layout: &Arc<FrameLayout>,
        prepared: &PreparedScene,
        settings: &ListSettings,
        plan: &LocationPlan,
    ) -> Result<Self, RenderError> {
        let LocationPlan { cells, places, sizes, capacity, .. } = plan;
        let scene = &*prepared.gpu_scene;
        let listed = list_cells(*cells, sizes.shadow_words, settings.spread);
        let (offsets, count) = listed.offsets(layout, &settings.sampler.cells)?;
        let offsets = Offsets { all: &offsets, count };
        let run = RunMemory::new(layout, prepared, settings, plan, offsets)?;
        let (job, resources) = (&run.job, run.job.resources());
        let context = job.context(scene, 1);
        let merged = settings.sampler.merged;
        let source = ShadeSource::Fragments { cells: *cells, merged: merged.is_some() };
        // SAFETY: the list lives as long as the resources, and has room for that many locations.
        let sampler = unsafe { listed.sampler(&context, resources, resources.texels(Data::Locations)) }?;
        let shadows = |casters| {
            let request = settings.shadows(layout, casters, *capacity, *places);
            ShadowFinder::new(&request, job.memory(), scene, *cells, resources)
        };
        let casters = prepared.casters.as_ref().filter(|_| sizes.shadow_words > 0);
        let shadows = casters.map(shadows).transpose()?;
        let merge = |rate| merge::pass(layout, scene, resources, &sampler.blocks(), rate);
        Ok(Self {
            merge: merged.map(merge).transpose()?,
            shade: shade::pass(layout, scene, source, sizes.shadow_words, &context.output)?,
            shadows,
            cells: *cells,
            sampler,
            run,
        })
    }

    /// Memory for a run of `count` locations, to be written while the device is idle.
    pub fn listed_mut(&mut self, count: usize) -> Result<&mut [ListedLocation], VulkanError> {
        self.run.job.resources_mut().listed_mut(count)
    }

    /// Records the sampling of a run of `count` locations in a window of the plane. The locations must have been
    /// written before.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass, for the device and queue family of the renderer.
    /// - `scene` is the one for which the sampler was made, and its upload was recorded before.
    /// - The commands of the last recording have run: its memory is used again.
    pub unsafe fn record(
        &mut self,
        scene: &PreparedScene,
        sight: &Sight,
        window: &PlaneWindow,
        count: usize,
        commands: vk::CommandBuffer,
    ) {
        let Self { cells, sampler, merge, shade, shadows, run } = self;
        let settings = run.job.settings().clone();
        let background = settings.background_rgba();
        let listed = ListRun {
            pinhole: &sight.pinhole,
            window,
            cells: *cells,
            samples: sampler.samples(),
            locations: count as u32,
        };
        let record = |recorder: &Recorder<'_>, list: &SamplerRun<'_>, uploads: bool| {
            let SamplerRun { resources, set, .. } = *list;
            if let Some(shadows) = shadows.as_mut() {
                if uploads {
                    shadows.record_upload(recorder);
                }
                shadows.record_begin(recorder);
            }
            if *cells == Cells::Points {
                let code = settings.output_code(background);
                recorder.section(PassTime::BACKGROUND, || {
                    resources.record_background(recorder, count as u32, background, code);
                });
            }
            let views = shadows.as_ref().map(|shadows| shadows.views(sight));
            let views = views.unwrap_or_default();
            if let Some(shadows) = &*shadows {
                shadows.record_planes(recorder, &views, set);
            }
            let shadowed = Shadowed { resources, set, size: [0; 2], views: &views };
            let shading = SceneShading {
                shade: Some(shade),
                shadows: shadows.as_ref().map(|shadows| (shadows, shadowed)),
                merge: merge.as_ref(),
            };
            sampler.record(recorder, list, &shading);
            if let Some(shadows) = shadows {
                shadows.record_end(recorder);
            }
        };
        // SAFETY: guaranteed by the caller.
        unsafe { run.record(scene, &listed, commands, record) };
    }

    /// Values at the `locations` locations of the last run.
    pub fn values(&self, locations: usize) -> Result<LocationValues<'_>, VulkanError> {
        let resources = self.run.job.resources();
        Ok(LocationValues {
            colors: resources.buffer(Data::Color).read(locations)?,
            attributes: match resources.sizes().attributes {
                true => resources.buffer(Data::Attributes).read(locations)?,
                false => &[],
            },
            spreads: match resources.sizes().spreads {
                true => resources.buffer(Data::Spreads).read(locations)?,
                false => &[],
            },
        })
    }

    /// Work that the last run could not finish.
    pub fn shortfall(&self, window: &PlaneWindow) -> Result<Shortfall, VulkanError> {
        let mut shortfall = self.run.job.shortfall([&self.sampler], &[window.tile_count()])?;
        if let Some(shadows) = &self.shadows {
            shadows.add_shortfall(&mut shortfall)?;
        }
        Ok(shortfall)
    }

    /// Adds the last run to `statistics`.
    ///
    /// # Errors
    /// If its counters or times can't be read.
    pub fn add_statistics(
        &self,
        scene: &PreparedScene,
        window: &PlaneWindow,
        total: &mut Statistics,
    ) -> Result<(), VulkanError> {
        let scene = &scene.gpu_scene;
        let (triangles, of_scene) = (scene.geometry.triangle_count, scene.memory_bytes());
        let tiles = [window.tile_count()];
        total.append(self.run.job.statistics(Some(&self.sampler), &tiles, triangles, of_scene)?);
        Ok(())
    }
}

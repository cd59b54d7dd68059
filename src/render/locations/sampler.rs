//! Passes and memory that sample locations: the engine's sampler with the caller's cells instead of pixels.

use super::ListSettings;
use super::plan::LocationPlan;
use super::run::RunMemory;
use crate::engine::data::{Cells, ListedLocation, Offsets};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::sampler::{ListCells, Sampler, SamplerContext, SamplerRun, SamplerSettings, Shortfall};
use crate::render::frame::recording::SceneShading;
use crate::render::passes::{ShadeSource, shade};
use crate::render::plane::PlaneWindow;
use crate::render::renderer::PreparedScene;
use crate::render::shadows::{ShadowFinder, Shadowed, Sight};
use crate::render::{RenderError, Statistics};
use crate::vulkan::{PassTime, Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Cells of a list with `shadow_words` words of shadows for each place.
pub(super) fn list_cells(cells: Cells, shadow_words: u32) -> ListCells {
    ListCells { cells, attributes: cells == Cells::Points, shadow_words, lent: false }
}

/// Pipelines and memory for sampling runs of locations of one scene.
pub(super) struct LocationSampler {
    cells: Cells,
    settings: SamplerSettings,
    sampler: Sampler,
    shade: Pass,
    shadows: Option<ShadowFinder>,
    run: RunMemory,
}

/// Values at the locations of a run, in their order.
pub(super) struct LocationValues<'a> {
    pub colors: &'a [[f32; 4]],
    /// Output of `shaders/points.comp`; empty for superpixels.
    pub attributes: &'a [[[u32; 4]; 2]],
}

impl LocationSampler {
    /// Makes the pipelines, and memory for the runs of a plan.
    pub fn new(
        layout: &Arc<FrameLayout>,
        prepared: &PreparedScene,
        settings: &ListSettings,
        plan: &LocationPlan,
    ) -> Result<Self, RenderError> {
        let LocationPlan { cells, places, sizes, capacity, .. } = plan;
        let capacity = *capacity;
        let scene = &*prepared.gpu_scene;
        let listed = list_cells(*cells, sizes.shadow_words);
        let (offsets, count) = listed.offsets(layout, &settings.sampler.cells)?;
        let offsets = Offsets { all: &offsets, count };
        let run = RunMemory::new(layout, prepared, settings, *sizes, offsets)?;
        let resources = &run.resources;
        let output = settings.sampler.color_constants(scene);
        let source = ShadeSource::Records { cells: *cells };
        let context = SamplerContext {
            layout,
            memory: &run.memory,
            scene,
            settings: &settings.sampler,
            output: &output,
            sizes,
            capacity,
            runs: 1,
        };
        // SAFETY: the list lives as long as the resources, and has room for that many locations.
        let sampler = unsafe { listed.sampler(&context, (resources, resources.listed()?)) }?;
        let shadows = |casters| {
            let request = settings.shadows(layout, casters, capacity, *places);
            ShadowFinder::new(&request, &run.memory, scene, *cells, resources)
        };
        let casters = prepared.casters.as_ref().filter(|_| sizes.shadow_words > 0);
        let shadows = casters.map(shadows).transpose()?;
        Ok(Self {
            settings: settings.sampler.clone(),
            shade: shade::pass(layout, scene, (source, sizes.shadow_words), &output)?,
            shadows,
            cells: *cells,
            sampler,
            run,
        })
    }

    /// Memory for a run of `count` locations, to be written while the device is idle.
    pub fn listed_mut(&mut self, count: usize) -> Result<&mut [ListedLocation], VulkanError> {
        self.run.listed_mut(count)
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
        let Self { cells, settings, sampler, shade, shadows, run } = self;
        let looking = (&sight.pinhole, window);
        let background = settings.background_rgba();
        let cells = (*cells, sampler.samples());
        let record = |recorder: &Recorder<'_>, list: &SamplerRun<'_>, is_first| {
            let SamplerRun { resources, set, .. } = *list;
            if let Some(shadows) = shadows.as_mut() {
                if is_first {
                    shadows.record_upload(recorder);
                }
                shadows.record_begin(recorder);
            }
            if cells.0 == Cells::Points {
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
            let shading =
                SceneShading { shade: Some(shade), shadows: shadows.as_ref().map(|shadows| (shadows, shadowed)) };
            sampler.record(recorder, list, &shading);
            if let Some(shadows) = shadows {
                shadows.record_end(recorder);
            }
        };
        // SAFETY: guaranteed by the caller.
        unsafe { run.record(scene, looking, (cells, count), commands, record) };
    }

    /// Values at the `locations` locations of the last run.
    pub fn values(&self, locations: usize) -> Result<LocationValues<'_>, VulkanError> {
        let resources = &self.run.resources;
        Ok(LocationValues {
            colors: resources.color.buffer.read(locations)?,
            attributes: match resources.sizes().attributes {
                true => resources.attributes.read(locations)?,
                false => &[],
            },
        })
    }

    /// Work that the last run could not finish.
    pub fn shortfall(&self, window: &PlaneWindow) -> Result<Shortfall, VulkanError> {
        let mut shortfall = Shortfall::default();
        self.sampler.add_shortfall([window.tile_count()], &mut shortfall)?;
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
        self.sampler.add_statistics([window.tile_count()], total)?;
        total.regions += 1;
        self.run.add_statistics(scene, total)
    }
}

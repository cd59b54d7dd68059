//! The passes and memory that sample locations: the engine of superpixels with the caller's cells in the place of pixels.

use super::plan::LocationPlan;
use super::run::RunMemory;
use crate::engine::sampler::plan::Capacity;
use crate::engine::sampler::statistics::Shortfall;
use crate::engine::sampler::{ListCells, Sampler, SamplerContext, SamplerRun};
use crate::passes::{Cells, FrameLayout, ListedLocation, Offsets, Resources};
use crate::render::frame::recording::SceneShading;
use crate::render::passes::{Shade, ShadeSource};
use crate::render::plane::Window;
use crate::render::renderer::PreparedScene;
use crate::render::shadows::{ShadowFinder, Shadowed, Sight};
use crate::render::{RenderError, Settings, Statistics};
use crate::vulkan::{Recorder, VulkanError};
use ash::vk;
use std::sync::Arc;

/// The cells of a list, where places have so many words of shadows.
pub(super) fn list_cells(cells: Cells, shadow_words: u32) -> ListCells {
    ListCells {
        cells,
        attributes: cells == Cells::Points,
        shadow_words,
        lent: false,
    }
}

/// Pipelines and memory to sample runs of locations of one scene.
pub(super) struct LocationSampler {
    cells: Cells,
    settings: Settings,
    sampler: Sampler,
    shade: Shade,
    shadows: Option<ShadowFinder>,
    run: RunMemory,
}

/// What the locations of a run saw, in their order.
pub(super) struct LocationValues<'a> {
    pub colors: &'a [[f32; 4]],
    /// What `shaders/points.comp` wrote; nothing for superpixels.
    pub attributes: &'a [[[u32; 4]; 2]],
}

impl LocationSampler {
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
        let capacity = Capacity {
            apart,
            ..Capacity::default()
        };
        let listed = list_cells(*cells, sizes.shadow_words);
        let (offsets, count) = listed.offsets(layout, settings)?;
        let offsets = Offsets {
            all: &offsets,
            count,
        };
        let run = RunMemory::new(layout, prepared, settings, *sizes, offsets, 32)?;
        let resources = &run.resources;
        let output = settings.color_constants(scene);
        let source = ShadeSource::Records { cells: *cells };
        let context = SamplerContext {
            layout,
            memory: &run.memory,
            scene,
            settings,
            output: &output,
            sizes,
            capacity,
            runs: 1,
        };
        // SAFETY: the list goes with the resources, and has room for as many locations.
        let sampler = unsafe { listed.sampler(&context, (resources, resources.listed()?)) }?;
        let shadows = |casters| {
            let shading = (scene, *cells, resources);
            ShadowFinder::new(
                layout,
                &run.memory,
                casters,
                settings,
                capacity,
                shading,
                *places,
            )
        };
        let casters = prepared.casters.as_ref().filter(|_| sizes.shadow_words > 0);
        let shadows = casters.map(shadows).transpose()?;
        Ok(Self {
            settings: settings.clone(),
            shade: Shade::new(layout, scene, (source, sizes.shadow_words), &output)?,
            shadows,
            cells: *cells,
            sampler,
            run,
        })
    }

    /// The list of a run of so many locations, to be written while the device is idle.
    pub fn listed_mut(&mut self, count: usize) -> Result<&mut [ListedLocation], VulkanError> {
        self.run.listed_mut(count)
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
        let Self {
            cells,
            settings,
            sampler,
            shade,
            shadows,
            run,
        } = self;
        let looking = (&sight.pinhole, window);
        let background = settings.background_rgba();
        let cells = (*cells, sampler.samples());
        let record = |recorder: &mut Recorder<'_>, list: &SamplerRun<'_>, is_first| {
            let SamplerRun { resources, set, .. } = *list;
            if let Some(shadows) = shadows.as_mut() {
                if is_first {
                    shadows.record_upload(recorder);
                    recorder.barrier();
                }
                shadows.record_begin(recorder);
            }
            if cells.0 == Cells::Points {
                let code = settings.output_code(background);
                resources.record_background(recorder, count as u32, background, code);
                recorder.mark("background");
            }
            let views = shadows.as_ref().map(|shadows| shadows.views(sight));
            let views = views.unwrap_or_default();
            let shadowed = Shadowed {
                resources,
                set,
                size: [0; 2],
                views: &views,
            };
            let shading = SceneShading {
                scene: &scene.gpu_scene,
                shade: Some(shade),
                shadows: shadows.as_ref().map(|shadows| (shadows, shadowed)),
            };
            sampler.record(recorder, list, &shading);
            if let Some(shadows) = shadows {
                shadows.record_end(recorder);
            }
        };
        // SAFETY: passed on to the caller.
        unsafe { run.record(scene, looking, (cells, count), commands, record) };
    }

    /// What the last run's `locations` locations saw.
    pub fn values(&self, locations: usize) -> Result<LocationValues<'_>, VulkanError> {
        let Resources {
            color, attributes, ..
        } = &self.run.resources;
        Ok(LocationValues {
            colors: color.buffer.read(locations)?,
            attributes: match self.run.resources.sizes().attributes {
                true => attributes.read(locations)?,
                false => &[],
            },
        })
    }

    /// What the last run could not finish.
    fn shortfall(&self, window: &Window) -> Result<Shortfall, VulkanError> {
        let mut shortfall = Shortfall::default();
        self.sampler
            .add_shortfall([window.tile_count()], &mut shortfall)?;
        if let Some(shadows) = &self.shadows {
            shadows.add_shortfall(&mut shortfall)?;
        }
        Ok(shortfall)
    }

    /// Whether cells of the last run, or tiles of a light, have longer lists than kernels walk that take several cells at a time.
    pub fn has_long_lists(&self, window: &Window) -> Result<bool, VulkanError> {
        let shortfall = self.shortfall(window)?;
        Ok(shortfall.stalled + shortfall.unshadowed > 0)
    }

    /// Fails where records of the last run did not fit, or lists were too long.
    ///
    /// # Errors
    /// [`RenderError::Unfinished`], or [`RenderError::Vulkan`] if what was counted can't be read.
    pub fn check(&self, window: &Window) -> Result<(), RenderError> {
        self.shortfall(window)?
            .check(self.run.resources.sizes().lanes)
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
        self.sampler.add_statistics([window.tile_count()], total)?;
        total.regions += 1;
        self.run.add_statistics(scene, total)
    }
}

//! What all runs over locations have in common: geometry as the window sees it, memory, counters and times.

use super::ListSettings;
use crate::camera::Pinhole;
use crate::engine::data::{Cells, Content, ListedLocation, Offsets, ResourceSizes, Resources};
use crate::engine::passes::RasterTargets;
use crate::engine::pipelines::FrameLayout;
use crate::engine::sampler::SamplerRun;
use crate::render::data::{FrameGeometry, FrameLook};
use crate::render::passes::{StrokePass, StrokeSizes};
use crate::render::plane::PlaneWindow;
use crate::render::{PreparedScene, RenderError, Statistics};
use crate::vulkan::{Memory, Recorder, Timings, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Memory for runs over locations of one scene.
pub(super) struct RunMemory {
    pub resources: Resources,
    pub memory: Memory,
    settings: ListSettings,
    stroke: Option<StrokePass>,
    geometry: FrameGeometry,
    targets: RasterTargets,
    timings: Timings,
    uploaded: bool,
}

impl RunMemory {
    /// Allocates the memory. `offsets` are those of a cell's samples.
    pub fn new(
        layout: &Arc<FrameLayout>,
        prepared: &PreparedScene,
        settings: &ListSettings,
        sizes: ResourceSizes,
        offsets: Offsets<'_>,
    ) -> Result<Self, RenderError> {
        let scene = &*prepared.gpu_scene;
        let gpu = scene.memory().gpu().clone();
        let taken = prepared.memory_bytes();
        let memory = Memory::new(gpu.clone(), settings.scene.max_memory.map(|limit| limit.saturating_sub(taken)));
        let targets = RasterTargets::new(&memory, 1, 1, vk::SampleCountFlags::TYPE_1, scene.has_blend())?;
        let geometry = FrameGeometry::new(&memory, scene, false)?;
        let look = FrameLook::default();
        let mut shown = geometry.shown(scene);
        shown.extend(look.shown(scene));
        let resources = Resources::new(layout, &memory, scene, &shown, &targets.views(), sizes, &[offsets])?;
        Ok(Self {
            resources,
            settings: settings.clone(),
            stroke: scene.has_strokes().then(|| StrokePass::new(layout)).transpose()?,
            geometry,
            targets,
            timings: Timings::new(&gpu).with_repetitions(settings.scene.time_rounds),
            memory,
            uploaded: false,
        })
    }

    /// Records a run over `count` locations in a window of a pinhole's plane. The locations are `cells` with a number
    /// of samples each. `record` adds its passes between the beginning and the end that all runs share, and is told
    /// whether this is the first run.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass, for the device and queue family of the renderer.
    /// - `scene` is the one for which this was made, and its upload was recorded before.
    /// - The commands of the last recording have run: its memory is used again.
    pub unsafe fn record(
        &mut self,
        scene: &PreparedScene,
        (pinhole, window): (&Pinhole, &PlaneWindow),
        (cells, count): ((Cells, u32), usize),
        commands: vk::CommandBuffer,
        record: impl FnOnce(&Recorder<'_>, &SamplerRun<'_>, bool),
    ) {
        let scene = &*scene.gpu_scene;
        let (settings, resources) = (&self.settings, &self.resources);
        let Some(set) = resources.set(0) else {
            return;
        };
        let sizes = resources.sizes();
        let uniform = window.uniform(scene, pinhole, &settings.sampler, cells, sizes);
        let to_clip = window.to_clip(scene, pinhole);
        self.geometry.place(scene, &to_clip, None);
        let gpu = self.memory.gpu().clone();
        // SAFETY: guaranteed by the caller.
        let recorder = unsafe { Recorder::new(&gpu, commands, Some(&mut self.timings)) };
        let recorder = &recorder;
        let is_first = !self.uploaded;
        if is_first {
            self.geometry.record_upload(recorder, scene);
            resources.record_upload(recorder);
            self.targets.record_unused(recorder);
            self.uploaded = true;
        }
        recorder.begin();
        resources.record_begin(recorder, set, &uniform);
        if let Some(stroke) = &self.stroke {
            let sizes = StrokeSizes::new(&settings.scene, 1);
            stroke.record(recorder, scene, &self.geometry, &to_clip, sizes);
        }
        let run = SamplerRun { resources, set, uniform: &uniform, locations: count as u32, index: 0 };
        record(recorder, &run, is_first);
    }

    /// Memory for a run of `count` locations, to be written while the device is idle.
    pub fn listed_mut(&mut self, count: usize) -> Result<&mut [ListedLocation], VulkanError> {
        self.resources.listed_mut(count)
    }

    /// Adds the times of the last run's passes and the size of the memory to `statistics`.
    pub fn add_statistics(&self, scene: &PreparedScene, total: &mut Statistics) -> Result<(), VulkanError> {
        let scene = &scene.gpu_scene;
        total.triangles.total = scene.triangle_count();
        total.memory_bytes = total.memory_bytes.max(self.memory.used() + scene.memory_bytes());
        for time in self.timings.read()? {
            total.add_time(time);
        }
        Ok(())
    }
}

//! What all runs over locations have in common: geometry as the window sees it, memory, counters and times.

use super::ListSettings;
use super::plan::LocationPlan;
use crate::camera::Pinhole;
use crate::engine::data::{Cells, Offsets, ResourceRequest, ShownIds};
use crate::engine::pipelines::FrameLayout;
use crate::engine::sampler::{Job, JobRecording, SamplerRun};
use crate::render::data::{FrameGeometry, FrameLook};
use crate::render::passes::{StrokePass, StrokeSizes};
use crate::render::plane::PlaneWindow;
use crate::render::{PreparedScene, RenderError};
use crate::vulkan::{Memory, Recorder};
use ash::vk;
use std::sync::Arc;

/// A run of cells of one kind.
#[derive(Clone, Copy)]
pub(super) struct ListRun<'a> {
    pub pinhole: &'a Pinhole,
    /// Window of the pinhole's plane in which the locations lie.
    pub window: &'a PlaneWindow,
    pub cells: Cells,
    /// Number of samples of a cell.
    pub samples: u32,
    /// Number of locations.
    pub locations: u32,
}

/// Memory for runs over locations of one scene.
pub(super) struct RunMemory {
    pub job: Job,
    settings: ListSettings,
    stroke: Option<StrokePass>,
    geometry: FrameGeometry,
}

impl RunMemory {
    /// Allocates the memory for runs of a plan. `offsets` are those of a cell's samples.
    pub fn new(
        layout: &Arc<FrameLayout>,
        prepared: &PreparedScene,
        settings: &ListSettings,
        plan: &LocationPlan,
        offsets: Offsets<'_>,
    ) -> Result<Self, RenderError> {
        let scene = &*prepared.gpu_scene;
        let taken = prepared.memory_bytes();
        let memory =
            Memory::new(layout.gpu.clone(), settings.scene.max_memory.map(|limit| limit.saturating_sub(taken)));
        let geometry = FrameGeometry::new(&memory, scene, false)?;
        let look = FrameLook::default();
        let mut shown = geometry.shown(scene);
        shown.extend(look.shown(scene));
        let request = ResourceRequest {
            sizes: plan.sizes,
            others: &shown,
            ids: ShownIds::Unread,
            offsets: &[offsets],
            scratch: None,
        };
        let job = Job::new(layout, memory, &settings.sampler, plan.capacity, &request)?;
        Ok(Self {
            job: job.with_repetitions(settings.scene.time_rounds),
            settings: settings.clone(),
            stroke: scene.has_strokes().then(|| StrokePass::new(layout)).transpose()?,
            geometry,
        })
    }

    /// Records a run of cells of a kind with a number of samples each, over `count` locations in a window of a pinhole's plane.
    /// `record` records its passes, and is told whether copies to the device that they need have to be recorded too.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass, for the device and queue family of the renderer.
    /// - `scene` is the one for which this was made, and its upload was recorded before.
    /// - The commands of the last recording have run: its memory is used again.
    pub unsafe fn record(
        &mut self,
        scene: &PreparedScene,
        run: &ListRun<'_>,
        commands: vk::CommandBuffer,
        record: impl FnOnce(&Recorder<'_>, &SamplerRun<'_>, bool),
    ) {
        let scene = &*scene.gpu_scene;
        let ListRun { pinhole, window, cells, samples, locations } = *run;
        let to_clip = window.to_clip(scene, pinhole);
        self.geometry.place(scene, &to_clip, None);
        let mut uploads = false;
        let upload = |recorder: &Recorder<'_>| {
            self.geometry.record_upload(recorder, scene);
            uploads = true;
        };
        // SAFETY: guaranteed by the caller.
        let recording = unsafe { self.job.begin(commands, upload) };
        let JobRecording { recorder, resources, settings, .. } = &recording;
        let Some(set) = resources.set(0) else {
            return;
        };
        let uniform = window.uniform(scene, pinhole, settings, cells, samples, resources.sizes());
        recorder.begin();
        resources.record_begin(recorder, set, &uniform);
        if let Some(stroke) = &self.stroke {
            let sizes = StrokeSizes::new(&self.settings.scene, 1);
            stroke.record(recorder, scene, &self.geometry, &to_clip, sizes);
        }
        record(recorder, &SamplerRun { resources, set, uniform: &uniform, locations, index: 0 }, uploads);
        recording.end();
    }
}

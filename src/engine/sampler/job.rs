//! Jobs: memory of passes and the state of their recordings, which all clients of the passes have in common.

use super::{Capacity, Sampler, SamplerContext, SamplerSettings, Shortfall, Statistics};
use crate::engine::data::{Content, ResourceRequest, Resources};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Completion, Memory, Recorder, Timings, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Memory of the passes of a frame or list, and the state of its recordings. A client records its passes between
/// [`Self::begin`] and [`JobRecording::end`].
pub(crate) struct Job {
    layout: Arc<FrameLayout>,
    settings: SamplerSettings,
    capacity: Capacity,
    resources: Resources,
    timings: Timings,
    completion: Completion,
    /// Whether the device has executed a recording with the uploads.
    is_uploaded: bool,
    memory: Memory,
}

/// Recording of a job's commands, and the parts of the job that these need.
pub(crate) struct JobRecording<'a> {
    pub recorder: Recorder<'a>,
    pub resources: &'a Resources,
    pub settings: &'a SamplerSettings,
    completion: &'a Completion,
}

impl Job {
    /// Allocates memory for a recording with this capacity.
    ///
    /// # Errors
    /// If memory runs out or a buffer exceeds a limit of the device.
    pub fn new(
        layout: &Arc<FrameLayout>,
        memory: Memory,
        settings: &SamplerSettings,
        capacity: Capacity,
        request: &ResourceRequest<'_>,
    ) -> Result<Self, VulkanError> {
        Ok(Self {
            layout: layout.clone(),
            settings: settings.clone(),
            capacity,
            resources: Resources::new(layout, &memory, request)?,
            timings: Timings::new(memory.gpu()),
            completion: Completion::new(memory.gpu())?,
            is_uploaded: false,
            memory,
        })
    }

    /// This job, which times rounds one by one if that is `wanted`.
    pub fn with_repetitions(mut self, wanted: bool) -> Self {
        self.timings = self.timings.with_repetitions(wanted);
        self
    }

    /// Arguments for samplers that work in this memory, of a scene. A recording has `runs` runs.
    pub fn context<'a>(&'a self, scene: &'a dyn Content, runs: usize) -> SamplerContext<'a> {
        SamplerContext {
            layout: &self.layout,
            memory: &self.memory,
            scene,
            settings: &self.settings,
            output: self.settings.color_constants(scene),
            sizes: self.resources.sizes(),
            capacity: self.capacity,
            runs,
        }
    }

    pub fn settings(&self) -> &SamplerSettings {
        &self.settings
    }

    pub fn resources(&self) -> &Resources {
        &self.resources
    }

    /// The resources, for the host to write while the device is idle.
    pub fn resources_mut(&mut self) -> &mut Resources {
        &mut self.resources
    }

    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    /// Capacity with which the memory was planned.
    pub fn capacity(&self) -> Capacity {
        self.capacity
    }

    /// Begins a recording. `upload` records copies to the device in addition to those of the resources. Copies are recorded
    /// again until the device has executed a recording with them.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass and of conditional rendering, for the device and queue
    ///   family of the layout.
    /// - The commands of the last recording have run, or will never be executed: its memory is used again.
    /// - The job, and all that is recorded, outlive the execution of the commands.
    pub unsafe fn begin(
        &mut self,
        commands: vk::CommandBuffer,
        upload: impl FnOnce(&Recorder<'_>),
    ) -> JobRecording<'_> {
        // SAFETY: passed on to the caller.
        let recorder = unsafe { Recorder::new(self.memory.gpu(), commands, Some(&mut self.timings)) };
        self.is_uploaded |= self.completion.begin(&recorder);
        if !self.is_uploaded {
            self.resources.record_upload(&recorder);
            upload(&recorder);
        }
        let Self { resources, settings, completion, .. } = self;
        JobRecording { recorder, resources, settings, completion }
    }

    /// Continues a recording in another command buffer.
    ///
    /// # Safety
    /// As [`Self::begin`]; and the commands are executed after those that were recorded before.
    pub unsafe fn go_on(&mut self, commands: vk::CommandBuffer) -> JobRecording<'_> {
        let Self { resources, settings, completion, timings, memory, .. } = self;
        // SAFETY: passed on to the caller.
        let recorder = unsafe { Recorder::new(memory.gpu(), commands, Some(timings)) };
        JobRecording { recorder, resources, settings, completion }
    }

    /// Checks that the device has executed the last recording, without waiting.
    ///
    /// # Errors
    /// [`VulkanError::NotRecorded`] if there was none, [`VulkanError::NotDone`] if the commands have not run, or
    /// [`VulkanError::DeviceLost`].
    pub fn check(&self) -> Result<(), VulkanError> {
        self.completion.check()
    }

    /// Work that `samplers` could not finish in the last recording, whose runs have these numbers of `tiles`.
    ///
    /// # Errors
    /// If the commands are not done, or counters can't be read.
    pub fn shortfall<'a>(
        &self,
        samplers: impl IntoIterator<Item = &'a Sampler>,
        tiles: &[u32],
    ) -> Result<Shortfall, VulkanError> {
        self.check()?;
        let mut shortfall = Shortfall::default();
        for sampler in samplers {
            sampler.add_shortfall(tiles.iter().copied(), &mut shortfall)?;
        }
        Ok(shortfall)
    }

    /// Statistics of the last recording, of a scene with this number of triangles: of `sampler`, whose runs have these numbers
    /// of `tiles`, and the times of all passes. `beside` is the number of bytes of other memory.
    ///
    /// # Errors
    /// If the commands are not done, or counters or times can't be read.
    pub fn statistics(
        &self,
        sampler: Option<&Sampler>,
        tiles: &[u32],
        triangles: u64,
        beside: u64,
    ) -> Result<Statistics, VulkanError> {
        self.check()?;
        let mut statistics = Statistics { memory_bytes: self.memory.used() + beside, ..Statistics::default() };
        statistics.triangles.total = triangles;
        if let Some(sampler) = sampler {
            statistics.regions = tiles.len() as u64;
            sampler.add_statistics(tiles.iter().copied(), &mut statistics)?;
        }
        for time in self.timings.read()? {
            statistics.add_time(time);
        }
        Ok(statistics)
    }
}

impl JobRecording<'_> {
    /// Ends the recording: once the commands have run, the CPU may read their results.
    pub fn end(self) {
        self.completion.end(&self.recorder);
    }
}

//! What a host lends, on the device: its triangles as passes read them, and what its shaders see of them.

use super::adoption::Adoption;
use super::alpha::AlphaReading;
use super::content::HostContent;
use super::draw::PlacedDraws;
use super::shading::{HostShading, ShadeSamples, VisibilitySamples};
use super::viewport::ClipPlane;
use super::{Geometry, HostError, Shared};
use crate::engine::data::{
    ResourceSizes, Resources, SampleSet, VisibilityUniform, VisibleGeometry,
};
use crate::engine::pipelines::OwnSet;
use crate::engine::sampler::Sampler;
use crate::engine::sampler::statistics::Shortfall;
use crate::engine::sampler::{EngineError, PassTime, Statistics};
use crate::vulkan::{Buffer, Completion, Memory, MemoryUse, Recorder, Timings};
use ash::vk;
use std::sync::Arc;

/// A host's geometry, as frames and lists have it.
pub(super) struct Lending {
    pub geometry: Geometry,
    pub content: HostContent,
    alpha: AlphaReading,
    adoption: Adoption,
    visibility: Buffer,
    completion: Completion,
    /// Whether a recording in which alpha maps are read was executed.
    has_alpha: bool,
    memory: Memory,
    /// Triangles of the last recording.
    triangles: u32,
}

impl Lending {
    /// # Safety
    /// The host's buffers and views are as [`Geometry`] says and outlive this.
    pub unsafe fn new(
        shared: &Arc<Shared>,
        memory: Memory,
        geometry: &Geometry,
    ) -> Result<Self, HostError> {
        // SAFETY: passed on to the caller.
        let content = unsafe { HostContent::new(&shared.gpu, &memory, geometry) }?;
        // SAFETY: passed on to the caller.
        let alpha = unsafe { AlphaReading::new(shared, geometry, &content) }?;
        // SAFETY: passed on to the caller.
        let adoption = unsafe { Adoption::new(shared, &memory, geometry, &content) }?;
        let visibility = memory.buffer(
            "visibility uniform",
            size_of::<VisibilityUniform>() as u64,
            vk::BufferUsageFlags::UNIFORM_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
            MemoryUse::Device,
        )?;
        Ok(Self {
            geometry: geometry.clone(),
            content,
            alpha,
            adoption,
            visibility,
            completion: Completion::new(&shared.gpu)?,
            has_alpha: false,
            memory,
            triangles: 0,
        })
    }

    /// The set that the host's shaders read, with the locations of a list where there are any.
    ///
    /// # Safety
    /// The buffer of locations outlives the set's use.
    pub unsafe fn visibility_set(
        &self,
        shared: &Shared,
        resources: &Resources,
        locations: Option<vk::DescriptorBufferInfo>,
    ) -> Result<OwnSet, HostError> {
        let visible = VisibleGeometry {
            triangles: self.content.triangles(),
            positions: self.content.positions_info(),
            draws: &self.adoption.draws,
            draw_of: self.content.draw_of(),
            locations,
        };
        // SAFETY: of locations as the caller says; the rest goes with this.
        Ok(unsafe { resources.visibility_set(&shared.visibility, &self.visibility, &visible) }?)
    }

    /// Begins a recording; `upload` records what is copied to the device, in each until one was executed, as `is_uploaded` says
    /// from then on.
    pub fn record_begin(
        &mut self,
        recorder: &Recorder<'_>,
        triangles: u32,
        is_uploaded: &mut bool,
        upload: impl FnOnce(&Recorder<'_>),
    ) {
        self.triangles = triangles;
        let was_executed = self.completion.begin(recorder);
        *is_uploaded |= was_executed;
        self.has_alpha |= was_executed;
        if !*is_uploaded {
            upload(recorder);
        }
        recorder.begin();
        if !self.has_alpha {
            self.alpha.record(recorder, &self.content);
        }
    }

    /// Forgets the last recording, whose commands are done or will never be executed.
    pub fn forget_recording(&mut self) {
        self.has_alpha |= self.completion.forget();
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> u64 {
        self.memory.used()
    }

    /// Ends a recording.
    pub fn record_end(&self, recorder: &Recorder<'_>) {
        self.completion.end(recorder);
    }

    /// Refuses to read what the last recording wrote before its commands are done.
    pub fn check_done(&self) -> Result<(), HostError> {
        Ok(self.completion.check()?)
    }

    /// Records positions in clip space and triangles.
    pub fn record_triangles(&self, recorder: &Recorder<'_>, placed: &PlacedDraws) {
        self.adoption.record(recorder, placed);
    }

    /// What the host's shaders are told, who filter textures over squares of this side, in what places say or, with `boxes`,
    /// in what these say of rectangles.
    pub fn visible(plane: &ClipPlane, place_side: f32, boxes: bool) -> VisibilityUniform {
        VisibilityUniform {
            scale: plane.scale,
            middle: plane.middle.map(|at| at as f32),
            place_side,
            r#box: u32::from(boxes),
            ..VisibilityUniform::default()
        }
    }

    /// Records what the host's shaders are told from here on.
    pub fn record_visible(&self, recorder: &Recorder<'_>, visible: &VisibilityUniform) {
        recorder.update(&self.visibility, 0, bytemuck::bytes_of(visible));
    }

    /// The host's materials as the engine calls them.
    pub fn shading<'a>(
        &self,
        shading: &'a dyn ShadeSamples,
        visibility_set: &OwnSet,
        (resources, set): (&Resources, &'a SampleSet),
    ) -> HostShading<'a> {
        HostShading {
            shading,
            samples: VisibilitySamples {
                set: visibility_set.set.raw,
                arguments: resources.arguments.handle(),
                keys: self.geometry.keys,
                condition: None,
            },
            set,
        }
    }

    /// Figures of the last recording, of a sampler in memory of these sizes.
    ///
    /// # Errors
    /// If the commands are not done, what was timed can't be read, or the driver ran kernels in subgroups that they were not made for.
    pub fn statistics(
        &self,
        (sampler, sizes): (&Sampler, &ResourceSizes),
        (timings, memory_bytes): (&Timings, u64),
        shortfall: &Shortfall,
    ) -> Result<Statistics, HostError> {
        let mut statistics = Statistics {
            regions: 1,
            memory_bytes,
            ..Statistics::default()
        };
        statistics.triangles.total = u64::from(self.triangles);
        sampler.add_statistics([sizes.tiles()], &mut statistics)?;
        for (pass, ms) in timings.read()? {
            statistics.add_time(PassTime { pass, ms });
        }
        shortfall
            .check_subgroups(sizes.lanes)
            .map_err(EngineError::from)?;
        Ok(statistics)
    }
}

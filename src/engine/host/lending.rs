//! Device objects for a host's geometry: its triangles for the passes, and the data that its shaders read.

use super::adoption::Adoption;
use super::alpha::AlphaReading;
use super::content::HostContent;
use super::draw::PlacedDraws;
use super::shading::{HostShading, ShadeSamples, VisibilitySamples};
use super::viewport::ClipPlane;
use super::{Geometry, HostError, IndirectCounts, Outcome, Shared};
use crate::engine::data::{ResourceSizes, Resources, VisibilityUniform, VisibleGeometry};
use crate::engine::sampler::{Capacity, Sampler, Shortfall, Statistics};
use crate::vulkan::{Buffer, Completion, DescriptorSets, Memory, MemoryUse, Recorder, Timings};
use ash::vk;
use std::sync::Arc;

/// Geometry of a host on the device, for frames and lists.
pub(super) struct Lending {
    pub geometry: Geometry,
    pub content: HostContent,
    alpha: AlphaReading,
    adoption: Adoption,
    visibility: Buffer,
    completion: Completion,
    /// Whether the device has executed a recording that reads the alpha maps.
    has_alpha: bool,
    memory: Memory,
    /// Number of triangles of the last recording, without those of indirect draws.
    triangles: u32,
}

impl Lending {
    /// # Safety
    /// The host's buffers and views are as [`Geometry`] says, and outlive the returned value.
    pub unsafe fn new(shared: &Arc<Shared>, memory: Memory, geometry: &Geometry) -> Result<Self, HostError> {
        // SAFETY: passed on to the caller.
        let content = unsafe { HostContent::new(&shared.gpu, &memory, geometry) }?;
        // SAFETY: passed on to the caller.
        let alpha = unsafe { AlphaReading::new(&shared.frame, geometry, &content) }?;
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

    /// Makes the descriptor set for the host's shaders; `locations` is the buffer of a list's locations, if a list is
    /// sampled.
    ///
    /// # Safety
    /// The buffer of locations outlives the set's use.
    pub unsafe fn visibility_set(
        &self,
        shared: &Shared,
        resources: &Resources,
        locations: Option<vk::DescriptorBufferInfo>,
    ) -> Result<DescriptorSets, HostError> {
        let visible = VisibleGeometry {
            triangles: self.content.triangles(),
            positions: self.content.positions_info(),
            draws: &self.adoption.draws,
            draw_of: self.content.draw_of(),
            locations,
        };
        let layout = (&shared.gpu, &shared.visibility);
        // SAFETY: the caller guarantees the buffer of locations; the others live as long as this value.
        Ok(unsafe { resources.visibility_set(layout, &self.visibility, &visible) }?)
    }

    /// Begins a recording. `upload` records copies to the device. These are recorded again until the device has
    /// executed a recording with them; `is_uploaded` says whether it has.
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

    /// Number of bytes of device memory in use.
    pub fn bytes(&self) -> u64 {
        self.memory.used()
    }

    /// Ends a recording.
    pub fn record_end(&self, recorder: &Recorder<'_>) {
        self.completion.end(recorder);
    }

    /// Work that the last recording of `sampler` could not finish, over `tiles` tiles.
    fn shortfall(&self, sampler: &Sampler, tiles: u32) -> Result<Shortfall, HostError> {
        self.completion.check()?;
        let mut shortfall = Shortfall::default();
        sampler.add_shortfall([tiles], &mut shortfall)?;
        Ok(shortfall)
    }

    /// Capacity with more of what the last recording of `sampler` lacked, over `tiles` tiles.
    ///
    /// # Errors
    /// If the commands are not done, or counters can't be read.
    pub fn more(&self, sampler: &Sampler, tiles: u32) -> Result<Capacity, HostError> {
        Ok(sampler.capacity().more(self.shortfall(sampler, tiles)?))
    }

    /// Records positions in clip space and triangles.
    pub fn record_triangles(&self, recorder: &Recorder<'_>, placed: &PlacedDraws) {
        self.adoption.record(recorder, placed);
    }

    /// Uniform block for the host's shaders. Textures are filtered over squares with the side `place_side`, or, with
    /// `boxes`, over the rectangles that the visibility samples stand for.
    pub fn visible(plane: &ClipPlane, place_side: f32, boxes: bool) -> VisibilityUniform {
        VisibilityUniform {
            scale: plane.scale,
            middle: plane.middle.map(|at| at as f32),
            place_side,
            r#box: u32::from(boxes),
            ..VisibilityUniform::default()
        }
    }

    /// Records an update of the uniform block for the host's shaders.
    pub fn record_visible(&self, recorder: &Recorder<'_>, visible: &VisibilityUniform) {
        recorder.update(&self.visibility, 0, bytemuck::bytes_of(visible));
    }

    /// The host's materials, in the form in which the engine calls them.
    pub fn shading<'a>(
        &self,
        shading: &'a dyn ShadeSamples,
        visibility_set: &DescriptorSets,
        resources: &Resources,
    ) -> HostShading<'a> {
        HostShading {
            shading,
            samples: VisibilitySamples {
                set: visibility_set.first(),
                arguments: resources.arguments.handle(),
                keys: self.geometry.keys,
                condition: None,
            },
        }
    }

    /// Result of the last recording of `sampler`, whose memory has `sizes`.
    ///
    /// # Errors
    /// If the commands are not done, or timestamps can't be read.
    pub fn outcome(
        &self,
        (sampler, sizes): (&Sampler, &ResourceSizes),
        (timings, memory_bytes): (&Timings, u64),
    ) -> Result<Outcome, HostError> {
        let shortfall = self.shortfall(sampler, sizes.tiles())?;
        let mut statistics = Statistics { regions: 1, memory_bytes, ..Statistics::default() };
        let indirect = self.adoption.indirect.as_ref();
        let indirect = indirect.map_or(Ok(IndirectCounts::default()), |placing| placing.counts())?;
        statistics.triangles.total = u64::from(self.triangles) + indirect.triangles;
        sampler.add_statistics([sizes.tiles()], &mut statistics)?;
        for time in timings.read()? {
            statistics.add_time(time);
        }
        Ok(Outcome { statistics, left_over: shortfall.left(), indirect })
    }
}

//! Device objects for a host's geometry: its triangles for the passes, and the data that its shaders read.

use super::adoption::Adoption;
use super::content::HostContent;
use super::draw::PlacedDraws;
use super::shading::{HostShading, ShadeSamples, VisibilitySamples};
use super::viewport::ClipPlane;
use super::{Geometry, HostError, IndirectCounts, Shared};
use crate::engine::data::{Data, Resources, VisibilityUniform, VisibleGeometry};
use crate::engine::sampler::Job;
use crate::vulkan::{Buffer, DescriptorSets, Memory, MemoryUse, Recorder};
use ash::vk;
use std::sync::Arc;

/// Geometry of a host on the device, for frames and lists.
pub(super) struct Lending {
    pub geometry: Geometry,
    pub content: HostContent,
    adoption: Adoption,
    visibility: Buffer,
    /// Whether the device has executed a recording that reads the alpha maps.
    has_alpha: bool,
    memory: Memory,
}

impl Lending {
    /// # Safety
    /// The host's buffers and views are as [`Geometry`] says, and outlive the returned value.
    pub unsafe fn new(shared: &Arc<Shared>, memory: Memory, geometry: &Geometry) -> Result<Self, HostError> {
        // SAFETY: passed on to the caller.
        let content = unsafe { HostContent::new(&shared.frame, &memory, geometry) }?;
        // SAFETY: passed on to the caller.
        let adoption = unsafe { Adoption::new(shared, &memory, geometry, &content) }?;
        let visibility = memory.buffer(
            "visibility uniform",
            size_of::<VisibilityUniform>() as u64,
            vk::BufferUsageFlags::UNIFORM_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
            MemoryUse::Device,
        )?;
        Ok(Self { geometry: geometry.clone(), content, adoption, visibility, has_alpha: false, memory })
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
        // SAFETY: the caller guarantees the buffer of locations; the others live as long as this value.
        Ok(unsafe { resources.visibility_set(&shared.gpu, &shared.visibility, &self.visibility, &visible) }?)
    }

    /// Records that the commands of `job` up to now are done, or will never be executed.
    pub fn note(&mut self, job: &Job) {
        self.has_alpha |= job.check().is_ok();
    }

    /// Records the reading of the alpha maps, until the device has executed a recording with it.
    pub fn record_alpha(&self, recorder: &Recorder<'_>) {
        if let Some(alpha) = self.content.alpha().filter(|_| !self.has_alpha) {
            alpha.record(recorder);
        }
    }

    /// Number of bytes of device memory in use.
    pub fn bytes(&self) -> u64 {
        self.memory.used()
    }

    /// Records positions in clip space and triangles.
    pub fn record_triangles(&self, recorder: &Recorder<'_>, placed: &PlacedDraws) {
        self.adoption.record(recorder, &self.geometry, placed);
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
                arguments: resources.buffer(Data::Arguments).handle(),
                keys: self.geometry.keys,
                condition: None,
            },
        }
    }

    /// Counts of the last recording's indirect draws, once its commands are done.
    ///
    /// # Errors
    /// If they can't be read.
    pub fn indirect_counts(&self) -> Result<IndirectCounts, HostError> {
        let indirect = self.adoption.indirect.as_ref();
        Ok(indirect.map_or(Ok(IndirectCounts::default()), |placing| placing.counts())?)
    }
}

//! How what a host lends becomes triangles that passes read.

use super::content::HostContent;
use super::draw::PlacedDraws;
use super::{Geometry, HostError, PositionSpace, Shared};
use crate::engine::data::Draws;
use crate::engine::passes::{AdoptedCounts, VertexCounts};
use crate::engine::pipelines::OwnSet;
use crate::vulkan::{Memory, Pipeline, Recorder};
use std::sync::Arc;

/// The passes that read a host's buffers, and a frame's draws.
pub(super) struct Adoption {
    pub draws: Draws,
    transform: Option<(Pipeline, OwnSet)>,
    coordinates: Option<(Pipeline, OwnSet)>,
    adopt: (Pipeline, OwnSet),
    geometry: Geometry,
    shared: Arc<Shared>,
}

impl Adoption {
    /// # Safety
    /// The host's buffers are as [`Geometry`] says and outlive this.
    pub unsafe fn new(
        shared: &Arc<Shared>,
        memory: &Memory,
        geometry: &Geometry,
        content: &HostContent,
    ) -> Result<Self, HostError> {
        let (gpu, transform, adopt) = (&shared.gpu, &shared.transform, &shared.adopt);
        let has_matrices = geometry.position_space != PositionSpace::Clip;
        let draws = Draws::new(memory, geometry.draw_capacity, has_matrices)?;
        let vertices = geometry.lent_positions(gpu.limits()).info();
        let indices = geometry.lent_indices(gpu.limits()).info();
        // SAFETY: of the host's buffers as the caller says; the rest goes with the frame.
        let (transform_set, coordinates_set, adopt_set) = unsafe {
            let made = content.made_positions();
            let set = made.map(|made| transform.set(&draws, vertices, made));
            let lent = geometry.lent_coordinates(gpu.limits());
            let coordinates = content.alpha().zip(lent).map(|(alpha, lent)| {
                let made = &alpha.coordinates.buffer;
                shared.coordinates.set(&draws, lent.info(), made)
            });
            let (triangles, draw_of) = (content.triangles(), content.draw_of());
            (
                set.transpose()?,
                coordinates.transpose()?,
                adopt.set(&draws, indices, triangles, draw_of)?,
            )
        };
        let with_pipeline = |set| Ok::<_, HostError>((transform.pipeline(gpu, &draws)?, set));
        let with_coordinates =
            |set| Ok::<_, HostError>((shared.coordinates.pipeline(gpu, &draws)?, set));
        Ok(Self {
            coordinates: coordinates_set.map(with_coordinates).transpose()?,
            transform: transform_set.map(with_pipeline).transpose()?,
            adopt: (
                adopt.pipeline(gpu, geometry.has_short_indices())?,
                adopt_set,
            ),
            draws,
            geometry: geometry.clone(),
            shared: shared.clone(),
        })
    }

    /// Records positions in clip space and triangles, those of draws that fit.
    pub fn record(&self, recorder: &Recorder<'_>, placed: &PlacedDraws) {
        if placed.triangles == 0 {
            return;
        }
        self.draws
            .record_upload(recorder, &placed.draws, &placed.matrices);
        let limits = self.shared.gpu.limits();
        let draws = placed.draws.len() as u32;
        let counts = |before: u32, stride: u32| VertexCounts {
            position_count: placed.positions,
            draw_count: draws,
            first_word: before / 4,
            stride: stride / 4,
        };
        let lent = self.geometry.coordinates;
        let coordinates = self.geometry.lent_coordinates(limits).zip(lent);
        if let (Some((pipeline, set)), Some((bytes, lent))) = (&self.coordinates, coordinates) {
            let counts = counts(bytes.before, lent.stride);
            let coordinates = &self.shared.coordinates;
            coordinates.record(recorder, pipeline, set, counts);
        }
        if let Some((pipeline, set)) = &self.transform {
            let before = self.geometry.lent_positions(limits).before;
            let counts = counts(before, self.geometry.position_stride);
            let transform = &self.shared.transform;
            transform.record(recorder, pipeline, set, counts);
        }
        let counts = AdoptedCounts {
            triangle_count: placed.triangles,
            draw_count: draws,
            first_index: self.geometry.first_lent_index(limits),
            index_count: self.geometry.index_capacity,
        };
        let (pipeline, set) = &self.adopt;
        self.shared.adopt.record(recorder, pipeline, set, counts);
    }
}

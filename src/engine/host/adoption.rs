//! Passes that convert the triangles that a host lends to the form that the other passes read.

use super::content::HostContent;
use super::draw::{DrawRun, PlacedDraws};
use super::{Geometry, HostError, Indices, Mesh, PositionSpace, Shared};
use crate::engine::data::Draws;
use crate::engine::passes::adopt::{self, AdoptedCounts};
use crate::engine::passes::coordinates;
use crate::engine::passes::transform::{self, VertexCounts};
use crate::engine::pipelines::Kernel;
use crate::engine::spirv;
use crate::vulkan::{DescriptorSets, Memory, Recorder};
use ash::vk;
use std::sync::Arc;

/// Passes that read a host's buffers, and the draws of a frame.
pub(super) struct Adoption {
    pub draws: Draws,
    transform: Option<Kernel<spirv::Transform>>,
    coordinates: Option<Kernel<spirv::Coordinates>>,
    /// Kernels of `adopt`: for meshes without indices, with 16-bit indices, and with 32-bit indices.
    adopt: [Option<Kernel<spirv::Adopt>>; 3],
    /// Descriptor sets of each mesh.
    sets: Vec<MeshSets>,
    geometry: Geometry,
    shared: Arc<Shared>,
}

/// Descriptor sets with which passes read a mesh.
struct MeshSets {
    transform: Option<DescriptorSets>,
    coordinates: Option<DescriptorSets>,
    adopt: DescriptorSets,
}

/// Index into `adopt` of the kernel that reads these indices.
fn kernel(indices: Option<Indices>) -> usize {
    indices.map_or(0, |indices| if indices.are_short() { 1 } else { 2 })
}

impl MeshSets {
    /// # Safety
    /// The mesh's buffers are as [`Geometry`] says, and outlive the returned value.
    unsafe fn new(
        shared: &Shared,
        draws: &Draws,
        (geometry, mesh): (&Geometry, &Mesh),
        content: &HostContent,
    ) -> Result<Self, HostError> {
        let (limits, layout) = (shared.gpu.limits(), &*shared.frame);
        let (triangles, draw_of) = (content.triangles(), content.draw_of());
        // Without indices, the shader does not read that binding.
        let indices = mesh.indices.map(|indices| indices.lent(limits).info());
        let lent = content.alpha().zip(mesh.lent_coordinates(limits));
        // SAFETY: the caller guarantees the host's buffers; the others live as long as the frame.
        unsafe {
            let transform = content.made_positions().map(|made| {
                let lent = mesh.lent_positions(geometry.position_space, limits);
                transform::set(layout, draws, lent.info(), made)
            });
            let coordinates = lent.map(|(alpha, (_, lent))| {
                let made = &alpha.coordinates.buffer;
                coordinates::set(layout, draws, lent.info(), made)
            });
            Ok(Self {
                transform: transform.transpose()?,
                coordinates: coordinates.transpose()?,
                adopt: adopt::set(layout, draws, indices, triangles, draw_of)?,
            })
        }
    }
}

impl Adoption {
    /// # Safety
    /// The host's buffers are as [`Geometry`] says, and outlive the returned value.
    pub unsafe fn new(
        shared: &Arc<Shared>,
        memory: &Memory,
        geometry: &Geometry,
        content: &HostContent,
    ) -> Result<Self, HostError> {
        let layout = &*shared.frame;
        let has_matrices = geometry.position_space != PositionSpace::Clip;
        let draws = Draws::new(memory, geometry.draw_capacity, has_matrices)?;
        let sets = geometry.meshes.iter().map(|mesh| {
            // SAFETY: passed on to the caller.
            unsafe { MeshSets::new(shared, &draws, (geometry, mesh), content) }
        });
        let sets = sets.collect::<Result<Vec<_>, _>>()?;
        let mut adopt = [None, None, None];
        for mesh in &geometry.meshes {
            let kernel = &mut adopt[kernel(mesh.indices)];
            if kernel.is_none() {
                let are_short = mesh.indices.map(|indices| indices.are_short());
                *kernel = Some(adopt::kernel(layout, are_short)?);
            }
        }
        let transform = || transform::kernel(layout, &draws);
        let coordinates = || coordinates::kernel(layout, &draws);
        let transforms = content.made_positions().is_some();
        Ok(Self {
            transform: transforms.then(transform).transpose()?,
            coordinates: content.alpha().is_some().then(coordinates).transpose()?,
            adopt,
            sets,
            draws,
            geometry: geometry.clone(),
            shared: shared.clone(),
        })
    }

    /// Records the conversion of the placed draws: positions in clip space, and triangles.
    pub fn record(&self, recorder: &Recorder<'_>, placed: &PlacedDraws) {
        if placed.triangles == 0 {
            return;
        }
        self.draws.record_upload(recorder, &placed.draws, &placed.matrices);
        self.record_vertices(recorder, placed);
        let limits = self.shared.gpu.limits();
        for run in &placed.runs {
            let indices = self.geometry.meshes[run.mesh].indices;
            let Some(adopt) = &self.adopt[kernel(indices)] else {
                continue;
            };
            let counts = AdoptedCounts {
                first_triangle: run.triangles[0],
                triangle_count: run.triangles[1],
                draw_count: placed.draws.len() as u32,
                first_index: indices.map_or(0, |indices| indices.first_lent(limits)),
                index_count: indices.map_or(0, |indices| indices.capacity),
                topology: run.topology as u32,
                clockwise: u32::from(run.front_face == vk::FrontFace::CLOCKWISE),
            };
            recorder.show(&self.sets[run.mesh].adopt);
            adopt.record(recorder, &counts, counts.triangle_count);
        }
    }

    fn record_vertices(&self, recorder: &Recorder<'_>, placed: &PlacedDraws) {
        let limits = self.shared.gpu.limits();
        let parts = self.vertex_parts(placed);
        let counts = |[first, count]: [u32; 2], before: u32, stride: u32| VertexCounts {
            first_position: first,
            position_count: count,
            draw_count: placed.draws.len() as u32,
            first_word: before / 4,
            stride: stride / 4,
        };
        if let Some(coordinates) = &self.coordinates {
            for &(mesh, positions) in &parts {
                let lent = self.geometry.meshes[mesh].lent_coordinates(limits);
                if let Some((set, (lent, bytes))) = self.sets[mesh].coordinates.as_ref().zip(lent) {
                    let counts = counts(positions, bytes.before, lent.stride);
                    recorder.show(set);
                    coordinates.record(recorder, &counts, counts.position_count);
                }
            }
        }
        if let Some(transform) = &self.transform {
            for &(mesh, positions) in &parts {
                let lent = &self.geometry.meshes[mesh];
                let before = lent.lent_positions(self.geometry.position_space, limits).before;
                if let Some(set) = &self.sets[mesh].transform {
                    let counts = counts(positions, before, lent.position_stride);
                    recorder.show(set);
                    transform.record(recorder, &counts, counts.position_count);
                }
            }
        }
    }

    /// Parts of meshes to transform: the index of a mesh, and the first index and the number of the positions in clip
    /// space that are made from it. With positions in object space, each run of draws is a part; with positions in clip
    /// space, each mesh that is drawn.
    fn vertex_parts(&self, placed: &PlacedDraws) -> Vec<(usize, [u32; 2])> {
        if self.geometry.position_space != PositionSpace::Clip {
            let part = |run: &DrawRun| (run.mesh, run.positions);
            return placed.runs.iter().map(part).collect();
        }
        let mut is_drawn = vec![false; self.geometry.meshes.len()];
        for run in &placed.runs {
            is_drawn[run.mesh] = true;
        }
        let meshes = self.geometry.meshes.iter().enumerate();
        let parts = meshes.zip(self.geometry.first_positions());
        let parts = parts.map(|((number, mesh), first)| (number, [first, mesh.vertex_capacity]));
        parts.filter(|(number, _)| is_drawn[*number]).collect()
    }
}

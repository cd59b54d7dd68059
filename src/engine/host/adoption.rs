//! Passes that convert the triangles that a host lends to the form that the other passes read.

use super::content::HostContent;
use super::draw::{DrawRun, PlacedDraws};
use super::indirect::IndirectPlacing;
use super::{Geometry, HostError, Indices, Mesh, PositionSpace, Shared, VertexFormat};
use crate::engine::data::Draws;
use crate::engine::passes::adopt::{self, AdoptedCounts};
use crate::engine::passes::coordinates;
use crate::engine::passes::transform::{self, VertexCounts};
use crate::engine::pipelines::Kernel;
use crate::engine::spirv;
use crate::vulkan::{DescriptorSets, Memory, Recorder, VulkanError};
use ash::vk;

/// Passes that read a host's buffers, and the draws of a frame.
pub(super) struct Adoption {
    pub draws: Draws,
    pub indirect: Option<IndirectPlacing>,
    /// Kernels of `transform` and of `coordinates`, for each type of components.
    transform: [Option<Kernel<spirv::Transform>>; VERTEX_KINDS],
    coordinates: [Option<Kernel<spirv::Coordinates>>; VERTEX_KINDS],
    /// Kernels of `adopt`, for each type of indices.
    adopt: [Option<Kernel<spirv::Adopt>>; INDEX_KINDS.len()],
    /// Descriptor sets of each mesh.
    sets: Vec<MeshSets>,
}

/// Descriptor sets with which passes read a mesh.
struct MeshSets {
    transform: Option<DescriptorSets>,
    coordinates: Option<DescriptorSets>,
    adopt: DescriptorSets,
}

/// Number of types of the components of vertices.
const VERTEX_KINDS: usize = spirv::VERTEX_SNORM as usize + 1;

/// Whether indices have 16 bits instead of 32, for each type of indices; the first type stands for no indices.
const INDEX_KINDS: [Option<bool>; 3] = [None, Some(true), Some(false)];

/// Index into [`INDEX_KINDS`].
fn index_kind(indices: Option<Indices>) -> u32 {
    indices.map_or(0, |indices| if indices.are_short() { 1 } else { 2 })
}

/// Makes a kernel for each of the kinds, which may repeat.
fn kernels<S, const N: usize>(
    kinds: impl Iterator<Item = u32>,
    make: impl Fn(u32) -> Result<Kernel<S>, VulkanError>,
) -> Result<[Option<Kernel<S>>; N], VulkanError> {
    let mut kernels = [const { None }; N];
    for kind in kinds {
        let kernel = &mut kernels[kind as usize];
        if kernel.is_none() {
            *kernel = Some(make(kind)?);
        }
    }
    Ok(kernels)
}

impl MeshSets {
    /// # Safety
    /// The mesh's buffers are as [`Geometry`] says, and outlive the returned value.
    unsafe fn new(
        shared: &Shared,
        draws: &Draws,
        geometry: &Geometry,
        mesh: &Mesh,
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
        shared: &Shared,
        memory: &Memory,
        geometry: &Geometry,
        content: &HostContent,
    ) -> Result<Self, HostError> {
        let layout = &*shared.frame;
        let has_matrices = geometry.position_space != PositionSpace::Clip;
        let draws = Draws::new(memory, geometry.all_draws(), has_matrices)?;
        // SAFETY: passed on to the caller.
        let indirect = unsafe { IndirectPlacing::new(layout, memory, geometry, &draws) }?;
        let sets = geometry.meshes.iter().map(|mesh| {
            // SAFETY: passed on to the caller.
            unsafe { MeshSets::new(shared, &draws, geometry, mesh, content) }
        });
        let sets = sets.collect::<Result<Vec<_>, _>>()?;
        let meshes = || geometry.meshes.iter();
        let transformed = meshes().filter(|_| content.made_positions().is_some());
        let positions = transformed.map(|mesh| mesh.position_format.kind());
        let mapped = meshes().filter(|_| content.alpha().is_some()).filter_map(|mesh| mesh.coordinates);
        let indices = meshes().map(|mesh| index_kind(mesh.indices));
        Ok(Self {
            transform: kernels(positions, |kind| transform::kernel(layout, &draws, kind))?,
            coordinates: kernels(mapped.map(|lent| lent.format.kind()), |kind| {
                coordinates::kernel(layout, &draws, kind)
            })?,
            adopt: kernels(indices, |kind| adopt::kernel(layout, INDEX_KINDS[kind as usize]))?,
            sets,
            indirect,
            draws,
        })
    }

    /// Records the conversion of the placed draws: positions in clip space, and triangles. `geometry` is that for which this
    /// was made.
    pub fn record(&self, recorder: &Recorder<'_>, geometry: &Geometry, placed: &PlacedDraws) {
        if placed.triangles == 0 {
            return;
        }
        self.draws.record_upload(recorder, &placed.draws, &placed.matrices);
        if let Some(indirect) = &self.indirect {
            indirect.record(recorder, geometry, &placed.indirect);
        }
        self.record_vertices(recorder, geometry, &placed.runs);
        let limits = recorder.limits();
        for run in &placed.runs {
            let indices = geometry.meshes[run.mesh].indices;
            let Some(adopt) = &self.adopt[index_kind(indices) as usize] else {
                continue;
            };
            let counts = AdoptedCounts {
                first_triangle: run.triangles[0],
                triangle_count: run.triangles[1],
                first_draw: run.draws[0],
                draw_count: run.draws[1],
                first_index: indices.map_or(0, |indices| indices.first_lent(limits)),
                index_count: indices.map_or(0, |indices| indices.capacity),
                topology: run.topology as u32,
                clockwise: u32::from(run.front_face == vk::FrontFace::CLOCKWISE),
            };
            recorder.show(&self.sets[run.mesh].adopt);
            adopt.record(recorder, &counts, counts.triangle_count);
        }
    }

    fn record_vertices(&self, recorder: &Recorder<'_>, geometry: &Geometry, runs: &[DrawRun]) {
        let limits = recorder.limits();
        let parts = vertex_parts(geometry, runs);
        let counts = |part: &VertexPart, format: VertexFormat, before: u32, stride: u32| {
            let [x, y, z] = format.bias;
            VertexCounts {
                scale: format.factor(),
                bias: [x, y, z, 0.0],
                first_position: part.positions[0],
                position_count: part.positions[1],
                first_draw: part.draws[0],
                draw_count: part.draws[1],
                first_half: before / 2,
                stride: stride / 2,
            }
        };
        for part in &parts {
            let lent = geometry.meshes[part.mesh].lent_coordinates(limits);
            if let Some((set, (lent, bytes))) = self.sets[part.mesh].coordinates.as_ref().zip(lent)
                && let Some(kernel) = &self.coordinates[lent.format.kind() as usize]
            {
                let counts = counts(part, lent.format, bytes.before, lent.stride);
                recorder.show(set);
                kernel.record(recorder, &counts, counts.position_count);
            }
        }
        for part in &parts {
            let lent = &geometry.meshes[part.mesh];
            let before = lent.lent_positions(geometry.position_space, limits).before;
            if let Some(set) = &self.sets[part.mesh].transform
                && let Some(kernel) = &self.transform[lent.position_format.kind() as usize]
            {
                let counts = counts(part, lent.position_format, before, lent.position_stride);
                recorder.show(set);
                kernel.record(recorder, &counts, counts.position_count);
            }
        }
    }
}

/// Parts of meshes to transform. With positions in object space, each run of draws is a part; with positions in clip
/// space, each mesh that is drawn.
fn vertex_parts(geometry: &Geometry, runs: &[DrawRun]) -> Vec<VertexPart> {
    if geometry.position_space != PositionSpace::Clip {
        let part = |run: &DrawRun| VertexPart { mesh: run.mesh, draws: run.draws, positions: run.positions };
        return runs.iter().map(part).collect();
    }
    let mut is_drawn = vec![false; geometry.meshes.len()];
    for run in runs {
        is_drawn[run.mesh] = true;
    }
    let meshes = geometry.meshes.iter().enumerate();
    let parts = meshes.zip(geometry.first_positions());
    // Positions in clip space are not those of a draw.
    let part = |((mesh, lent), first): ((usize, &Mesh), u32)| VertexPart {
        mesh,
        draws: [0, 0],
        positions: [first, lent.vertex_capacity],
    };
    parts.map(part).filter(|part| is_drawn[part.mesh]).collect()
}

/// Positions in clip space that are made from a mesh.
struct VertexPart {
    mesh: usize,
    /// First draw and number of draws among which those of the positions are searched.
    draws: [u32; 2],
    /// First position and number of positions.
    positions: [u32; 2],
}

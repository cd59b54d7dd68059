//! Assembly of all placements' triangles into one geometry.
//!
//! Most placements are transformed into world space here, once, so that passes can read them with the least effort. A
//! large mesh that many placements share is stored once, in its own space, and drawn by [`MeshInstance`]s.

use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use std::collections::HashMap;

use super::placement::Placement;
use crate::scene::{
    DrawClass, DrawRange, Edge, Material, MeshInstance, PosedGeometry, Scene, SceneError, Stroke, VertexStreams,
    document::Primitive,
    error::{Fault, Warnings},
    read::{MAX_DISPLACEMENTS, MAX_ELEMENTS},
};

/// Smallest number of vertices that one task transforms.
const CHUNK: usize = 24_576;
/// Largest distance of a vertex from the world's origin. This is so far below the largest float that differences and
/// products of coordinates stay finite in double precision, and relative positions in single precision.
const FARTHEST: f64 = 1e30;

/// Smallest number of triangles of a mesh that is drawn by instances: each instance rounds its indices up to whole
/// blocks.
const LEAST_TRIANGLES: usize = 4 * MeshInstance::ALIGNMENT as usize;
/// Smallest number of triangles that instances must save, at some 60 bytes each; smaller scenes are faster in world
/// space.
const LEAST_SAVED: usize = 1 << 16;

/// A placement, and the place of its elements in the geometry.
struct PlacementJob<'p, 'd> {
    placement: Placement<'d>,
    /// Index of the placement, or of one of the placements if the mesh is drawn by instances.
    index: usize,
    class: DrawClass,
    first_vertex: u32,
    /// Origin to which its positions are relative.
    origin: DVec3,
    /// Placements that draw the mesh, which is then in its own space; empty for a mesh in world space.
    instances: Vec<&'p Placement<'d>>,
}

impl PlacementJob<'_, '_> {
    fn triangle_count(&self) -> u32 {
        // The conversion is safe: the total number was checked to fit into u32.
        self.placement.primitive.triangles.len() as u32
    }
}

/// Flattens `placements` into one geometry, sorted by class, then by their order.
pub fn assemble(
    scene: &Scene,
    placements: &[Placement<'_>],
    warnings: &mut Warnings,
) -> Result<(PosedGeometry, Vec<MovingPlacement>), SceneError> {
    let total = |count: fn(&Placement<'_>) -> usize, what, limit| {
        let count = placements.iter().map(|p| count(p) as u64).fold(0, u64::saturating_add);
        if count > limit {
            return Err(SceneError::TooLarge { file: scene.document.file.clone(), what, count, limit });
        }
        Ok(())
    };
    total(|p| p.primitive.positions.len(), "vertices", MAX_ELEMENTS)?;
    total(|p| p.primitive.triangles.len(), "triangles", MAX_ELEMENTS)?;
    total(|p| p.displacements(), "displacements of vertices by morph targets", MAX_DISPLACEMENTS)?;

    let (jobs, origin) = plan(scene, placements, warnings);
    let count = |count: fn(&Placement<'_>) -> usize| -> usize { jobs.iter().map(|job| count(&job.placement)).sum() };
    let vertices = count(|p| p.primitive.positions.len());
    let needed = Needed::by(scene, &jobs);
    let mut geometry = PosedGeometry {
        origin,
        positions: vec![[0.0; 3]; vertices],
        streams: VertexStreams {
            normals: vec![[0.0; 3]; vertices],
            tangents: stream(needed.tangents, vertices, [1.0, 0.0, 0.0, 1.0]),
            uvs: stream(needed.uvs, vertices, [0.0; 4]),
            colors: stream(needed.colors, vertices, [1.0; 4]),
            scales: stream(needed.scales, vertices, 1.0),
        },
        triangles: vec![[0; 3]; count(|p| p.primitive.triangles.len())],
        draws: draws(&jobs),
        instances: instances(&jobs, origin),
        strokes: jobs.iter().flat_map(PlacementJob::strokes).collect(),
        edges: jobs.iter().flat_map(PlacementJob::edges).collect(),
    };
    let indices = geometry.triangle_slots();
    if indices > MAX_ELEMENTS {
        return Err(SceneError::TooLarge {
            file: scene.document.file.clone(),
            what: "triangles, each instance's rounded up to a multiple of 64",
            count: indices,
            limit: MAX_ELEMENTS,
        });
    }
    fill(&jobs, &mut geometry);
    let moving = jobs.iter().filter(|job| job.placement.moves);
    let moving = moving.map(|job| MovingPlacement { placement: job.index, first_vertex: job.first_vertex });
    Ok((geometry, moving.collect()))
}

/// Vertices of a placement that moves.
pub struct MovingPlacement {
    /// Index of the placement.
    pub placement: usize,
    pub first_vertex: u32,
}

fn stream<T: Clone>(needed: bool, count: usize, default: T) -> Vec<T> {
    vec![default; if needed { count } else { 0 }]
}

/// Whether some job needs each optional vertex stream.
struct Needed {
    tangents: bool,
    uvs: bool,
    colors: bool,
    scales: bool,
}

impl Needed {
    fn by(scene: &Scene, jobs: &[PlacementJob<'_, '_>]) -> Self {
        let any = |has: &dyn Fn(&Placement<'_>) -> bool| jobs.iter().any(|job| has(&job.placement));
        let material =
            |p: &Placement<'_>, has: fn(&Material) -> bool| scene.materials.get(p.primitive.material).is_some_and(has);
        Self {
            tangents: any(&|p| material(p, |m| m.tangent_uv_set().is_some())),
            uvs: any(&|p| material(p, |m| m.textures().next().is_some())),
            colors: any(&|p| !p.primitive.colors.is_empty()),
            scales: any(&|p| material(p, Material::has_volume)),
        }
    }
}

/// The jobs in the order of their triangles, and the centre of the scene.
fn plan<'p, 'd>(
    scene: &Scene,
    placements: &'p [Placement<'d>],
    warnings: &mut Warnings,
) -> (Vec<PlacementJob<'p, 'd>>, DVec3) {
    let boxes: Vec<(DVec3, DVec3)> = placements.par_iter().map(bounds).collect();
    let mut placed = Vec::new();
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for ((index, placement), corners) in placements.iter().enumerate().zip(boxes) {
        // The comparison is false for NaN, so that such corners are refused too.
        let near = |corner: DVec3| corner.abs().cmple(DVec3::splat(FARTHEST)).all();
        if !(near(corners.0) && near(corners.1)) {
            warnings.push(&Fault::new(
                format!("/nodes/{}", placement.node),
                format!("its mesh reaches farther than {FARTHEST} and is left out"),
            ));
            continue;
        }
        (low, high) = (low.min(corners.0), high.max(corners.1));
        placed.push((index, placement));
    }
    let origin = if placed.is_empty() { DVec3::ZERO } else { (low + high) / 2.0 };
    let mut jobs = jobs(scene, &placed, origin);
    let mut next = 0;
    for job in &mut jobs {
        job.first_vertex = next;
        // The conversion is safe: the total number was checked to fit into u32.
        next += job.placement.primitive.positions.len() as u32;
    }
    (jobs, origin)
}

/// The jobs by class; within a class, meshes in world space come before meshes with instances.
fn jobs<'p, 'd>(scene: &Scene, placed: &[(usize, &'p Placement<'d>)], origin: DVec3) -> Vec<PlacementJob<'p, 'd>> {
    let mut sharing: HashMap<*const Primitive, usize> = HashMap::new();
    for mesh in placed.iter().filter_map(|(_, placement)| placement.mesh()) {
        *sharing.entry(std::ptr::from_ref(mesh)).or_default() += 1;
    }
    let is_instanced = |mesh: &Primitive| {
        let copies = sharing.get(&std::ptr::from_ref(mesh)).copied().unwrap_or(0);
        let saved = copies.saturating_sub(1) * mesh.triangles.len();
        // Points and lines have a different shape at each place.
        mesh.triangles.len() >= LEAST_TRIANGLES && saved >= LEAST_SAVED && !mesh.is_strokes()
    };
    let job_at = |placement: Placement<'d>, index, class, origin| PlacementJob {
        placement,
        index,
        class,
        first_vertex: 0,
        origin,
        instances: Vec::new(),
    };
    let mut jobs: Vec<PlacementJob<'p, 'd>> = Vec::new();
    let mut job_of: HashMap<*const Primitive, usize> = HashMap::new();
    for &(index, placement) in placed {
        let material = scene.materials.get(placement.primitive.material);
        let class = material.map_or(DrawClass::Opaque, DrawClass::of);
        let Some(mesh) = placement.mesh().filter(|mesh| is_instanced(mesh)) else {
            jobs.push(job_at(placement.clone(), index, class, origin));
            continue;
        };
        let job = *job_of.entry(std::ptr::from_ref(mesh)).or_insert_with(|| {
            let own = placement.at(DAffine3::IDENTITY);
            let (low, high) = bounds(&own);
            // Rounding to single precision keeps small coordinates of the file unchanged.
            let origin = ((low + high) / 2.0).as_vec3().as_dvec3();
            jobs.push(job_at(own, index, class, origin));
            jobs.len() - 1
        });
        if let Some(job) = jobs.get_mut(job) {
            job.instances.push(placement);
        }
    }
    jobs.sort_by_key(|job| (job.class, !job.instances.is_empty()));
    jobs
}

/// Instances that draw the triangles of jobs; empty if all are in world space.
fn instances(jobs: &[PlacementJob<'_, '_>], origin: DVec3) -> Vec<MeshInstance> {
    if jobs.iter().all(|job| job.instances.is_empty()) {
        return Vec::new();
    }
    let mut instances: Vec<MeshInstance> = Vec::new();
    let mut first_triangle = 0;
    let mut last = None;
    for job in jobs {
        let triangle_count = job.triangle_count();
        let place = (job.class, job.instances.is_empty());
        match instances.last_mut() {
            Some(world) if last == Some(place) && job.instances.is_empty() => {
                world.triangle_count += triangle_count;
            }
            _ => {
                let transforms: Vec<DAffine3> = match job.instances.as_slice() {
                    [] => vec![DAffine3::IDENTITY],
                    placements => placements
                        .iter()
                        .filter_map(|placement| placement.rigid())
                        .map(|place| {
                            DAffine3::from_translation(-origin) * place * DAffine3::from_translation(job.origin)
                        })
                        .collect(),
                };
                instances.extend(transforms.into_iter().map(|transform| MeshInstance {
                    first_triangle,
                    triangle_count,
                    first_index: 0,
                    transform,
                }));
            }
        }
        last = Some(place);
        first_triangle += triangle_count;
    }
    let mut next = 0_u64;
    for instance in &mut instances {
        // The caller checks that the last index fits.
        instance.first_index = next as u32;
        next += u64::from(instance.triangle_count).next_multiple_of(MeshInstance::ALIGNMENT.into());
    }
    instances
}

/// Lowest and highest corner of the box around a placement; NaN if a position is not finite.
fn bounds(placement: &Placement<'_>) -> (DVec3, DVec3) {
    (0..placement.primitive.positions.len())
        .into_par_iter()
        .with_min_len(CHUNK)
        .fold(empty_box, |(low, high), v| {
            let position = placement.position(v);
            // `min` and `max` would ignore NaN.
            if position.is_finite() {
                (low.min(position), high.max(position))
            } else {
                (DVec3::NEG_INFINITY, DVec3::INFINITY)
            }
        })
        .reduce(empty_box, |a, b| (a.0.min(b.0), a.1.max(b.1)))
}

fn empty_box() -> (DVec3, DVec3) {
    (DVec3::INFINITY, DVec3::NEG_INFINITY)
}

/// Ranges of triangles with the same material and class.
fn draws(jobs: &[PlacementJob<'_, '_>]) -> Vec<DrawRange> {
    let mut draws: Vec<DrawRange> = Vec::new();
    let mut first_triangle = 0;
    for job in jobs {
        let (material, class) = (job.placement.primitive.material as u32, job.class);
        let triangle_count = job.triangle_count();
        match draws.last_mut() {
            Some(last) if last.material == material && last.class == class => {
                last.triangle_count += triangle_count;
            }
            _ => draws.push(DrawRange { first_triangle, triangle_count, material, class }),
        }
        first_triangle += triangle_count;
    }
    draws
}

/// The slices of all streams that one job fills; empty for a stream that the geometry lacks.
struct StreamSlices<'g> {
    positions: &'g mut [[f32; 3]],
    normals: &'g mut [[f32; 3]],
    tangents: &'g mut [[f32; 4]],
    uvs: &'g mut [[f32; 4]],
    colors: &'g mut [[f32; 4]],
    scales: &'g mut [f32],
    triangles: &'g mut [[u32; 3]],
}

fn fill(jobs: &[PlacementJob<'_, '_>], geometry: &mut PosedGeometry) {
    let streams = &mut geometry.streams;
    let mut rest = StreamSlices {
        positions: &mut geometry.positions,
        normals: &mut streams.normals,
        tangents: &mut streams.tangents,
        uvs: &mut streams.uvs,
        colors: &mut streams.colors,
        scales: &mut streams.scales,
        triangles: &mut geometry.triangles,
    };
    let mut work = Vec::new();
    for job in jobs {
        let vertices = job.placement.primitive.positions.len();
        work.push((
            job,
            StreamSlices {
                positions: take(&mut rest.positions, vertices),
                normals: take(&mut rest.normals, vertices),
                tangents: take(&mut rest.tangents, vertices),
                uvs: take(&mut rest.uvs, vertices),
                colors: take(&mut rest.colors, vertices),
                scales: take(&mut rest.scales, vertices),
                triangles: take(&mut rest.triangles, job.placement.primitive.triangles.len()),
            },
        ));
    }
    work.into_par_iter().for_each(|(job, parts)| job.fill(parts));
}

/// Splits the first `count` elements off; returns an empty slice if the stream is empty.
fn take<'g, T>(rest: &mut &'g mut [T], count: usize) -> &'g mut [T] {
    let all = std::mem::take(rest);
    let (part, remaining) = all.split_at_mut(count.min(all.len()));
    *rest = remaining;
    part
}

impl PlacementJob<'_, '_> {
    fn fill(&self, parts: StreamSlices<'_>) {
        let (placement, origin) = (&self.placement, self.origin);
        let primitive = placement.primitive;
        copy(parts.uvs, &primitive.uvs);
        copy(parts.colors, &primitive.colors);
        for (to, &[a, b, c]) in parts.triangles.iter_mut().zip(&primitive.triangles) {
            // Points and lines always face the camera.
            let triangle = if placement.mirrored && !primitive.is_strokes() { [a, c, b] } else { [a, b, c] };
            *to = triangle.map(|v| v + self.first_vertex);
        }
        each_vertex(parts.scales, |v| placement.frame(v).scale());
        each_vertex(parts.positions, |v| (placement.position(v) - origin).as_vec3().to_array());
        if primitive.is_flat() {
            let triangles = parts.normals.par_chunks_mut(3).with_min_len(CHUNK / 3).enumerate();
            triangles.for_each(|(triangle, normals)| normals.fill(self.flat_normal(triangle)));
        } else {
            each_vertex(parts.normals, |v| placement.normal(v, &placement.frame(v)));
        }
        if !primitive.tangents.is_empty() {
            each_vertex(parts.tangents, |v| placement.tangent(v, &placement.frame(v)));
        }
    }

    /// Corners of the job's points and lines.
    fn strokes(&self) -> impl Iterator<Item = Stroke> {
        let primitive = self.placement.primitive;
        let first = self.first_vertex;
        let corners = primitive.positions.len() - primitive.corners.len();
        let vertices = first + corners as u32..;
        vertices.zip(&primitive.corners).map(move |(vertex, corner)| Stroke {
            part: corner.part,
            vertex,
            at: first + corner.at,
            other: first + corner.other,
            beyond: first + corner.beyond,
            faces_camera: primitive.normals.is_empty(),
        })
    }

    /// Edges of the job's mesh.
    fn edges(&self) -> impl Iterator<Item = Edge> {
        let edges = self.placement.primitive.edges.iter();
        edges.map(|edge| edge.placed(self.first_vertex, self.placement.mirrored))
    }

    /// Normal of a triangle of a primitive whose triangles have three vertices each to themselves.
    fn flat_normal(&self, triangle: usize) -> [f32; 3] {
        let [a, b, c] = [0, 1, 2].map(|corner| self.placement.position(3 * triangle + corner));
        let face = (b - a).cross(c - a).normalize_or(DVec3::Z);
        let outward = if self.placement.mirrored { -face } else { face };
        outward.as_vec3().to_array()
    }
}

/// Computes a stream, whose length is that of the vertices or 0.
fn each_vertex<T: Send>(to: &mut [T], value: impl Fn(usize) -> T + Sync) {
    to.par_iter_mut().with_min_len(CHUNK).enumerate().for_each(|(v, to)| *to = value(v));
}

/// Copies a stream if the primitive has it; otherwise the defaults stay.
fn copy(to: &mut [[f32; 4]], from: &[[f32; 4]]) {
    if to.len() == from.len() {
        to.copy_from_slice(from);
    }
}

//! Puts all placements' triangles into one geometry.
//!
//! Most placements are moved into world space here, once, where passes read them with the least effort. A large mesh that
//! many placements share is held once, in a space of its own, and drawn by [`Instance`]s.

use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use std::collections::HashMap;

use super::placement::Placement;
use crate::scene::{
    Draw, DrawClass, Edge, Geometry, Instance, Material, Scene, SceneError, Stroke, VertexStreams,
    document::Primitive,
    error::{Fault, Warnings},
    read::MAX_ELEMENTS,
};

/// Vertices that one task works on; a multiple of 3, so that flat triangles stay whole.
const CHUNK: usize = 24_576;
/// Farthest that a vertex may be from the world's origin; far enough from the largest float that
/// differences and products of coordinates stay finite in double precision, and relative ones in
/// single.
const FARTHEST: f64 = 1e30;

/// Fewest triangles of a mesh that is worth instances: indices of triangles are rounded up to whole blocks for each.
const LEAST_TRIANGLES: usize = 4 * Instance::ALIGNMENT as usize;
/// Fewest triangles that instances have to save, at some 60 bytes each; what saves less is quicker in world space.
const LEAST_SAVED: usize = 1 << 16;

/// A placement and where its elements go.
struct Job<'p, 'd> {
    placement: Placement<'d>,
    /// Index of its placement, or of one of its placements.
    index: usize,
    class: DrawClass,
    first_vertex: u32,
    /// Origin that its positions are relative to.
    origin: DVec3,
    /// Placements that draw it, of one mesh in a space of its own; none where it is in world space.
    instances: Vec<&'p Placement<'d>>,
}

impl Job<'_, '_> {
    fn triangle_count(&self) -> u32 {
        // Within u32: the total was checked.
        self.placement.primitive.triangles.len() as u32
    }
}

/// Flattens `placements` into one geometry, sorted by class, then by their order.
pub fn assemble(
    scene: &Scene,
    placements: &[Placement<'_>],
    warnings: &mut Warnings,
) -> Result<(Geometry, Vec<MovingPlacement>), SceneError> {
    let total = |count: fn(&Placement<'_>) -> usize, what| {
        let count = placements.iter().map(|p| count(p) as u64).sum();
        if count > MAX_ELEMENTS {
            return Err(SceneError::TooLarge {
                file: scene.document.file.clone(),
                what,
                count,
                limit: MAX_ELEMENTS,
            });
        }
        Ok(())
    };
    total(|p| p.primitive.positions.len(), "vertices")?;
    total(|p| p.primitive.triangles.len(), "triangles")?;

    let (jobs, origin) = plan(scene, placements, warnings);
    let count = |count: fn(&Placement<'_>) -> usize| -> usize {
        jobs.iter().map(|job| count(&job.placement)).sum()
    };
    let vertices = count(|p| p.primitive.positions.len());
    let needed = Needed::by(scene, &jobs);
    let mut geometry = Geometry {
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
        strokes: jobs.iter().flat_map(Job::strokes).collect(),
        edges: jobs.iter().flat_map(Job::edges).collect(),
    };
    let indices = geometry.index_count();
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
    let moving = moving.map(|job| MovingPlacement {
        placement: job.index,
        first_vertex: job.first_vertex,
    });
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

/// Optional vertex streams that some job needs.
struct Needed {
    tangents: bool,
    uvs: bool,
    colors: bool,
    scales: bool,
}

impl Needed {
    fn by(scene: &Scene, jobs: &[Job<'_, '_>]) -> Self {
        let any = |has: &dyn Fn(&Placement<'_>) -> bool| jobs.iter().any(|job| has(&job.placement));
        let material = |p: &Placement<'_>, has: fn(&Material) -> bool| {
            scene.materials.get(p.primitive.material).is_some_and(has)
        };
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
) -> (Vec<Job<'p, 'd>>, DVec3) {
    let boxes: Vec<(DVec3, DVec3)> = placements.par_iter().map(bounds).collect();
    let mut placed = Vec::new();
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for ((index, placement), corners) in placements.iter().enumerate().zip(boxes) {
        // Written so that an undefined corner is refused too.
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
    let origin = if placed.is_empty() {
        DVec3::ZERO
    } else {
        (low + high) / 2.0
    };
    let mut jobs = jobs(scene, &placed, origin);
    let mut next = 0;
    for job in &mut jobs {
        job.first_vertex = next;
        // Within u32: the total was checked.
        next += job.placement.primitive.positions.len() as u32;
    }
    (jobs, origin)
}

/// The jobs by class: first what is in world space, then meshes with instances.
fn jobs<'p, 'd>(
    scene: &Scene,
    placed: &[(usize, &'p Placement<'d>)],
    origin: DVec3,
) -> Vec<Job<'p, 'd>> {
    let mut sharing: HashMap<*const Primitive, usize> = HashMap::new();
    for mesh in placed.iter().filter_map(|(_, placement)| placement.mesh()) {
        *sharing.entry(std::ptr::from_ref(mesh)).or_default() += 1;
    }
    let is_instanced = |mesh: &Primitive| {
        let copies = sharing.get(&std::ptr::from_ref(mesh)).copied().unwrap_or(0);
        let saved = copies.saturating_sub(1) * mesh.triangles.len();
        // Points and lines have another shape at each place.
        mesh.triangles.len() >= LEAST_TRIANGLES && saved >= LEAST_SAVED && !mesh.is_strokes()
    };
    let mut jobs: Vec<Job<'p, 'd>> = Vec::new();
    let mut job_of: HashMap<*const Primitive, usize> = HashMap::new();
    for &(index, placement) in placed {
        let material = scene.materials.get(placement.primitive.material);
        let class = material.map_or(DrawClass::Opaque, DrawClass::of);
        let Some(mesh) = placement.mesh().filter(|mesh| is_instanced(mesh)) else {
            jobs.push(Job {
                placement: placement.clone(),
                index,
                class,
                first_vertex: 0,
                origin,
                instances: Vec::new(),
            });
            continue;
        };
        let job = *job_of.entry(std::ptr::from_ref(mesh)).or_insert_with(|| {
            let own = placement.at(DAffine3::IDENTITY);
            let (low, high) = bounds(&own);
            jobs.push(Job {
                placement: own,
                index,
                class,
                first_vertex: 0,
                // Rounded as positions are, so that those of the file stay as they are where they are small.
                origin: ((low + high) / 2.0).as_vec3().as_dvec3(),
                instances: Vec::new(),
            });
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
fn instances(jobs: &[Job<'_, '_>], origin: DVec3) -> Vec<Instance> {
    if jobs.iter().all(|job| job.instances.is_empty()) {
        return Vec::new();
    }
    let mut instances: Vec<Instance> = Vec::new();
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
                            DAffine3::from_translation(-origin)
                                * place
                                * DAffine3::from_translation(job.origin)
                        })
                        .collect(),
                };
                instances.extend(transforms.into_iter().map(|transform| Instance {
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
        // The caller checks where this ends.
        instance.first_index = next as u32;
        next += u64::from(instance.triangle_count).next_multiple_of(Instance::ALIGNMENT.into());
    }
    instances
}

/// Corners of the box around a placement; undefined where a position is.
fn bounds(placement: &Placement<'_>) -> (DVec3, DVec3) {
    (0..placement.primitive.positions.len())
        .into_par_iter()
        .with_min_len(CHUNK)
        .fold(empty_box, |(low, high), v| {
            let position = placement.position(v);
            // Minima and maxima would drop a NaN.
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

/// Runs of triangles with one material and class.
fn draws(jobs: &[Job<'_, '_>]) -> Vec<Draw> {
    let mut draws: Vec<Draw> = Vec::new();
    let mut first_triangle = 0;
    for job in jobs {
        let (material, class) = (job.placement.primitive.material as u32, job.class);
        let triangle_count = job.triangle_count();
        match draws.last_mut() {
            Some(last) if last.material == material && last.class == class => {
                last.triangle_count += triangle_count;
            }
            _ => draws.push(Draw {
                first_triangle,
                triangle_count,
                material,
                class,
            }),
        }
        first_triangle += triangle_count;
    }
    draws
}

/// The parts of all streams that one job fills; a stream that the geometry lacks is empty.
struct Parts<'g> {
    positions: &'g mut [[f32; 3]],
    normals: &'g mut [[f32; 3]],
    tangents: &'g mut [[f32; 4]],
    uvs: &'g mut [[f32; 4]],
    colors: &'g mut [[f32; 4]],
    scales: &'g mut [f32],
    triangles: &'g mut [[u32; 3]],
}

fn fill(jobs: &[Job<'_, '_>], geometry: &mut Geometry) {
    let streams = &mut geometry.streams;
    let mut rest = Parts {
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
            Parts {
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
    work.into_par_iter()
        .for_each(|(job, parts)| job.fill(parts));
}

/// Cuts the first `count` elements off, or nothing where the stream is empty.
fn take<'g, T>(rest: &mut &'g mut [T], count: usize) -> &'g mut [T] {
    let all = std::mem::take(rest);
    let (part, remaining) = all.split_at_mut(count.min(all.len()));
    *rest = remaining;
    part
}

impl Job<'_, '_> {
    fn fill(&self, parts: Parts<'_>) {
        let (placement, origin) = (&self.placement, self.origin);
        let primitive = placement.primitive;
        copy(parts.uvs, &primitive.uvs);
        copy(parts.colors, &primitive.colors);
        for (v, scale) in parts.scales.iter_mut().enumerate() {
            *scale = placement.frame(v).scale();
        }
        for (to, &[a, b, c]) in parts.triangles.iter_mut().zip(&primitive.triangles) {
            // Points and lines face the camera in any case.
            let triangle = if placement.mirrored && !primitive.is_strokes() {
                [a, c, b]
            } else {
                [a, b, c]
            };
            *to = triangle.map(|v| v + self.first_vertex);
        }
        parts
            .positions
            .par_chunks_mut(CHUNK)
            .enumerate()
            .for_each(|(chunk, positions)| {
                for (v, to) in (chunk * CHUNK..).zip(positions) {
                    *to = (placement.position(v) - origin).as_vec3().to_array();
                }
            });
        parts
            .normals
            .par_chunks_mut(CHUNK)
            .enumerate()
            .for_each(|(chunk, normals)| {
                if primitive.is_flat() {
                    self.flat_normals(chunk * CHUNK, normals);
                    return;
                }
                for (v, to) in (chunk * CHUNK..).zip(normals) {
                    *to = placement.normal(v, &placement.frame(v));
                }
            });
        if !primitive.tangents.is_empty() {
            parts
                .tangents
                .par_chunks_mut(CHUNK)
                .enumerate()
                .for_each(|(chunk, tangents)| {
                    for (v, to) in (chunk * CHUNK..).zip(tangents) {
                        *to = placement.tangent(v, &placement.frame(v));
                    }
                });
        }
    }

    /// Corners of its points and lines.
    fn strokes(&self) -> impl Iterator<Item = Stroke> {
        let primitive = self.placement.primitive;
        let first = self.first_vertex;
        let corners = primitive.positions.len() - primitive.corners.len();
        let vertices = first + corners as u32..;
        vertices
            .zip(&primitive.corners)
            .map(move |(vertex, corner)| Stroke {
                part: corner.part,
                vertex,
                at: first + corner.at,
                other: first + corner.other,
                beyond: first + corner.beyond,
                faces_camera: primitive.normals.is_empty(),
            })
    }

    /// Edges of its mesh.
    fn edges(&self) -> impl Iterator<Item = Edge> {
        let edges = self.placement.primitive.edges.iter();
        edges.map(|edge| edge.placed(self.first_vertex, self.placement.mirrored))
    }

    /// Normals of triangles that have three vertices each for themselves, from vertex `first` on.
    fn flat_normals(&self, first: usize, normals: &mut [[f32; 3]]) {
        for (triangle, normals) in normals.chunks_mut(3).enumerate() {
            let v = first + 3 * triangle;
            let [a, b, c] = [v, v + 1, v + 2].map(|v| self.placement.position(v));
            let face = (b - a).cross(c - a).normalize_or(DVec3::Z);
            let outward = if self.placement.mirrored { -face } else { face };
            normals.fill(outward.as_vec3().to_array());
        }
    }
}

/// Copies a stream that the primitive has; another one keeps its defaults.
fn copy(to: &mut [[f32; 4]], from: &[[f32; 4]]) {
    if to.len() == from.len() {
        to.copy_from_slice(from);
    }
}

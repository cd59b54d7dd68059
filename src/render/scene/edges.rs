//! Edges of meshes, drawn as lines over them.

use std::collections::HashMap;

use glam::DVec3;
use rayon::prelude::*;

use super::{
    Material, Scene,
    document::{Displacements, Influences, Primitive},
    stroke::Edge,
    surface::triangles,
};

/// Choice and colour of the edges that are drawn over meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edges {
    /// Colour of the lines, linear light.
    pub color: [f32; 3],
    /// Threshold of creases in degrees: an edge is a crease if the normals of its faces differ by more.
    pub crease: f64,
}

impl Edges {
    /// Default threshold of creases in degrees.
    pub const DEFAULT_CREASE: f64 = 30.0;
}

impl Default for Edges {
    /// Black edges with the default threshold.
    fn default() -> Self {
        Self { color: [0.0; 3], crease: Self::DEFAULT_CREASE }
    }
}

/// Adds the edges of all meshes of a scene to it.
pub fn add(scene: &mut Scene, edges: &Edges) {
    let [r, g, b] = edges.color;
    let material = scene.materials.len();
    scene.materials.push(Material { base_color: [r, g, b, 1.0], unlit: true, ..Material::default() });
    let materials = &scene.materials;
    scene.document.meshes.par_iter_mut().for_each(|mesh| {
        let mut groups: Vec<Vec<&Primitive>> = Vec::new();
        for primitive in mesh.iter().filter(|primitive| !primitive.is_strokes()) {
            // Primitives whose numbers of joint sets or morph targets differ do not move in the same way.
            let alike = |other: &&Primitive| {
                other.influences.len() == primitive.influences.len() && other.targets.len() == primitive.targets.len()
            };
            match groups.iter_mut().find(|g| g.first().is_some_and(alike)) {
                Some(group) => group.push(primitive),
                None => groups.push(vec![primitive]),
            }
        }
        let drawn = groups
            .iter()
            .map(|group| MergedPrimitives::new(group, materials).edges(edges.crease, material))
            .filter(Primitive::is_strokes);
        let drawn: Vec<Primitive> = drawn.collect();
        mesh.extend(drawn);
    });
}

/// Primitives whose vertices are merged if their positions are equal.
struct MergedPrimitives<'p> {
    primitives: &'p [&'p Primitive],
    /// Primitive and vertex of each merged vertex.
    vertices: Vec<(usize, usize)>,
    faces: Vec<MergedFace>,
}

struct MergedFace {
    corners: [u32; 3],
    is_double_sided: bool,
}

/// Directed side of a face.
#[derive(Clone, Copy)]
struct HalfEdge {
    from: u32,
    to: u32,
    opposite: u32,
    face: u32,
}

impl HalfEdge {
    fn key(&self) -> (u32, u32) {
        (self.from.min(self.to), self.from.max(self.to))
    }
}

impl<'p> MergedPrimitives<'p> {
    fn new(primitives: &'p [&'p Primitive], materials: &[Material]) -> Self {
        let mut surface = Self { primitives, vertices: Vec::new(), faces: Vec::new() };
        let mut at_place: HashMap<[u32; 3], u32> = HashMap::new();
        let mut known: HashMap<[u32; 3], usize> = HashMap::new();
        for (index, primitive) in primitives.iter().enumerate() {
            let material = materials.get(primitive.material);
            let is_double_sided = material.is_some_and(|material| material.double_sided);
            let mut shared = |v: usize| {
                // Adding 0 turns a negative zero into a positive one.
                let place = primitive.positions[v].map(|x| (x + 0.0).to_bits());
                *at_place.entry(place).or_insert_with(|| {
                    surface.vertices.push((index, v));
                    surface.vertices.len() as u32 - 1
                })
            };
            for triangle in &primitive.triangles {
                let corners = triangle.map(|v| shared(v as usize));
                let [a, b, c] = corners;
                if a == b || b == c || c == a {
                    continue;
                }
                let mut sorted = corners;
                sorted.sort_unstable();
                let next = surface.faces.len();
                let face = *known.entry(sorted).or_insert(next);
                match surface.faces.get_mut(face) {
                    // Two faces with the same corners in opposite order are one double-sided face.
                    Some(face) => face.is_double_sided = true,
                    None => surface.faces.push(MergedFace { corners, is_double_sided }),
                }
            }
        }
        surface
    }

    fn position(&self, vertex: u32) -> DVec3 {
        let (primitive, v) = self.vertices[vertex as usize];
        DVec3::from_array(self.primitives[primitive].positions[v].map(f64::from))
    }

    /// Makes lines of the edges, with the material of this index.
    fn edges(&self, crease: f64, material: usize) -> Primitive {
        let mut sides: Vec<HalfEdge> = (0..)
            .zip(&self.faces)
            .flat_map(|(face, MergedFace { corners, .. })| {
                let [a, b, c] = *corners;
                [[a, b, c], [b, c, a], [c, a, b]].map(|[from, to, opposite]| HalfEdge { from, to, opposite, face })
            })
            .collect();
        sides.par_sort_unstable_by_key(|side| (side.key(), side.face));
        let smallest_cosine = crease.to_radians().cos();
        let deforms = |p: &&Primitive| !p.targets.is_empty() || !p.influences.is_empty();
        let deforms = self.primitives.iter().any(deforms);
        let mut edges = Vec::new();
        for group in sides.chunk_by(|a, b| a.key() == b.key()) {
            let [first, rest @ ..] = group else {
                continue;
            };
            let is_double_sided = |side: &HalfEdge| self.faces[side.face as usize].is_double_sided;
            let turned = |side: &HalfEdge| side.from == first.from;
            let second = rest.first();
            let normals = match rest {
                [second] => Some(self.normals(first, second.opposite)),
                _ => None,
            };
            // Two faces in the same plane are seen from the same side in every view, so that their edge is never a
            // silhouette.
            if !deforms && normals.is_some_and(is_flat) && !rest.iter().any(turned) {
                continue;
            }
            edges.push(Edge {
                first_vertex: 0,
                ends: [first.from, first.to],
                opposite: [first.opposite, second.map_or(first.from, |side| side.opposite)],
                is_smooth: normals.is_some_and(|[normal, other]| normal.dot(other) >= smallest_cosine),
                is_double_sided: group.iter().any(is_double_sided) || rest.iter().any(turned) || rest.len() > 1,
            });
        }
        let sources = compact(&mut edges, self.vertices.len());
        let sources: Vec<(usize, usize)> = sources.iter().map(|&v| self.vertices[v as usize]).collect();
        self.primitive(edges, &sources, material)
    }

    /// Normals of a side's face and of the neighbouring face, whose third vertex is `beyond`; zero for a face without
    /// area.
    fn normals(&self, side: &HalfEdge, beyond: u32) -> [DVec3; 2] {
        let [from, to] = [side.from, side.to].map(|v| self.position(v));
        let along = to - from;
        let normal = along.cross(self.position(side.opposite) - from);
        let other = (-along).cross(self.position(beyond) - to);
        [normal, other].map(DVec3::normalize_or_zero)
    }

    /// Makes a primitive of edges with these vertices, which move like the surface's vertices.
    fn primitive(&self, edges: Vec<Edge>, sources: &[(usize, usize)], material: usize) -> Primitive {
        let first = self.primitives.first();
        let targets = (0..first.map_or(0, |p| p.targets.len())).map(|target| {
            let displacement = |&(primitive, v): &(usize, usize)| {
                let target = self.primitives[primitive].targets.get(target);
                let own = target.and_then(|target| target.positions.get(v));
                own.copied().unwrap_or_default()
            };
            Displacements { positions: sources.iter().map(displacement).collect(), ..Displacements::default() }
        });
        let influences = (0..first.map_or(0, |p| p.influences.len())).map(|set| {
            let sets = sources.iter().filter_map(|&(primitive, v)| {
                let set = self.primitives[primitive].influences.get(set)?;
                Some((*set.joints.get(v)?, *set.weights.get(v)?))
            });
            let (joints, weights) = sets.unzip();
            Influences { joints, weights }
        });
        Primitive {
            material,
            positions: sources.iter().map(|&(primitive, v)| self.primitives[primitive].positions[v]).collect(),
            targets: targets.collect(),
            influences: influences.collect(),
            triangles: edges.iter().flat_map(Edge::triangles).collect(),
            edges,
            ..Primitive::default()
        }
    }
}

/// Keeps only the vertices that edges and their corners refer to; returns their indices and renumbers the edges.
fn compact(edges: &mut [Edge], vertex_count: usize) -> Vec<u32> {
    let named = |edge: &Edge| {
        let ([from, to], [a, b]) = (edge.ends, edge.opposite);
        [[from, to, from], [a, b, from]]
    };
    let mut named: Vec<[u32; 3]> = edges.iter().flat_map(named).collect();
    let used = triangles::compact(&mut named, vertex_count);
    let corners = (used.len() as u32..).step_by(Edge::CORNERS as usize);
    for ((edge, named), first_vertex) in edges.iter_mut().zip(named.as_chunks().0).zip(corners) {
        let [[from, to, _], [a, b, _]] = *named;
        (edge.first_vertex, edge.ends, edge.opposite) = (first_vertex, [from, to], [a, b]);
    }
    let of_corners = edges.iter().flat_map(Edge::corners);
    let of_corners: Vec<u32> = of_corners.map(|v| used[v as usize]).collect();
    [used, of_corners].concat()
}

/// Whether faces with these normals lie in the same plane, apart from rounding of positions.
fn is_flat([normal, other]: [DVec3; 2]) -> bool {
    /// Largest sine of the angle between normals that counts as rounding.
    const ROUNDED: f64 = 1e-4;
    normal.dot(other) > 0.0 && normal.cross(other).length() < ROUNDED
}

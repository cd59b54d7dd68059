//! Motion of a scene. Each of its moments holds matrices, weights, materials and lights, which are all that a device
//! needs to show the moment.

mod bounds;

pub(crate) use bounds::MovingBounds;

use std::{
    collections::BTreeMap,
    hash::{DefaultHasher, Hash, Hasher},
    mem::discriminant,
    sync::Arc,
};

use glam::{DAffine3, DVec3};
use gltf::json::animation::Property;

use super::{MovingPlacement, Placement, Pose, PoseRequest, light_of, looks, show};
use crate::scene::{
    Light, Material, Scene, SceneCamera, SceneError,
    document::{Animated, Channel, Described, Displacements},
    error::Warnings,
};

/// Nodes that an animation moves or deforms, and other properties that it changes.
#[derive(Debug, Default)]
pub struct Moving {
    /// Whether each node's position in the world may change; empty if none may.
    places: Vec<bool>,
    /// Whether each node's morph weights may change; empty if none may.
    weights: Vec<bool>,
    /// Indices of the materials that may change.
    materials: Vec<usize>,
    lights: bool,
}

impl Moving {
    /// Collects the nodes, materials and lights that these channels change.
    pub fn new(scene: &Scene, animation: &[Channel]) -> Self {
        let document = &scene.document;
        let mut lights = false;
        let mut places = vec![false; document.nodes.len()];
        let mut weights = places.clone();
        for channel in animation {
            match channel.target {
                Animated::Node(node, Property::MorphTargetWeights) | Animated::Weight(node, _) => {
                    weights[node] = true;
                }
                Animated::Node(node, _) => places[node] = true,
                Animated::Description(Described::Light(_), _) => lights = true,
                // Materials are collected below. A change of visibility needs a new pose.
                Animated::Description(..) | Animated::Visibility(_) => {}
            }
        }
        for &index in &document.order {
            let parent = document.nodes[index].parent;
            places[index] = places[index] || parent.is_some_and(|parent| places[parent]);
        }
        let carries_light = |index: usize| {
            let node = document.root.nodes.get(index);
            node.is_some_and(|node| light_of(&document.lights, node).is_some())
        };
        lights |= (0..places.len()).any(|index| places[index] && carries_light(index));
        Self { places, weights, materials: looks::changing_materials(scene, animation), lights }
    }

    /// Whether an animation moves a node.
    pub fn places(&self, index: usize) -> bool {
        self.places.get(index) == Some(&true)
    }

    /// Whether an animation moves a node or deforms its mesh by morph targets.
    pub fn has(&self, index: usize) -> bool {
        self.places(index) || self.weights.get(index) == Some(&true)
    }
}

/// Moving parts of a [`Pose`]: skins, morph targets, and meshes of animated nodes. A renderer that has uploaded them
/// shows other [moments](Self::at) without reading any vertex.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Identity that the motion shares only with its moments.
    pub(crate) identity: Arc<()>,
    /// Fingerprint of the vertices of the first pose.
    first_pose: u64,
    request: PoseRequest,
    origin: DVec3,
    /// Lights of the first pose.
    lights: Vec<Light>,
    /// Whether lights change.
    pub(crate) changes_lights: bool,
    /// Indices of materials that change.
    pub(crate) materials: Vec<usize>,
    placements: usize,
    pub(crate) parts: Vec<MotionPart>,
    /// Position, normal and tangent of each vertex as it rests in its mesh.
    pub(crate) vertices: Vec<[[f32; 4]; 3]>,
    /// Joints and weights of a set for each vertex; the weights as bits.
    pub(crate) influences: Vec<[[u32; 4]; 2]>,
    /// Displacements of positions, or of positions, normals and tangents alternately.
    pub(crate) displacements: Vec<[f32; 4]>,
}

/// Vertices of a mesh that move in the same way.
#[derive(Clone, Copy, Debug)]
pub struct MotionPart {
    placement: usize,
    pub mirrored: bool,
    /// Index of the first vertex in the geometry.
    pub first_vertex: u32,
    pub vertex_count: u32,
    /// Index in [`Motion::vertices`] of the first vertex at rest.
    pub first_resting: u32,
    /// Index in [`Motion::influences`] of the first influence; those of a set follow each other.
    pub first_influence: u32,
    pub sets: u32,
    /// Index in [`Motion::displacements`] of the first displacement; those of a target follow each other.
    pub first_displacement: u32,
    /// Number of displacement vectors for each vertex.
    pub displacement_vectors: u32,
    matrix_count: u32,
    target_count: u32,
    /// Whether normals are those of the triangles, each of which has three vertices to itself.
    pub is_flat: bool,
}

/// Matrices and weights of moving parts, and the materials and lights that change, at one moment.
#[derive(Clone, Debug)]
pub struct Moment {
    /// Identity of the motion.
    pub(crate) identity: Arc<()>,
    /// Cameras at the moment, as in [`Pose::cameras`].
    pub cameras: Vec<SceneCamera>,
    /// Materials that change, with their indices.
    pub(crate) materials: Vec<(usize, Material)>,
    pub(crate) lights: Vec<Light>,
    /// Three rows of each matrix to the geometry's space, and the weight and index of each target with a weight.
    pub(crate) vectors: Vec<[f32; 4]>,
    pub(crate) parts: Vec<MomentPart>,
}

/// Positions of a [`MotionPart`]'s vectors in [`Moment::vectors`].
#[derive(Clone, Copy, Debug)]
pub struct MomentPart {
    pub first_matrix: u32,
    pub first_weight: u32,
    pub weight_count: u32,
}

/// Fingerprint of a pose's vertices.
fn fingerprint(pose: &Pose) -> u64 {
    let mut hasher = DefaultHasher::new();
    let positions: &[u8] = bytemuck::cast_slice(&pose.geometry.positions);
    positions.hash(&mut hasher);
    hasher.finish()
}

impl Motion {
    pub(super) fn new(
        request: &PoseRequest,
        pose: &Pose,
        placements: &[Placement<'_>],
        moving: &Moving,
        placed: &[MovingPlacement],
    ) -> Self {
        let mut motion = Self {
            identity: Arc::new(()),
            first_pose: fingerprint(pose),
            request: request.clone(),
            origin: pose.geometry.origin,
            lights: pose.lights.clone(),
            changes_lights: moving.lights,
            materials: moving.materials.clone(),
            placements: placements.len(),
            parts: Vec::new(),
            vertices: Vec::new(),
            influences: Vec::new(),
            displacements: Vec::new(),
        };
        for part in placed {
            if let Some(placement) = placements.get(part.placement) {
                motion.add(part, placement);
            }
        }
        motion
    }

    fn add(&mut self, part: &MovingPlacement, placement: &Placement<'_>) {
        let primitive = placement.primitive;
        let sets = if placement.is_skinned() { primitive.influences.as_slice() } else { &[] };
        let turns = |target: &Displacements| !target.normals.is_empty() || !target.tangents.is_empty();
        let displacement_vectors = if primitive.targets.iter().any(turns) { 3 } else { 1 };
        let vertices = 0..primitive.positions.len();
        self.parts.push(MotionPart {
            placement: part.placement,
            mirrored: placement.mirrored,
            first_vertex: part.first_vertex,
            vertex_count: vertices.len() as u32,
            first_resting: self.vertices.len() as u32,
            first_influence: self.influences.len() as u32,
            sets: sets.len() as u32,
            first_displacement: self.displacements.len() as u32,
            displacement_vectors,
            matrix_count: placement.matrices().len() as u32,
            target_count: primitive.targets.len() as u32,
            is_flat: primitive.is_flat(),
        });
        let vector = |stream: &[[f32; 3]], v: usize| {
            let [x, y, z] = stream.get(v).copied().unwrap_or_default();
            [x, y, z, 0.0]
        };
        self.vertices.extend(vertices.clone().map(|v| {
            let tangent = primitive.tangents.get(v).copied();
            [vector(&primitive.positions, v), vector(&primitive.normals, v), tangent.unwrap_or([1.0, 0.0, 0.0, 1.0])]
        }));
        for set in sets {
            let pairs = set.joints.iter().zip(&set.weights);
            let bits = |(joints, weights): (&[u16; 4], &[f32; 4])| [joints.map(u32::from), weights.map(f32::to_bits)];
            self.influences.extend(pairs.map(bits));
        }
        for target in &primitive.targets {
            for v in vertices.clone() {
                let streams = [&target.positions, &target.normals, &target.tangents];
                let vectors = streams.into_iter().take(displacement_vectors as usize);
                let vectors = vectors.map(|stream| vector(stream, v));
                self.displacements.extend(vectors);
            }
        }
    }

    /// Whether a pose has the vertices of the one that was made with this motion.
    pub(crate) fn is_of(&self, pose: &Pose) -> bool {
        self.first_pose == fingerprint(pose)
    }

    /// Largest number of vectors of a [`Moment`].
    pub(crate) fn vector_count(&self) -> u64 {
        let of = |part: &MotionPart| 3 * u64::from(part.matrix_count) + u64::from(part.target_count);
        self.parts.iter().map(of).sum()
    }

    /// Makes another moment of the same animation and scene, at `time` in seconds. `None` if the first pose can't be
    /// moved there, so that the scene has to be posed anew: a mesh turns inside out, meshes or lights appear or
    /// disappear, or a number leaves its range.
    ///
    /// # Errors
    /// As [`Scene::pose`].
    pub fn at(&self, scene: &Scene, time: f64) -> Result<Option<Moment>, SceneError> {
        let request = PoseRequest { time, ..self.request.clone() };
        let mut warnings = Warnings::new(&scene.document.file);
        let shown = show(scene, &request, &Moving::default(), &mut warnings)?;
        let kinds = |lights: &[Light]| -> Vec<_> { lights.iter().map(|light| discriminant(&light.kind)).collect() };
        let is_alike = shown.placements.len() == self.placements && kinds(&shown.lights) == kinds(&self.lights);
        if !is_alike {
            return Ok(None);
        }
        let mut moment = Moment {
            identity: self.identity.clone(),
            cameras: shown.cameras,
            materials: self.materials_of(scene, shown.materials),
            lights: shown.lights,
            vectors: Vec::new(),
            parts: Vec::new(),
        };
        for part in &self.parts {
            let placement = shown.placements.get(part.placement);
            let Some(placement) = placement.filter(|p| p.mirrored == part.mirrored) else {
                return Ok(None);
            };
            let first_matrix = moment.vectors.len() as u32;
            for matrix in placement.matrices() {
                moment.vectors.extend(rows(matrix, self.origin));
            }
            let first_weight = moment.vectors.len() as u32;
            let weights = placement.targets.iter();
            let weights = weights.map(|(weight, index, _)| [*weight as f32, *index as f32, 0.0, 0.0]);
            moment.vectors.extend(weights);
            moment.parts.push(MomentPart { first_matrix, first_weight, weight_count: placement.targets.len() as u32 });
        }
        let finite = |vector: &[f32; 4]| vector.iter().all(|value| value.is_finite());
        Ok(Some(moment).filter(|moment| moment.vectors.iter().all(finite)))
    }

    /// Materials that may change: from `shown` if they are there, otherwise as they are at rest.
    fn materials_of(&self, scene: &Scene, shown: Vec<(usize, Material)>) -> Vec<(usize, Material)> {
        let mut shown: BTreeMap<usize, Material> = shown.into_iter().collect();
        let at_rest = |index: usize| scene.materials.get(index).cloned();
        let material = |&index: &usize| {
            let material = shown.remove(&index).or_else(|| at_rest(index))?;
            Some((index, material))
        };
        self.materials.iter().filter_map(material).collect()
    }
}

/// Rows of a matrix to the space around an origin.
fn rows(matrix: &DAffine3, origin: DVec3) -> [[f32; 4]; 3] {
    let linear = matrix.matrix3.transpose();
    let offset = matrix.translation - origin;
    let row = |axis: DVec3, offset: f64| [axis.x, axis.y, axis.z, offset].map(|value| value as f32);
    [row(linear.x_axis, offset.x), row(linear.y_axis, offset.y), row(linear.z_axis, offset.z)]
}

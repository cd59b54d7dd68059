//! Placements: a primitive at one place, and the transform of its vertices to the world.

use std::{collections::HashMap, sync::Arc};

use glam::{DAffine3, DMat3, DVec3, Vec3};
use gltf::json::Node;

use super::{copies, hierarchy::NodeStates, motion::Moving, primitives_of};
use crate::scene::{
    document::{Displacements, Document, Primitive, Skin},
    geometry::length_scale,
};

/// Morph targets that have an effect: weight, index, displacements.
type WeightedTargets<'d> = Arc<[(f64, usize, &'d Displacements)]>;

/// A primitive, and the transform of its vertices to the world.
#[derive(Clone, Debug)]
pub struct Placement<'d> {
    /// Index of the node, for messages.
    pub node: usize,
    pub primitive: &'d Primitive,
    pub targets: WeightedTargets<'d>,
    motion: VertexMotion,
    /// Whether the device moves the vertices.
    pub moves: bool,
    /// Whether the transform to the world mirrors, so that the winding has to be reversed.
    pub mirrored: bool,
}

#[derive(Clone, Debug)]
enum VertexMotion {
    Rigid(VertexTransform),
    /// Transform of every joint, from the space of the bound mesh to the world.
    Skinned(Arc<[DAffine3]>),
}

/// Transform of one vertex.
#[derive(Clone, Copy, Debug)]
pub struct VertexTransform {
    affine: DAffine3,
    /// Inverse transpose up to a positive factor, which exists even if the inverse does not.
    normals: DMat3,
    sign: f64,
}

impl VertexTransform {
    fn new(affine: DAffine3) -> Self {
        let m = affine.matrix3;
        let sign = 1.0_f64.copysign(m.determinant());
        let cofactors = DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
        Self { affine, normals: cofactors * sign, sign }
    }

    /// Factor by which the transform enlarges lengths.
    pub fn scale(&self) -> f32 {
        length_scale(&self.affine) as f32
    }
}

/// Skin at one moment.
struct SkinState {
    /// Transform of every joint, from the space of the bound mesh to the world.
    matrices: Arc<[DAffine3]>,
    /// Whether all of them mirror.
    mirrored: bool,
    /// Whether a joint may move later.
    moves: bool,
}

impl SkinState {
    /// As the specification says, the transform of a node with the skin is ignored.
    fn new(skin: &Skin, state: &NodeStates, moving: &Moving) -> Self {
        let world = |joint: usize| state.world.get(joint).copied().unwrap_or_default();
        let joints = skin.joints.iter().zip(&skin.inverse_bind);
        let matrices: Arc<[_]> = joints.map(|(&joint, bind)| world(joint) * *bind).collect();
        let mirrors = |joint: &DAffine3| joint.matrix3.determinant() < 0.0;
        Self {
            mirrored: matrices.iter().all(mirrors),
            matrices,
            moves: skin.joints.iter().any(|&joint| moving.places(joint)),
        }
    }
}

/// Makes the placements of nodes at one moment. What several nodes share is computed once.
pub struct Placer<'d, 's> {
    document: &'d Document,
    state: &'s NodeStates,
    moving: &'s Moving,
    skins: HashMap<usize, SkinState>,
    /// Targets of the primitives of each mesh with the mesh's own weights.
    targets: HashMap<usize, Arc<[WeightedTargets<'d>]>>,
}

impl<'d, 's> Placer<'d, 's> {
    pub fn new(document: &'d Document, state: &'s NodeStates, moving: &'s Moving) -> Self {
        Self { document, state, moving, skins: HashMap::new(), targets: HashMap::new() }
    }

    /// Targets of the primitives of a node's mesh.
    fn targets_of(&mut self, index: usize, node: &'d Node) -> Arc<[WeightedTargets<'d>]> {
        let document = self.document;
        let weighted = |weights: &[f64]| {
            let of_primitive = |primitive: &'d Primitive| {
                let weighted = weights.iter().zip(primitive.targets.iter().enumerate());
                let weighted = weighted.filter(|(weight, (_, target))| **weight != 0.0 && target.displaces());
                let weighted = weighted.map(|(weight, (index, target))| (*weight, index, target));
                weighted.collect()
            };
            let primitives = primitives_of(document, node).iter();
            primitives.map(of_primitive).collect()
        };
        let animated = self.state.weights.get(index).and_then(Option::as_deref);
        match (animated, &node.weights, node.mesh) {
            (Some(weights), ..) => weighted(weights),
            (None, None, Some(mesh)) => {
                let of_mesh = || weighted(&document.weights(index));
                let known = self.targets.entry(mesh.value()).or_insert_with(of_mesh);
                Arc::clone(known)
            }
            _ => weighted(&document.weights(index)),
        }
    }

    /// Placements of all primitives of a node, one for each time that it draws them.
    pub fn of_node(&mut self, index: usize, node: &'d Node) -> Vec<Placement<'d>> {
        let document = self.document;
        let primitives = primitives_of(document, node);
        if primitives.is_empty() {
            return Vec::new();
        }
        let targets = self.targets_of(index, node);
        let (state, moving) = (self.state, self.moving);
        let world = state.world.get(index).copied().unwrap_or_default();
        let skin = node.skin.map(|skin| skin.value());
        let skin = skin.and_then(|skin| Some((skin, document.skins.get(skin)?)));
        let skin = skin.map(|(skin, found)| {
            let known = self.skins.entry(skin);
            &*known.or_insert_with(|| SkinState::new(found, state, moving))
        });
        let moves = moving.has(index) || skin.is_some_and(|skin| skin.moves);

        let mut placements = Vec::new();
        for copy in 0..copies(document, index) {
            let instance = document.nodes[index].instances.as_ref().and_then(|i| i.get(copy));
            let rigid = VertexTransform::new(world * instance.copied().unwrap_or_default());
            for (primitive, targets) in primitives.iter().zip(targets.iter()) {
                let (motion, mirrored) = match skin {
                    Some(skin) if !primitive.influences.is_empty() => {
                        let matrices = Arc::clone(&skin.matrices);
                        (VertexMotion::Skinned(matrices), skin.mirrored)
                    }
                    _ => (VertexMotion::Rigid(rigid), rigid.sign < 0.0),
                };
                placements.push(Placement {
                    moves,
                    node: index,
                    primitive,
                    targets: Arc::clone(targets),
                    motion,
                    mirrored,
                });
            }
        }
        placements
    }
}

impl<'d> Placement<'d> {
    /// Number of displacements of its vertices by morph targets. Those of a moving mesh may all have an effect later.
    pub fn displacements(&self) -> usize {
        let targets = if self.moves { self.primitive.targets.len() } else { self.targets.len() };
        self.primitive.positions.len().saturating_mul(targets)
    }

    /// Mesh of the placement; `None` unless a [`rigid`](Self::rigid) transform is all that tells placements of the mesh
    /// apart.
    pub fn mesh(&self) -> Option<&'d Primitive> {
        let is_rigid = matches!(self.motion, VertexMotion::Rigid(_)) && self.targets.is_empty() && !self.moves;
        is_rigid.then_some(self.primitive)
    }

    /// Transform from the mesh's space to the world, if all vertices have the same.
    pub fn rigid(&self) -> Option<DAffine3> {
        match &self.motion {
            VertexMotion::Rigid(frame) => Some(frame.affine),
            VertexMotion::Skinned(_) => None,
        }
    }

    /// Transforms from the mesh's space to the world: those of all joints, or the one of the node.
    pub fn matrices(&self) -> &[DAffine3] {
        match &self.motion {
            VertexMotion::Rigid(frame) => std::slice::from_ref(&frame.affine),
            VertexMotion::Skinned(joints) => joints,
        }
    }

    /// Whether its vertices follow joints.
    pub fn is_skinned(&self) -> bool {
        matches!(self.motion, VertexMotion::Skinned(_))
    }

    /// Placement of the same mesh at another place.
    pub fn at(&self, affine: DAffine3) -> Self {
        let frame = VertexTransform::new(affine);
        Self { motion: VertexMotion::Rigid(frame), mirrored: frame.sign < 0.0, ..self.clone() }
    }

    /// Transform of vertex `v`.
    #[inline]
    pub fn frame(&self, v: usize) -> VertexTransform {
        match &self.motion {
            VertexMotion::Rigid(frame) => *frame,
            VertexMotion::Skinned(joints) => VertexTransform::new(self.blend(joints, v)),
        }
    }

    /// The weighted sum of the matrices of a vertex's joints.
    fn blend(&self, joints: &[DAffine3], v: usize) -> DAffine3 {
        let mut blended = DAffine3::ZERO;
        for set in &self.primitive.influences {
            let (Some(indices), Some(weights)) = (set.joints.get(v), set.weights.get(v)) else {
                continue;
            };
            for (&joint, &weight) in indices.iter().zip(weights) {
                if weight != 0.0
                    && let Some(joint) = joints.get(usize::from(joint))
                {
                    let weight = f64::from(weight);
                    blended.matrix3 += joint.matrix3 * weight;
                    blended.translation += joint.translation * weight;
                }
            }
        }
        blended
    }

    /// Position of vertex `v` in the world.
    #[inline]
    pub fn position(&self, v: usize) -> DVec3 {
        let position = self.morph(v, self.primitive.positions[v], |t| &t.positions);
        match &self.motion {
            VertexMotion::Rigid(frame) => frame.affine.transform_point3(position),
            VertexMotion::Skinned(joints) => self.blend(joints, v).transform_point3(position),
        }
    }

    /// Unit normal of vertex `v` in the world.
    #[inline]
    pub fn normal(&self, v: usize, frame: &VertexTransform) -> [f32; 3] {
        let own = self.primitive.normals.get(v).copied();
        let normal = self.morph(v, own.unwrap_or_default(), |t| &t.normals);
        unit(frame.normals * normal, DVec3::Z)
    }

    /// Unit tangent of vertex `v` in the world. If the transform mirrors, the bitangent's sign changes, because cross
    /// products do not mirror.
    #[inline]
    pub fn tangent(&self, v: usize, frame: &VertexTransform) -> [f32; 4] {
        let [x, y, z, sign] = self.primitive.tangents[v];
        let tangent = self.morph(v, [x, y, z], |t| &t.tangents);
        let [x, y, z] = unit(frame.affine.transform_vector3(tangent), DVec3::X);
        [x, y, z, sign * frame.sign as f32]
    }

    #[inline]
    fn morph(&self, v: usize, base: [f32; 3], stream: fn(&Displacements) -> &Vec<[f32; 3]>) -> DVec3 {
        let mut value = Vec3::from_array(base).as_dvec3();
        for (weight, _, target) in self.targets.iter() {
            if let Some(&displacement) = stream(target).get(v) {
                value += Vec3::from_array(displacement).as_dvec3() * *weight;
            }
        }
        value
    }
}

/// Direction of `v`, even if its squared length is out of a float's range; `otherwise` if it has none.
#[inline]
fn unit(v: DVec3, otherwise: DVec3) -> [f32; 3] {
    let largest = v.abs().max_element();
    let direction = if largest > 0.0 && largest.is_finite() { (v / largest).normalize() } else { otherwise };
    direction.as_vec3().to_array()
}

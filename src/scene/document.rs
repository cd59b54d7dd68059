//! What a glTF file holds, decoded and checked: every index is in range, every number finite unless
//! said otherwise. [`Scene::pose`](super::Scene::pose) works on this alone.

use std::sync::Arc;

use glam::{DAffine3, DQuat, DVec3};

use super::{light::LightKind, view::SceneProjection};

/// The document of a [`Scene`](super::Scene).
#[derive(Clone, Debug, Default)]
pub struct Document {
    /// File name, for messages.
    pub file: String,
    pub asset: Asset,
    pub scenes: Vec<SceneEntry>,
    /// The scene that is drawn unless another is asked for.
    pub default_scene: Option<usize>,
    pub nodes: Vec<Node>,
    /// All nodes, parents before children.
    pub order: Vec<usize>,
    /// Empty where no node refers to the mesh.
    pub meshes: Vec<Mesh>,
    pub skins: Vec<Skin>,
    pub animations: Vec<Animation>,
    /// `None` where a camera is unusable.
    pub cameras: Vec<Option<Camera>>,
    /// `None` where a light is unusable.
    pub lights: Vec<Option<LightSource>>,
}

/// What the file says about itself.
#[derive(Clone, Debug, Default)]
pub struct Asset {
    pub version: String,
    pub generator: Option<String>,
    pub extensions_used: Vec<String>,
    pub extensions_required: Vec<String>,
}

/// One of the file's scenes.
#[derive(Clone, Debug)]
pub struct SceneEntry {
    pub name: Option<String>,
    pub roots: Vec<usize>,
}

/// Where a node is relative to its parent.
#[derive(Clone, Copy, Debug)]
pub enum Transform {
    Matrix(DAffine3),
    Parts(Parts),
}

/// Translation, rotation and scale, each of which can be animated.
#[derive(Clone, Copy, Debug)]
pub struct Parts {
    pub translation: DVec3,
    pub rotation: DQuat,
    pub scale: DVec3,
}

impl Default for Parts {
    fn default() -> Self {
        Self {
            translation: DVec3::ZERO,
            rotation: DQuat::IDENTITY,
            scale: DVec3::ONE,
        }
    }
}

impl Parts {
    pub fn affine(&self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

#[derive(Clone, Debug)]
pub struct Node {
    pub name: Option<String>,
    pub parent: Option<usize>,
    pub children: Vec<usize>,
    pub transform: Transform,
    pub mesh: Option<usize>,
    pub skin: Option<usize>,
    pub camera: Option<usize>,
    pub light: Option<usize>,
    /// Morph weights that replace the mesh's.
    pub weights: Option<Vec<f64>>,
    /// `EXT_mesh_gpu_instancing`: transforms relative to the node.
    pub instances: Option<Arc<[DAffine3]>>,
}

#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub primitives: Vec<Primitive>,
    /// Default morph weights.
    pub weights: Vec<f64>,
}

/// Triangles of one material with only the vertices that they use.
#[derive(Clone, Debug, Default)]
pub struct Primitive {
    /// Index into [`Scene::materials`](super::Scene::materials).
    pub material: usize,
    /// In range of every vertex stream that is not empty.
    pub triangles: Vec<[u32; 3]>,
    pub positions: Vec<[f32; 3]>,
    /// Not zero, not necessarily unit. Empty: flat, and triangle `i` has the vertices `3i`, `3i + 1`,
    /// `3i + 2` for itself.
    pub normals: Vec<[f32; 3]>,
    /// Only where the material has a normal texture.
    pub tangents: Vec<[f32; 4]>,
    /// Both UV sets. Only where the material has a texture.
    pub uvs: Vec<[f32; 4]>,
    /// Only where the primitive has colours.
    pub colors: Vec<[f32; 4]>,
    pub targets: Vec<Target>,
    /// One for each of `JOINTS_0`, `JOINTS_1`, ...
    pub influences: Vec<Influences>,
}

impl Primitive {
    pub fn is_flat(&self) -> bool {
        self.normals.is_empty()
    }
}

/// A morph target's displacements; a stream that it does not displace is empty.
#[derive(Clone, Debug, Default)]
pub struct Target {
    pub positions: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    pub tangents: Vec<[f32; 3]>,
}

/// Four joints and their weights for every vertex. The weights of all sets of a vertex sum to 1.
#[derive(Clone, Debug, Default)]
pub struct Influences {
    pub joints: Vec<[u16; 4]>,
    pub weights: Vec<[f32; 4]>,
}

/// Empty where no node with a mesh refers to it.
#[derive(Clone, Debug, Default)]
pub struct Skin {
    /// Nodes.
    pub joints: Vec<usize>,
    /// One a joint.
    pub inverse_bind: Vec<DAffine3>,
}

#[derive(Clone, Debug)]
pub struct Animation {
    pub name: Option<String>,
    pub channels: Vec<Channel>,
}

impl Animation {
    /// Time of the last keyframe in seconds.
    pub fn duration(&self) -> f64 {
        let ends = self.channels.iter().filter_map(|c| c.times.last());
        ends.fold(0.0, |longest, &end| longest.max(f64::from(end)))
    }
}

/// Keyframes of one property of one node.
#[derive(Clone, Debug)]
pub struct Channel {
    pub node: usize,
    pub path: Path,
    pub interpolation: Interpolation,
    /// Seconds, ascending, at least one.
    pub times: Arc<[f32]>,
    /// `width` numbers a keyframe; three times as many with cubic splines: in-tangent, value,
    /// out-tangent.
    pub values: Arc<[f32]>,
    /// Numbers a value.
    pub width: usize,
}

/// An animated property.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    Translation,
    Rotation,
    Scale,
    Weights,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    Step,
    Linear,
    CubicSpline,
}

#[derive(Clone, Debug)]
pub struct Camera {
    pub name: Option<String>,
    pub projection: SceneProjection,
}

/// A light without a place.
#[derive(Clone, Copy, Debug)]
pub struct LightSource {
    pub kind: LightKind,
    pub color: [f32; 3],
    pub range: Option<f32>,
}

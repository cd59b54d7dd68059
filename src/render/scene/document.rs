//! A file's description as `gltf` has it, and what was decoded and checked by it: every index is in
//! range but for those of cameras and lights, every number finite unless said otherwise.
//! [`Scene::pose`](super::Scene::pose) works on this alone.

use std::{fmt, sync::Arc};

use glam::{DAffine3, DQuat, DVec3};
use gltf::json::{
    Root,
    animation::{Interpolation, Property},
    extensions::scene::khr_materials_variants::Variant,
};

use super::{
    environment::Environment,
    light::Light,
    stroke::{Edge, StrokePart},
    surface::strokes::Corner,
    view::SceneProjection,
};

/// The document of a [`Scene`](super::Scene).
#[derive(Clone, Debug, Default)]
pub struct Document {
    /// File name, for messages.
    pub file: String,
    /// What the file is.
    pub format: &'static str,
    /// Names, references and the hierarchy; without buffers and images.
    pub root: Root,
    /// The scene that is drawn unless another is asked for.
    pub default_scene: Option<usize>,
    pub nodes: Vec<Node>,
    /// All nodes, parents before children.
    pub order: Vec<usize>,
    /// Of every mesh; none where no node refers to it.
    pub meshes: Vec<Vec<Primitive>>,
    pub skins: Vec<Skin>,
    /// Of every animation.
    pub animations: Vec<Vec<Channel>>,
    /// `None` where a camera is unusable.
    pub cameras: Vec<Option<SceneProjection>>,
    /// At the origin and along -Z; `None` where a light is unusable.
    pub lights: Vec<Option<Light>>,
    /// Of every scene, light from all around.
    pub environments: Vec<Option<Arc<Environment>>>,
    /// How many of the scene's materials, the first ones, are the file's.
    pub file_materials: usize,
    /// Materials that are unlit copies, and what they are copies of.
    pub unlit_copies: Vec<(usize, usize)>,
}

impl Document {
    /// Whether each node is drawn, which none below a hidden one is; `own` is what each says of itself.
    pub fn drawn(&self, mut own: Vec<bool>) -> Vec<bool> {
        for &index in &self.order {
            let parent = self.nodes[index].parent;
            own[index] = own[index] && parent.is_none_or(|parent| own[parent]);
        }
        own
    }

    /// Morph weights of a node where nothing animates them: its own, or else those of its mesh.
    pub fn weights(&self, node: usize) -> Vec<f64> {
        let node = self.root.nodes.get(node);
        let mesh = node.and_then(|node| self.root.get(node.mesh?));
        let own = node.and_then(|node| node.weights.as_ref());
        let weights = own.or_else(|| mesh?.weights.as_ref());
        let weights = weights.into_iter().flatten();
        weights.copied().map(f64::from).collect()
    }

    /// Names of the variants of the file's materials.
    pub fn variants(&self) -> impl Iterator<Item = &str> {
        variants(&self.root)
    }
}

/// Names of the variants of materials (`KHR_materials_variants`).
pub fn variants(root: &Root) -> impl Iterator<Item = &str> {
    let variants: &[Variant] = root.as_ref();
    variants.iter().map(|variant| variant.name.as_str())
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

/// What a node's description lacks.
#[derive(Clone, Debug)]
pub struct Node {
    pub parent: Option<usize>,
    pub transform: Transform,
    /// `EXT_mesh_gpu_instancing`: transforms relative to the node.
    pub instances: Option<Arc<[DAffine3]>>,
    /// `KHR_node_visibility`, without that of its ancestors; does not concern cameras.
    pub visible: bool,
}

/// Triangles, points or lines of one material with only the vertices that they use.
#[derive(Clone, Debug, Default)]
pub struct Primitive {
    /// Index into [`Scene::materials`](super::Scene::materials).
    pub material: usize,
    /// In range of every vertex stream that is not empty.
    pub triangles: Vec<[u32; 3]>,
    pub positions: Vec<[f32; 3]>,
    /// Not zero, not necessarily unit. Empty: flat, and triangle `i` has the vertices `3i`, `3i + 1`,
    /// `3i + 2` for itself; or points or lines that face the camera.
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
    /// Of points and lines, the last vertices in their order.
    pub corners: Vec<Corner>,
    /// Of edges of a mesh, whose corners are the last vertices.
    pub edges: Vec<Edge>,
}

impl Primitive {
    pub fn is_flat(&self) -> bool {
        self.normals.is_empty() && !self.is_strokes()
    }

    /// How many points and segments of lines it draws.
    pub fn stroke_counts(&self) -> [usize; 2] {
        let count = |part| self.corners.iter().filter(|c| c.part == part).count();
        [count(StrokePart::Disc(0)), count(StrokePart::Left) / 2]
    }

    /// Whether it is of points or lines, edges among them.
    pub fn is_strokes(&self) -> bool {
        !self.corners.is_empty() || !self.edges.is_empty()
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

/// What a channel animates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Animated {
    /// A property of a node.
    Node(usize, Property),
    /// One morph weight of a node, by its index.
    Weight(usize, usize),
    /// Whether a node and what is below it are drawn.
    Visibility(usize),
    /// What a description has at a JSON pointer that starts from it, without the first slash.
    Description(Described, String),
}

impl fmt::Display for Animated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Node(_, property) => write!(f, "{property:?}"),
            Self::Weight(..) => f.write_str("a weight"),
            Self::Visibility(_) => f.write_str("visibility"),
            Self::Description(_, pointer) => f.write_str(pointer),
        }
    }
}

/// A part of the file of whose description animations may change the numbers, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Described {
    Material(usize),
    Light(usize),
    Camera(usize),
}

/// Time of the last keyframe in seconds.
pub fn duration(channels: &[Channel]) -> f64 {
    let ends = channels.iter().filter_map(|c| c.times.last());
    ends.fold(0.0, |longest, &end| longest.max(f64::from(end)))
}

/// Keyframes of one property.
#[derive(Clone, Debug)]
pub struct Channel {
    pub target: Animated,
    pub interpolation: Interpolation,
    /// Seconds, ascending, at least one.
    pub times: Arc<[f32]>,
    /// `width` numbers a keyframe; three times as many with cubic splines: in-tangent, value,
    /// out-tangent.
    pub values: Arc<[f32]>,
    /// Numbers a value.
    pub width: usize,
}

impl Channel {
    /// The value at keyframe `i`.
    pub fn keyframe(&self, i: usize) -> Vec<f64> {
        match self.interpolation {
            Interpolation::CubicSpline => self.part(i, 1, 3),
            Interpolation::Step | Interpolation::Linear => self.part(i, 0, 1),
        }
    }

    /// The numbers of part `part` of keyframe `i`, of `parts` in all.
    pub fn part(&self, i: usize, part: usize, parts: usize) -> Vec<f64> {
        let start = (i * parts + part) * self.width;
        let numbers = self.values.get(start..start + self.width);
        let numbers = numbers.unwrap_or_default().iter();
        numbers.map(|&x| f64::from(x)).collect()
    }

    /// Whether values are unit quaternions.
    pub fn is_rotation(&self) -> bool {
        matches!(self.target, Animated::Node(_, Property::Rotation))
    }
}

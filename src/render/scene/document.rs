//! Document of a file: its description in `gltf`'s types, and the decoded and checked data. Every index is in range
//! except those of cameras and lights, and every number is finite unless said otherwise.
//! [`Scene::pose`](super::Scene::pose) reads only this document.

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
    /// Format of the file, for messages.
    pub format: &'static str,
    /// Names, references and the hierarchy; without buffers and images.
    pub root: Root,
    /// Index of the scene that is drawn by default.
    pub default_scene: Option<usize>,
    pub nodes: Vec<Node>,
    /// Indices of all nodes, parents before children.
    pub order: Vec<usize>,
    /// Primitives of every mesh; none if no node refers to the mesh.
    pub meshes: Vec<Vec<Primitive>>,
    pub skins: Vec<Skin>,
    /// Channels of every animation.
    pub animations: Vec<Vec<Channel>>,
    /// Projections of all cameras; `None` for an unusable camera.
    pub cameras: Vec<Option<SceneProjection>>,
    /// Lights at the origin, along -Z; `None` for an unusable light.
    pub lights: Vec<Option<Light>>,
    /// Environment of every scene.
    pub environments: Vec<Option<Arc<Environment>>>,
    /// Number of materials in the file; they come first among the scene's materials.
    pub file_materials: usize,
    /// Indices of materials and of their unlit copies, ascending.
    pub unlit_copies: Vec<(usize, usize)>,
}

impl Document {
    /// Whether each node is drawn. `own` is the visibility of each node itself; nothing below a hidden node is drawn.
    pub fn drawn(&self, mut own: Vec<bool>) -> Vec<bool> {
        for &index in &self.order {
            let parent = self.nodes[index].parent;
            own[index] = own[index] && parent.is_none_or(|parent| own[parent]);
        }
        own
    }

    /// Morph weights of a node without animation: the node's own, or otherwise its mesh's.
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

/// Transform of a node relative to its parent.
#[derive(Clone, Copy, Debug)]
pub enum Transform {
    Matrix(DAffine3),
    Parts(Parts),
}

/// Translation, rotation and scale; each can be animated.
#[derive(Clone, Copy, Debug)]
pub struct Parts {
    pub translation: DVec3,
    pub rotation: DQuat,
    pub scale: DVec3,
}

impl Default for Parts {
    fn default() -> Self {
        Self { translation: DVec3::ZERO, rotation: DQuat::IDENTITY, scale: DVec3::ONE }
    }
}

impl Parts {
    pub fn affine(&self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

/// Properties of a node that were decoded, and that `gltf`'s description does not hold.
#[derive(Clone, Debug)]
pub struct Node {
    pub parent: Option<usize>,
    pub transform: Transform,
    /// Transforms of instances (`EXT_mesh_gpu_instancing`) relative to the node.
    pub instances: Option<Arc<[DAffine3]>>,
    /// Visibility (`KHR_node_visibility`) of the node itself, without that of its ancestors. Cameras ignore it.
    pub visible: bool,
}

/// Triangles, points or lines of one material, with only the vertices that they use.
#[derive(Clone, Debug, Default)]
pub struct Primitive {
    /// Index into [`Scene::materials`](super::Scene::materials).
    pub material: usize,
    /// Vertex indices of each triangle, in range of every vertex stream that is not empty.
    pub triangles: Vec<[u32; 3]>,
    pub positions: Vec<[f32; 3]>,
    /// Normals; not zero, not necessarily unit. An empty list means flat shading, in which triangle `i` has the
    /// vertices `3i`, `3i + 1` and `3i + 2` to itself; for points and lines it means that they face the camera.
    pub normals: Vec<[f32; 3]>,
    /// Tangents, if the material has a normal texture.
    pub tangents: Vec<[f32; 4]>,
    /// Both UV sets, if the material has a texture.
    pub uvs: Vec<[f32; 4]>,
    /// Vertex colours, if the primitive has any.
    pub colors: Vec<[f32; 4]>,
    pub targets: Vec<Displacements>,
    /// Joints and weights of each set `JOINTS_0`, `JOINTS_1`, ...
    pub influences: Vec<Influences>,
    /// Corners of points and lines. The last vertices of the primitive belong to them, in the same order.
    pub corners: Vec<Corner>,
    /// Edges of a mesh. The last vertices of the primitive are the corners of these edges.
    pub edges: Vec<Edge>,
}

impl Primitive {
    pub fn is_flat(&self) -> bool {
        self.normals.is_empty() && !self.is_strokes()
    }

    /// Numbers of points and of lines' segments.
    pub fn stroke_counts(&self) -> [usize; 2] {
        let count = |part| self.corners.iter().filter(|c| c.part == part).count();
        [count(StrokePart::Disc(0)), count(StrokePart::Left) / 2]
    }

    /// Whether the primitive has points or lines, including edges of a mesh.
    pub fn is_strokes(&self) -> bool {
        !self.corners.is_empty() || !self.edges.is_empty()
    }
}

/// Displacements of a morph target; a stream that the target does not displace is empty.
#[derive(Clone, Debug, Default)]
pub struct Displacements {
    pub positions: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    pub tangents: Vec<[f32; 3]>,
}

impl Displacements {
    /// Whether any stream is there.
    pub fn displaces(&self) -> bool {
        !(self.positions.is_empty() && self.normals.is_empty() && self.tangents.is_empty())
    }
}

/// Four joints and their weights for every vertex. The weights of all sets of a vertex sum to 1.
#[derive(Clone, Debug, Default)]
pub struct Influences {
    pub joints: Vec<[u16; 4]>,
    pub weights: Vec<[f32; 4]>,
}

/// Skin; empty if no node with a mesh refers to it.
#[derive(Clone, Debug, Default)]
pub struct Skin {
    /// Indices of the joints' nodes.
    pub joints: Vec<usize>,
    /// Inverse bind matrix of each joint.
    pub inverse_bind: Vec<DAffine3>,
}

/// Property that a channel animates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Animated {
    /// A property of a node.
    Node(usize, Property),
    /// Indices of a node and of one of its morph weights.
    Weight(usize, usize),
    /// Whether a node and its descendants are drawn; holds the node's index.
    Visibility(usize),
    /// Number in a description, by a JSON pointer that starts at the description, without the pointer's first slash.
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

/// Material, light or camera whose description has numbers that animations can change; holds its index in the file.
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
    /// Times of the keyframes in seconds, ascending, at least one.
    pub times: Arc<[f32]>,
    /// Values of `width` numbers for each keyframe; three values with cubic splines: in-tangent, value, out-tangent.
    pub values: Arc<[f32]>,
    /// Number of numbers in a value.
    pub width: usize,
}

impl Channel {
    /// Value at keyframe `i`.
    pub fn keyframe(&self, i: usize) -> Vec<f64> {
        match self.interpolation {
            Interpolation::CubicSpline => self.part(i, 1, 3),
            Interpolation::Step | Interpolation::Linear => self.part(i, 0, 1),
        }
    }

    /// Numbers of part `part` of keyframe `i`; a keyframe has `parts` parts.
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

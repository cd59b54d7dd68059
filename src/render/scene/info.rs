//! A summary of a file, for people and for scripts.

use serde::Serialize;

use std::collections::BTreeSet;

use gltf::json::animation::Property;

use super::{
    AlphaMode, Scene,
    document::{self, Animated, Channel, Described},
    pose,
    view::SceneProjection,
};

/// What a file holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneInfo {
    /// `glTF`, `OBJ`, `STL` or `PLY`.
    pub format: &'static str,
    /// glTF version that the file declares; empty for the other formats.
    pub version: String,
    /// Program that wrote the file.
    pub generator: Option<String>,
    /// The scenes.
    pub scenes: SceneNames,
    /// Cameras of the default scene, in the order in which [`Pose::cameras`](super::Pose::cameras)
    /// has them.
    pub cameras: Vec<CameraInfo>,
    /// Animations.
    pub animations: Vec<AnimationInfo>,
    /// Number of nodes.
    pub nodes: usize,
    /// Number of meshes.
    pub meshes: usize,
    /// Number of primitives that are drawn in the default scene, each use counted.
    pub primitives: usize,
    /// Number of triangles that are drawn in the default scene, instances counted.
    pub triangles: u64,
    /// Number of points, counted likewise.
    pub points: u64,
    /// Number of segments of lines, counted likewise.
    pub lines: u64,
    /// Materials by alpha mode.
    pub materials: AlphaModes,
    /// Variants of the materials, of which one can be asked for.
    pub variants: Vec<String>,
    /// Number of textures that materials use.
    pub textures: usize,
    /// Images that textures use.
    pub images: Vec<ImageInfo>,
    /// Number of lights in the default scene.
    pub lights: usize,
    /// Whether the default scene has light from all around.
    pub environment: bool,
    /// Number of skins.
    pub skins: usize,
    /// Extensions that the file uses.
    pub extensions_used: Vec<String>,
    /// Extensions without which the file cannot be read.
    pub extensions_required: Vec<String>,
}

/// The scenes of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SceneNames {
    /// Their names in order, where they have one.
    pub names: Vec<Option<String>>,
    /// Index of the scene that is drawn unless another is asked for; `None` where the file has no
    /// scenes, and all its root nodes are drawn.
    pub default: Option<usize>,
}

/// A camera.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CameraInfo {
    /// Its or else its node's name.
    pub name: Option<String>,
    /// `perspective` or `orthographic`.
    pub kind: &'static str,
}

/// An animation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AnimationInfo {
    /// Its name.
    pub name: Option<String>,
    /// Time of its last keyframe in seconds.
    pub duration: f64,
    /// What it changes: of nodes `transforms`, `weights` and `visibility`, and `materials`, `lights` and `cameras`; in
    /// alphabetical order.
    pub changes: Vec<&'static str>,
}

/// Number of materials of each alpha mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct AlphaModes {
    /// Alpha ignored.
    pub opaque: usize,
    /// Alpha tested.
    pub mask: usize,
    /// Composited.
    pub blend: usize,
}

/// An image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct ImageInfo {
    /// Width in texels.
    pub width: u32,
    /// Height in texels.
    pub height: u32,
}

pub(super) fn summarize(scene: &Scene) -> SceneInfo {
    let document = &scene.document;
    let root = &document.root;
    let drawn = pose::drawn_nodes(document, document.default_scene);
    let visible = document.drawn(document.nodes.iter().map(|node| node.visible).collect());
    let nodes = || drawn.iter().filter_map(|&i| Some((i, root.nodes.get(i)?)));

    let mut cameras = Vec::new();
    let (mut primitives, mut triangles, mut points, mut lines) = (0, 0, 0, 0);
    for (index, node) in nodes() {
        if let Some((name, projection)) = pose::camera_of(document, &document.cameras, node) {
            cameras.push(CameraInfo {
                name,
                kind: match projection {
                    SceneProjection::Perspective { .. } => "perspective",
                    SceneProjection::Orthographic { .. } => "orthographic",
                },
            });
        }
        if !visible[index] {
            continue;
        }
        let copies = pose::copies(document, index) as u64;
        for primitive in pose::primitives_of(document, node) {
            primitives += 1;
            if primitive.is_strokes() {
                let [own_points, own_lines] = primitive.stroke_counts();
                points += copies * own_points as u64;
                lines += copies * own_lines as u64;
            } else {
                triangles += copies * primitive.triangles.len() as u64;
            }
        }
    }
    let mut materials = AlphaModes::default();
    for material in scene.materials.iter().take(document.file_materials) {
        *match material.alpha_mode {
            AlphaMode::Opaque => &mut materials.opaque,
            AlphaMode::Mask { .. } => &mut materials.mask,
            AlphaMode::Blend => &mut materials.blend,
        } += 1;
    }
    SceneInfo {
        format: document.format,
        version: root.asset.version.clone(),
        generator: root.asset.generator.clone(),
        scenes: SceneNames {
            names: root.scenes.iter().map(|s| s.name.clone()).collect(),
            default: document.default_scene,
        },
        cameras,
        animations: root
            .animations
            .iter()
            .zip(&document.animations)
            .map(|(animation, channels)| AnimationInfo {
                name: animation.name.clone(),
                duration: document::duration(channels),
                changes: changes(channels),
            })
            .collect(),
        nodes: root.nodes.len(),
        meshes: root.meshes.len(),
        primitives,
        triangles,
        points,
        lines,
        materials,
        variants: document.variants().map(str::to_owned).collect(),
        textures: scene.textures.len(),
        images: scene
            .images
            .iter()
            .map(|image| ImageInfo {
                width: image.width,
                height: image.height,
            })
            .collect(),
        lights: nodes()
            .filter(|&(index, _)| visible[index])
            .filter_map(|(_, node)| pose::light_of(&document.lights, node))
            .count(),
        environment: pose::environment_of(document, None).is_some(),
        skins: root.skins.len(),
        extensions_used: root.extensions_used.clone(),
        extensions_required: root.extensions_required.clone(),
    }
}

/// What channels change, in words.
fn changes(channels: &[Channel]) -> Vec<&'static str> {
    let words = channels.iter().map(|channel| match channel.target {
        Animated::Node(_, Property::MorphTargetWeights) | Animated::Weight(..) => "weights",
        Animated::Node(..) => "transforms",
        Animated::Visibility(_) => "visibility",
        Animated::Description(Described::Material(_), _) => "materials",
        Animated::Description(Described::Light(_), _) => "lights",
        Animated::Description(Described::Camera(_), _) => "cameras",
    });
    let words: BTreeSet<_> = words.collect();
    words.into_iter().collect()
}

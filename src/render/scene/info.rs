//! Summary of a file's contents, for people and scripts.

use serde::Serialize;

use std::collections::BTreeSet;

use gltf::json::animation::Property;

use super::{
    AlphaMode, Scene,
    document::{self, Animated, Channel, Described},
    pose,
    view::SceneProjection,
};

/// Summary of a file's contents.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneInfo {
    /// `glTF`, `OBJ`, `STL` or `PLY`.
    pub format: &'static str,
    /// Version of glTF that the file declares; empty for other formats.
    pub version: String,
    /// Program that wrote the file.
    pub generator: Option<String>,
    /// Scenes of the file.
    pub scenes: SceneNames,
    /// Cameras of the default scene, in the order in which [`Pose::cameras`](super::Pose::cameras)
    /// has them.
    pub cameras: Vec<CameraInfo>,
    /// Animations of the file.
    pub animations: Vec<AnimationInfo>,
    /// Number of nodes.
    pub nodes: usize,
    /// Number of meshes.
    pub meshes: usize,
    /// Number of primitives that are drawn in the default scene, each use counted.
    pub primitives: usize,
    /// Number of triangles that are drawn in the default scene, instances counted.
    pub triangles: u64,
    /// Number of points that are drawn in the default scene, instances counted.
    pub points: u64,
    /// Number of line segments that are drawn in the default scene, instances counted.
    pub lines: u64,
    /// Numbers of materials by alpha mode.
    pub materials: AlphaModes,
    /// Names of the materials' variants, of which one can be selected.
    pub variants: Vec<String>,
    /// Number of textures that materials use.
    pub textures: usize,
    /// Images that textures use.
    pub images: Vec<ImageInfo>,
    /// Number of lights in the default scene.
    pub lights: usize,
    /// Whether the default scene has an environment.
    pub environment: bool,
    /// Number of skins.
    pub skins: usize,
    /// Extensions that the file uses.
    pub extensions_used: Vec<String>,
    /// Extensions without which the file can't be read.
    pub extensions_required: Vec<String>,
}

/// Scenes of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SceneNames {
    /// Names of the scenes in order; `None` for a scene without one.
    pub names: Vec<Option<String>>,
    /// Index of the scene that is drawn by default; `None` if the file has no scenes, so that all its root nodes are
    /// drawn.
    pub default: Option<usize>,
}

/// Camera of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CameraInfo {
    /// Name of the camera, or otherwise of its node.
    pub name: Option<String>,
    /// Kind of projection: `perspective` or `orthographic`.
    pub kind: &'static str,
}

/// Animation of a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AnimationInfo {
    /// Name of the animation.
    pub name: Option<String>,
    /// Time of the last keyframe in seconds.
    pub duration: f64,
    /// Kinds of properties that the animation changes, in alphabetical order: `transforms`, `weights` and `visibility`
    /// of nodes, and `materials`, `lights` and `cameras`.
    pub changes: Vec<&'static str>,
}

/// Numbers of materials of each alpha mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct AlphaModes {
    /// Number of materials that ignore alpha.
    pub opaque: usize,
    /// Number of materials that test alpha.
    pub mask: usize,
    /// Number of materials that are composited.
    pub blend: usize,
}

/// Image of a file.
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
        images: scene.images.iter().map(|image| ImageInfo { width: image.width, height: image.height }).collect(),
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

/// Kinds of properties that channels change.
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

//! Poses: the triangles, lights and cameras of a scene at one moment.

mod assemble;
mod hierarchy;
mod keyframes;
mod looks;
mod motion;
mod placement;

use std::{borrow::Cow, sync::Arc};

use glam::{DAffine3, DMat3, DVec3};
use gltf::json::{Index, Node};

use super::{
    Scene, SceneError,
    document::{Document, Primitive},
    environment::Environment,
    error::{Fault, Warnings},
    geometry::PosedGeometry,
    light::Light,
    material::Material,
    view::{SceneCamera, SceneProjection},
};
use assemble::MovingPlacement;
use looks::SceneAppearance;
use motion::Moving;
pub(crate) use motion::MovingBounds;
pub use motion::{Moment, Motion, MotionPart};
use placement::{Placement, Placer};

/// Choice of a scene, an animation and a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PoseRequest {
    /// Index of the scene; `None` for the file's default scene, or otherwise its first.
    pub scene: Option<usize>,
    /// Name of the animation, or its index; `None` for the first animation, if [`time`](Self::time) is above 0.
    pub animation: Option<String>,
    /// Time in seconds from the animation's start. Before the first keyframe and after the last, their values hold.
    pub time: f64,
}

/// A scene at one moment, in world space.
#[derive(Clone, Debug, Default)]
pub struct Pose {
    /// Triangles of the scene.
    pub geometry: PosedGeometry,
    /// Materials that an animation has changed, each with the index of the scene's material that it replaces; indices
    /// ascend.
    pub materials: Vec<(usize, Material)>,
    /// Lights of the scene, in the order of a depth-first walk; empty if the file has none.
    pub lights: Vec<Light>,
    /// Environment of the file (`EXT_lights_image_based`).
    pub environment: Option<Arc<Environment>>,
    /// Cameras of the scene, in the order of a depth-first walk.
    pub cameras: Vec<SceneCamera>,
    /// Warnings about parts that could not be posed.
    pub warnings: Vec<String>,
}

impl Pose {
    /// Materials of the scene at the moment of the pose.
    #[must_use]
    pub fn materials<'s>(&self, scene: &'s Scene) -> Cow<'s, [Material]> {
        if self.materials.is_empty() {
            return Cow::Borrowed(&scene.materials);
        }
        let mut materials = scene.materials.clone();
        for (index, changed) in &self.materials {
            if let Some(material) = materials.get_mut(*index) {
                material.clone_from(changed);
            }
        }
        Cow::Owned(materials)
    }

    /// Environment that lights the pose: the scene's own [environment](Scene::environment), or otherwise the file's;
    /// `None` for the built-in studio.
    #[must_use]
    pub fn environment<'s>(&'s self, scene: &'s Scene) -> Option<&'s Environment> {
        let own = self.environment.as_deref();
        scene.environment.as_deref().or(own)
    }
}

/// Contents of a scene at a moment, before its triangles are assembled.
struct PoseContents<'d> {
    materials: Vec<(usize, Material)>,
    placements: Vec<Placement<'d>>,
    lights: Vec<Light>,
    cameras: Vec<SceneCamera>,
}

pub(super) fn pose(scene: &Scene, request: &PoseRequest) -> Result<Pose, SceneError> {
    Ok(posed(scene, request, &Moving::default())?.0)
}

pub(super) fn pose_in_motion(scene: &Scene, request: &PoseRequest) -> Result<(Pose, Motion), SceneError> {
    // At time 0 no animation is chosen by default, but a motion needs the animation that is chosen at later times.
    let later = PoseRequest { time: f64::MAX, ..request.clone() };
    let moving = Moving::new(scene, keyframes::choose(&scene.document, &later)?);
    let (pose, placements, placed) = posed(scene, request, &moving)?;
    let motion = Motion::new(request, &pose, &placements, &moving, &placed);
    Ok((pose, motion))
}

/// A pose, its placements, and the vertices of those that move.
fn posed<'d>(
    scene: &'d Scene,
    request: &PoseRequest,
    moving: &Moving,
) -> Result<(Pose, Vec<Placement<'d>>, Vec<MovingPlacement>), SceneError> {
    let document = &scene.document;
    let mut warnings = Warnings::new(&document.file);
    let shown = show(scene, request, moving, &mut warnings)?;
    let (geometry, placed) = assemble::assemble(scene, &shown.placements, &mut warnings)?;
    if geometry.triangles.is_empty() {
        let place = match request.scene.or(document.default_scene) {
            Some(index) => format!("/scenes/{index}"),
            None => "/nodes".to_owned(),
        };
        warnings.push(&Fault::new(place, "there are no triangles to draw"));
    }
    let pose = Pose {
        geometry,
        materials: shown.materials,
        lights: shown.lights,
        environment: environment_of(document, request.scene),
        cameras: shown.cameras,
        warnings: warnings.into_vec(),
    };
    Ok((pose, shown.placements, placed))
}

/// Environment of a scene of the file, or of its default scene.
pub(super) fn environment_of(document: &Document, scene: Option<usize>) -> Option<Arc<Environment>> {
    let scene = scene.or(document.default_scene)?;
    document.environments.get(scene)?.clone()
}

/// Collects the contents of a scene at a moment.
fn show<'d>(
    scene: &'d Scene,
    request: &PoseRequest,
    moving: &Moving,
    warnings: &mut Warnings,
) -> Result<PoseContents<'d>, SceneError> {
    let document = &scene.document;
    if let Some(asked) = request.scene
        && asked >= document.root.scenes.len()
    {
        return Err(SceneError::NoSuchScene { file: document.file.clone(), asked, count: document.root.scenes.len() });
    }
    let animation = keyframes::choose(document, request)?;
    let state = hierarchy::NodeStates::new(document, animation, request.time);
    let looks = SceneAppearance::new(scene, animation, request.time, warnings);
    let drawn = drawn_nodes(document, request.scene.or(document.default_scene));

    let mut placer = Placer::new(document, &state, moving);
    let mut placements = Vec::new();
    let (mut lights, mut cameras) = (Vec::new(), Vec::new());
    for index in drawn {
        let (Some(node), Some(world)) = (document.root.nodes.get(index), state.world.get(index)) else {
            continue;
        };
        if !world.is_finite() {
            warnings
                .push(&Fault::new(format!("/nodes/{index}"), "its transform is not finite; what it holds is left out"));
            continue;
        }
        let visible = state.drawn[index];
        if let Some(light) = light_of(&looks.lights, node).filter(|_| visible) {
            lights.push(place_light(light, world));
        }
        if let Some((name, projection)) = camera_of(document, &looks.cameras, node) {
            match axes(world) {
                Some(axes) => cameras.push(SceneCamera { name, eye: world.translation, axes, projection }),
                None => warnings.push(&Fault::new(
                    format!("/nodes/{index}"),
                    "its transform gives the camera no direction; the camera is left out",
                )),
            }
        }
        if visible {
            placements.extend(placer.of_node(index, node));
        }
    }
    Ok(PoseContents { materials: looks.materials, placements, lights, cameras })
}

/// Nodes of a scene, depth first, each once; `None` walks from all root nodes.
pub(super) fn drawn_nodes(document: &Document, scene: Option<usize>) -> Vec<usize> {
    let nodes = &document.root.nodes;
    let mut open: Vec<usize> = match scene.and_then(|index| document.root.scenes.get(index)) {
        Some(scene) => scene.nodes.iter().map(Index::value).collect(),
        None => (0..nodes.len()).filter(|&i| document.nodes[i].parent.is_none()).collect(),
    };
    open.reverse();
    let mut seen = vec![false; nodes.len()];
    let mut drawn = Vec::new();
    while let Some(index) = open.pop() {
        if std::mem::replace(&mut seen[index], true) {
            continue;
        }
        drawn.push(index);
        let children = nodes[index].children.iter().flatten();
        open.extend(children.rev().map(Index::value));
    }
    drawn
}

/// Name of a node's camera, and its projection from `cameras`.
pub(super) fn camera_of(
    document: &Document,
    cameras: &[Option<SceneProjection>],
    node: &Node,
) -> Option<(Option<String>, SceneProjection)> {
    let index = node.camera?.value();
    let projection = *cameras.get(index)?.as_ref()?;
    let name = document.root.cameras.get(index)?.name.clone();
    Some((name.or_else(|| node.name.clone()), projection))
}

/// Light of a node, from `lights`.
pub(super) fn light_of<'l>(lights: &'l [Option<Light>], node: &Node) -> Option<&'l Light> {
    let extension = node.extensions.as_ref()?.khr_lights_punctual.as_ref()?;
    lights.get(extension.light.value())?.as_ref()
}

/// Primitives of a node's mesh.
pub(super) fn primitives_of<'d>(document: &'d Document, node: &Node) -> &'d [Primitive] {
    let mesh = node.mesh.and_then(|mesh| document.meshes.get(mesh.value()));
    mesh.map_or(&[], Vec::as_slice)
}

/// Number of times that a node's mesh is drawn. A skin alone determines the place of its mesh, so that instances would
/// coincide; they count as one.
pub(super) fn copies(document: &Document, index: usize) -> usize {
    match &document.nodes[index].instances {
        Some(instances) if document.root.nodes[index].skin.is_none() => instances.len(),
        _ => 1,
    }
}

fn place_light(light: &Light, world: &DAffine3) -> Light {
    Light { position: world.translation, direction: -world.matrix3.z_axis.normalize_or(DVec3::Z), ..*light }
}

/// Axes (right, up and backward) of a node without its scale; `None` if the transform has no direction.
fn axes(world: &DAffine3) -> Option<DMat3> {
    let backward = world.matrix3.z_axis.try_normalize()?;
    let right = world.matrix3.y_axis.cross(backward).try_normalize()?;
    Some(DMat3::from_cols(right, backward.cross(right), backward))
}

//! Targets of the pointers of `KHR_animation_pointer`.

use std::collections::BTreeSet;

use gltf::json::{Index, Mesh, Node, animation::Property};

use super::model::Model;
use crate::scene::{
    document::{Animated, Described},
    error::Fault,
};

/// Pointer of the channel target at `place`, and the pointer's own place.
pub fn of<'m>(model: &'m Model, place: &str) -> Option<(&'m str, String)> {
    let place = format!("{place}/extensions/KHR_animation_pointer/pointer");
    Some((model.text(&place)?, place))
}

/// Indices of the materials into which pointers of animations lead.
pub fn animated_materials(model: &Model) -> BTreeSet<usize> {
    let animations = model.root.animations.iter().enumerate();
    let targets = animations.flat_map(|(a, animation)| {
        let channels = 0..animation.channels.len();
        channels.map(move |c| format!("/animations/{a}/channels/{c}/target"))
    });
    let parsed = targets.filter_map(|place| parse(of(model, &place)?.0));
    parsed
        .filter_map(|pointed| match pointed {
            Pointed::Target(Animated::Description(Described::Material(index), _)) => Some(index),
            _ => None,
        })
        .collect()
}

/// Targets of an animation pointer: several if several nodes share the property. `place` is the place of the pointer
/// itself.
pub fn targets(model: &Model, pointer: &str, place: &str) -> Result<Vec<Animated>, Fault> {
    let pointed = parse(pointer).ok_or_else(|| {
        let reason = format!(
            "{pointer} keeps its value: of pointers, those into materials, lights and cameras, to the translation, rotation, \
             scale, weights and visibility of nodes, and to the weights of meshes are supported"
        );
        Fault::new(place, reason)
    })?;
    let check_node = |node: usize| model.get(Index::<Node>::new(node as u32), place).map(drop);
    match pointed {
        Pointed::Target(target) => {
            match target {
                Animated::Weight(node, weight) => {
                    check_node(node)?;
                    check_weight(model, model.root.nodes[node].mesh, weight, place)?;
                }
                Animated::Node(node, _) | Animated::Visibility(node) => check_node(node)?,
                Animated::Description(..) => {}
            }
            Ok(vec![target])
        }
        Pointed::Mesh(mesh, weight) => {
            let mesh = Index::<Mesh>::new(mesh as u32);
            model.check(&mesh, place)?;
            if let Some(weight) = weight {
                check_weight(model, Some(mesh), weight, place)?;
            }
            let target = |node: usize| match weight {
                Some(weight) => Animated::Weight(node, weight),
                None => Animated::Node(node, Property::MorphTargetWeights),
            };
            let nodes = model.root.nodes.iter().enumerate();
            let sharing = nodes.filter(|(_, node)| {
                node.mesh.map(|drawn| drawn.value()) == Some(mesh.value()) && node.weights.is_none()
            });
            Ok(sharing.map(|(node, _)| target(node)).collect())
        }
    }
}

/// Fails unless a mesh has a morph target with this index.
fn check_weight(model: &Model, mesh: Option<Index<Mesh>>, weight: usize, place: &str) -> Result<(), Fault> {
    let mesh = mesh.and_then(|mesh| model.root.get(mesh));
    let primitives = mesh.into_iter().flat_map(|mesh| &mesh.primitives);
    let targets = primitives.filter_map(|primitive| primitive.targets.as_ref().map(Vec::len));
    match targets.max().unwrap_or(0) {
        count if weight < count => Ok(()),
        count => Err(Fault::new(place, format!("there is no weight {weight}: the mesh has {count} morph targets"))),
    }
}

enum Pointed {
    Target(Animated),
    /// Weights (all, or the one with this index) of the nodes that draw the mesh and have no weights of their own.
    Mesh(usize, Option<usize>),
}

/// Parses a pointer; `None` if it is not supported.
fn parse(pointer: &str) -> Option<Pointed> {
    let index = |text: &str| text.parse::<u32>().ok().map(|index| index as usize);
    let description = |kind: fn(usize) -> Described, at: &str, rest: &[&str]| {
        let inner = (!rest.is_empty()).then(|| rest.join("/"))?;
        Some(Animated::Description(kind(index(at)?), inner))
    };
    let parts: Vec<&str> = pointer.split('/').collect();
    let target = match parts[..] {
        ["", "nodes", node, "extensions", "KHR_node_visibility", "visible"] => Animated::Visibility(index(node)?),
        ["", "nodes", node, property] => {
            let property = match property {
                "translation" => Property::Translation,
                "rotation" => Property::Rotation,
                "scale" => Property::Scale,
                "weights" => Property::MorphTargetWeights,
                _ => return None,
            };
            Animated::Node(index(node)?, property)
        }
        ["", "nodes", node, "weights", weight] => Animated::Weight(index(node)?, index(weight)?),
        ["", "meshes", mesh, "weights"] => return Some(Pointed::Mesh(index(mesh)?, None)),
        ["", "meshes", mesh, "weights", weight] => {
            return Some(Pointed::Mesh(index(mesh)?, Some(index(weight)?)));
        }
        ["", "materials", at, ref rest @ ..] => description(Described::Material, at, rest)?,
        ["", "cameras", at, ref rest @ ..] => description(Described::Camera, at, rest)?,
        ["", "extensions", "KHR_lights_punctual", "lights", at, ref rest @ ..] => {
            description(Described::Light, at, rest)?
        }
        _ => return None,
    };
    Some(Pointed::Target(target))
}

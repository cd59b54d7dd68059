//! What the pointers of `KHR_animation_pointer` lead to.

use std::collections::BTreeSet;

use gltf::json::{Index, Node, animation::Property};

use super::model::{Model, is_nothing};
use crate::scene::{
    document::{Animated, Described},
    error::Fault,
};

/// The pointer of the channel target at `place`, and where it is.
pub fn of<'m>(model: &'m Model, place: &str) -> Option<(&'m str, String)> {
    let place = format!("{place}/extensions/KHR_animation_pointer/pointer");
    Some((model.text(&place)?, place))
}

/// The materials that pointers of the document's animations lead into.
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

/// The targets of a pointer at `place`: several where nodes share what it leads to.
pub fn targets(model: &Model, pointer: &str, place: &str) -> Result<Vec<Animated>, Fault> {
    let pointed = parse(pointer).ok_or_else(|| {
        let reason = format!(
            "{pointer} keeps its value: of pointers, those into materials, lights and cameras, to the translation, rotation, \
             scale, weights and visibility of nodes, and to the weights of meshes are supported"
        );
        Fault::new(place, reason)
    })?;
    let check_node = |node: usize| model.get(Index::<Node>::new(node as u32), place).map(drop);
    match &pointed {
        Pointed::MeshWeights(mesh) => {
            model.check(&Index::<gltf::json::Mesh>::new(*mesh as u32), place)?;
        }
        Pointed::Target(Animated::Node(node, _) | Animated::Visibility(node)) => check_node(*node)?,
        Pointed::Target(Animated::Description(..)) => {}
    }
    Ok(match pointed {
        Pointed::Target(target) => vec![target],
        Pointed::MeshWeights(mesh) => {
            let nodes = model.root.nodes.iter().enumerate();
            nodes
                .filter(|(_, node)| {
                    let drawn = node.mesh.filter(|drawn| !is_nothing(*drawn));
                    drawn.is_some_and(|drawn| drawn.value() == mesh) && node.weights.is_none()
                })
                .map(|(node, _)| Animated::Node(node, Property::MorphTargetWeights))
                .collect()
        }
    })
}

enum Pointed {
    Target(Animated),
    /// Weights of all nodes that draw the mesh and have none of their own.
    MeshWeights(usize),
}

/// What a pointer means; nothing where it is none that is supported.
fn parse(pointer: &str) -> Option<Pointed> {
    let index = |text: &str| text.parse::<u32>().ok().map(|index| index as usize);
    let description = |kind: fn(usize) -> Described, at: &str, rest: &[&str]| {
        let inner = (!rest.is_empty()).then(|| rest.join("/"))?;
        Some(Animated::Description(kind(index(at)?), inner))
    };
    let parts: Vec<&str> = pointer.split('/').collect();
    let target = match parts[..] {
        [
            "",
            "nodes",
            node,
            "extensions",
            "KHR_node_visibility",
            "visible",
        ] => Animated::Visibility(index(node)?),
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
        ["", "meshes", mesh, "weights"] => return Some(Pointed::MeshWeights(index(mesh)?)),
        ["", "materials", at, ref rest @ ..] => description(Described::Material, at, rest)?,
        ["", "cameras", at, ref rest @ ..] => description(Described::Camera, at, rest)?,
        [
            "",
            "extensions",
            "KHR_lights_punctual",
            "lights",
            at,
            ref rest @ ..,
        ] => description(Described::Light, at, rest)?,
        _ => return None,
    };
    Some(Pointed::Target(target))
}

//! Nodes, their hierarchy, and scenes (glTF 2.0, sections 3.5 and 5.25 to 5.28).

use glam::{DAffine3, DMat3, DQuat, DVec3};
use gltf::json;

use super::{Context, instance, model};
use crate::scene::{
    document::{Node, Parts, Transform},
    error::Fault,
};

/// Reads all nodes, and their order: parents before children.
pub fn read_nodes(context: &mut Context<'_>) -> Result<(Vec<Node>, Vec<usize>), Fault> {
    let model = context.model;
    let mut nodes = model
        .all()
        .map(|found| {
            let (item, place) = found?;
            read_node(item, &place, context)
        })
        .collect::<Result<Vec<_>, Fault>>()?;
    for (parent, item) in model.root.nodes.iter().enumerate() {
        for child in item.children.iter().flatten() {
            if let Some(other) = nodes[child.value()].parent.replace(parent) {
                return Err(Fault::new(
                    format!("/nodes/{parent}/children"),
                    format!("node {} is already a child of node {other}", child.value()),
                ));
            }
        }
    }
    let order = order(&nodes, &model.root.nodes)?;
    Ok((nodes, order))
}

/// The extension object `KHR_node_visibility`.
#[derive(serde::Deserialize)]
struct VisibilityExtension {
    visible: Option<bool>,
}

/// Order of the nodes, parents before children. A node that no root leads to is on a cycle or below one, because each
/// node has one parent.
fn order(nodes: &[Node], items: &[json::Node]) -> Result<Vec<usize>, Fault> {
    let roots = (0..nodes.len()).filter(|&i| nodes[i].parent.is_none());
    let mut order: Vec<usize> = roots.collect();
    let mut at = 0;
    while let Some(&node) = order.get(at) {
        order.extend(items[node].children.iter().flatten().map(json::Index::value));
        at += 1;
    }
    if order.len() == nodes.len() {
        return Ok(order);
    }
    let mut reached = vec![false; nodes.len()];
    for &node in &order {
        reached[node] = true;
    }
    let lost = reached.iter().position(|r| !r).unwrap_or_default();
    Err(Fault::new(format!("/nodes/{lost}"), "is its own ancestor, or below a node that is"))
}

fn read_node(item: &json::Node, place: &str, context: &mut Context<'_>) -> Result<Node, Fault> {
    let model = context.model;
    model.check(&item.children, &format!("{place}/children"))?;
    model.check(&item.mesh, &format!("{place}/mesh"))?;
    model.check(&item.skin, &format!("{place}/skin"))?;
    let camera = model.check(&item.camera, &format!("{place}/camera"));
    context.tolerate(camera.map(Some), "the node has no camera");
    let (mut instances, mut visible) = (None, true);
    if let Some(extensions) = &item.extensions {
        let light = extensions.khr_lights_punctual.as_ref().map(|light| light.light);
        let light = model.check(&light, &format!("{place}/extensions/KHR_lights_punctual/light"));
        context.tolerate(light.map(Some), "the node has no light");
        let visibility = model::extension(Some(&extensions.others), "KHR_node_visibility", place);
        let visibility = context.tolerate(visibility, "the node is visible");
        visible = visibility.is_none_or(|(VisibilityExtension { visible }, _)| visible.unwrap_or(true));
        if item.mesh.is_some() {
            instances = instance::read(&extensions.others, place, context)?;
        }
    }
    if item.skin.is_some() && instances.is_some() {
        context.warn(&Fault::new(place, "a skin takes the place of the node's instances"));
    }
    Ok(Node { parent: None, transform: read_transform(item, place, context)?, instances, visible })
}

fn read_transform(item: &json::Node, place: &str, context: &mut Context<'_>) -> Result<Transform, Fault> {
    let parts = read_parts(place, context)?;
    let Some(m) = context.model.numbers::<16>(&format!("{place}/matrix"))? else {
        return Ok(Transform::Parts(parts));
    };
    if item.translation.is_some() || item.rotation.is_some() || item.scale.is_some() {
        context.warn(&Fault::new(place, "has both a matrix and its parts; the matrix counts"));
    }
    let column = |c: usize| DVec3::new(m[4 * c], m[4 * c + 1], m[4 * c + 2]);
    Ok(Transform::Matrix(DAffine3 {
        matrix3: DMat3::from_cols(column(0), column(1), column(2)),
        translation: column(3),
    }))
}

fn read_parts(place: &str, context: &mut Context<'_>) -> Result<Parts, Fault> {
    let mut parts = Parts::default();
    if let Some(translation) = context.model.numbers::<3>(&format!("{place}/translation"))? {
        parts.translation = translation.into();
    }
    if let Some(rotation) = context.model.numbers::<4>(&format!("{place}/rotation"))? {
        let rotation = DQuat::from_array(rotation);
        let length = rotation.length();
        if length > 0.0 && length.is_finite() {
            parts.rotation = rotation / length;
        } else {
            let reason = "the rotation has no direction and is left out";
            context.warn(&Fault::new(place, reason));
        }
    }
    if let Some(scale) = context.model.numbers::<3>(&format!("{place}/scale"))? {
        parts.scale = scale.into();
    }
    Ok(parts)
}

/// Checks the scenes; returns the index of the one that is drawn by default.
pub fn check_scenes(context: &mut Context<'_>, nodes: &[Node]) -> Result<Option<usize>, Fault> {
    let model = context.model;
    for found in model.all::<json::Scene>() {
        let (item, place) = found?;
        let place = format!("{place}/nodes");
        model.check(&item.nodes, &place)?;
        for (i, root) in item.nodes.iter().map(json::Index::value).enumerate() {
            if nodes[root].parent.is_some() {
                let reason = format!("node {root} is not a root");
                context.warn(&Fault::new(format!("{place}/{i}"), reason));
            }
        }
    }
    if model.root.scenes.is_empty() {
        if !nodes.is_empty() {
            let reason = "the file has no scenes; all its root nodes are drawn";
            context.warn(&Fault::new("/", reason));
        }
        return Ok(None);
    }
    let default = model.check(&model.root.scene, "/scene").map(|()| model.root.scene);
    let default = context.tolerate(default, "the first is the default");
    Ok(Some(default.map_or(0, |scene| scene.value())))
}

//! Nodes, their hierarchy, and scenes (glTF 2.0, sections 3.5 and 5.25 to 5.28).

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::{Context, instance, json::Item};
use crate::scene::{
    document::{Node, Parts, SceneEntry, Transform},
    error::Fault,
};

/// Numbers of elements that nodes may refer to.
#[derive(Clone, Copy, Debug)]
pub struct Counts {
    pub nodes: usize,
    pub meshes: usize,
    pub skins: usize,
    pub cameras: usize,
    pub lights: usize,
}

/// Reads all nodes, and their order: parents before children.
pub fn read_nodes(
    context: &mut Context<'_>,
    counts: Counts,
) -> Result<(Vec<Node>, Vec<usize>), Fault> {
    let items = context.root.objects("nodes")?;
    let mut nodes = items
        .iter()
        .map(|item| read_node(item, context, counts))
        .collect::<Result<Vec<_>, Fault>>()?;
    for parent in 0..nodes.len() {
        for child in nodes[parent].children.clone() {
            if let Some(other) = nodes[child].parent.replace(parent) {
                return Err(Fault::new(
                    format!("/nodes/{parent}/children"),
                    format!("node {child} is already a child of node {other}"),
                ));
            }
        }
    }
    let order = order(&nodes)?;
    Ok((nodes, order))
}

/// Parents before children. With one parent each, a node that no root leads to is on a cycle, or
/// below one.
fn order(nodes: &[Node]) -> Result<Vec<usize>, Fault> {
    let roots = (0..nodes.len()).filter(|&i| nodes[i].parent.is_none());
    let mut order: Vec<usize> = roots.collect();
    let mut at = 0;
    while let Some(&node) = order.get(at) {
        order.extend(&nodes[node].children);
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
    Err(Fault::new(
        format!("/nodes/{lost}"),
        "is its own ancestor, or below a node that is",
    ))
}

fn read_node(item: &Item<'_>, context: &mut Context<'_>, counts: Counts) -> Result<Node, Fault> {
    let children = item
        .array("children")?
        .iter()
        .map(|child| child.as_index("nodes", counts.nodes))
        .collect::<Result<_, _>>()?;
    let mesh = item.index("mesh", "meshes", counts.meshes)?;
    let skin = item.index("skin", "skins", counts.skins)?;
    let light = match item.extension("KHR_lights_punctual") {
        Some(extension) => context.tolerate(
            extension.index("light", "lights", counts.lights),
            "the node has no light",
        ),
        None => None,
    };
    let camera = context.tolerate(
        item.index("camera", "cameras", counts.cameras),
        "the node has no camera",
    );
    let weights = match item.get("weights") {
        Some(weights) => {
            context.tolerate(weights.as_numbers().map(Some), "the mesh's weights hold")
        }
        None => None,
    };
    let instances = match item.extension("EXT_mesh_gpu_instancing") {
        Some(extension) if mesh.is_some() => Some(instance::read(&extension, context)?),
        _ => None,
    };
    if skin.is_some() && instances.is_some() {
        context.warn(&item.fault("a skin takes the place of the node's instances"));
    }
    Ok(Node {
        name: item.name(),
        parent: None,
        children,
        transform: read_transform(item, context)?,
        mesh,
        skin: skin.filter(|_| mesh.is_some()),
        camera,
        light,
        weights,
        instances,
    })
}

fn read_transform(item: &Item<'_>, context: &mut Context<'_>) -> Result<Transform, Fault> {
    let parts = read_parts(item, context)?;
    let Some(m) = item.numbers::<16>("matrix")? else {
        return Ok(Transform::Parts(parts.unwrap_or_default()));
    };
    if parts.is_some() {
        context.warn(&item.fault("has both a matrix and its parts; the matrix counts"));
    }
    let column = |c: usize| DVec3::new(m[4 * c], m[4 * c + 1], m[4 * c + 2]);
    Ok(Transform::Matrix(DAffine3 {
        matrix3: DMat3::from_cols(column(0), column(1), column(2)),
        translation: column(3),
    }))
}

/// `None` where the node has none of the parts.
fn read_parts(item: &Item<'_>, context: &mut Context<'_>) -> Result<Option<Parts>, Fault> {
    let translation = item.numbers::<3>("translation")?;
    let rotation = item.numbers::<4>("rotation")?;
    let scale = item.numbers::<3>("scale")?;
    if translation.is_none() && rotation.is_none() && scale.is_none() {
        return Ok(None);
    }
    let mut parts = Parts::default();
    if let Some(translation) = translation {
        parts.translation = translation.into();
    }
    if let Some(rotation) = rotation {
        let rotation = DQuat::from_array(rotation);
        let length = rotation.length();
        if length > 0.0 && length.is_finite() {
            parts.rotation = rotation / length;
        } else {
            context.warn(&item.fault("the rotation has no direction and is left out"));
        }
    }
    if let Some(scale) = scale {
        parts.scale = scale.into();
    }
    Ok(Some(parts))
}

/// Reads the scenes; `None` for the default where the file has none at all.
pub fn read_scenes(
    context: &mut Context<'_>,
    nodes: &[Node],
) -> Result<(Vec<SceneEntry>, Option<usize>), Fault> {
    let mut scenes = Vec::new();
    for item in context.root.objects("scenes")? {
        let mut roots = Vec::new();
        for root in item.array("nodes")? {
            let node = root.as_index("nodes", nodes.len())?;
            if nodes[node].parent.is_some() {
                context.warn(&root.fault(format!("node {node} is not a root")));
            }
            roots.push(node);
        }
        scenes.push(SceneEntry {
            name: item.name(),
            roots,
        });
    }
    let root = context.root.clone();
    let default = match context.tolerate(
        root.index("scene", "scenes", scenes.len()),
        "the first is the default",
    ) {
        None if scenes.is_empty() => None,
        chosen => Some(chosen.unwrap_or(0)),
    };
    if default.is_none() && !nodes.is_empty() {
        context.warn(&root.fault("the file has no scenes; all its root nodes are drawn"));
    }
    Ok((scenes, default))
}

//! Transforms of all nodes at one moment.

use glam::{DAffine3, DQuat, DVec3};
use gltf::json::animation::Property;

use super::keyframes;
use crate::scene::document::{Animated, Channel, Document, Transform};

/// The nodes at one moment.
#[derive(Debug)]
pub struct NodeStates {
    /// Transform of every node from its space to the world.
    pub world: Vec<DAffine3>,
    /// Animated morph weights of every node.
    pub weights: Vec<Option<Vec<f64>>>,
    /// Whether each node is drawn.
    pub drawn: Vec<bool>,
}

impl NodeStates {
    pub fn new(document: &Document, animation: &[Channel], time: f64) -> Self {
        let nodes = &document.nodes;
        let mut transforms: Vec<Transform> = nodes.iter().map(|node| node.transform).collect();
        let mut weights = vec![None; nodes.len()];
        let mut visible: Vec<bool> = nodes.iter().map(|node| node.visible).collect();
        for channel in animation {
            let (node, property) = match channel.target {
                Animated::Node(node, property) => (node, property),
                Animated::Weight(node, target) => {
                    let all = weights[node].get_or_insert_with(|| document.weights(node));
                    all.resize(all.len().max(target + 1), 0.0);
                    all[target] = keyframes::sample(channel, time).first().copied().unwrap_or(0.0);
                    continue;
                }
                Animated::Visibility(node) => {
                    visible[node] = keyframes::sample(channel, time) != [0.0];
                    continue;
                }
                Animated::Description(..) => continue,
            };
            let value = keyframes::sample(channel, time);
            if property == Property::MorphTargetWeights {
                weights[node] = Some(value);
                continue;
            }
            let Transform::Parts(parts) = &mut transforms[node] else {
                continue;
            };
            match (property, value.as_slice()) {
                (Property::Translation, &[x, y, z]) => parts.translation = DVec3::new(x, y, z),
                (Property::Scale, &[x, y, z]) => parts.scale = DVec3::new(x, y, z),
                (Property::Rotation, &[x, y, z, w]) => parts.rotation = DQuat::from_xyzw(x, y, z, w),
                _ => {}
            }
        }
        let mut world = vec![DAffine3::IDENTITY; nodes.len()];
        for &index in &document.order {
            let local = match &transforms[index] {
                Transform::Matrix(matrix) => *matrix,
                Transform::Parts(parts) => parts.affine(),
            };
            world[index] = match nodes[index].parent {
                Some(parent) => world[parent] * local,
                None => local,
            };
        }
        Self { world, weights, drawn: document.drawn(visible) }
    }
}

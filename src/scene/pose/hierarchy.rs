//! Where every node is at one moment.

use glam::{DAffine3, DQuat, DVec3};
use gltf::json::animation::Property;

use super::keyframes;
use crate::scene::document::{Channel, Document, Transform};

/// The nodes at one moment.
#[derive(Debug)]
pub struct State {
    /// Of every node, from its space to the world.
    pub world: Vec<DAffine3>,
    /// Of every node, animated morph weights.
    pub weights: Vec<Option<Vec<f64>>>,
}

impl State {
    pub fn new(document: &Document, animation: &[Channel], time: f64) -> Self {
        let nodes = &document.nodes;
        let mut transforms: Vec<Transform> = nodes.iter().map(|node| node.transform).collect();
        let mut weights = vec![None; nodes.len()];
        for channel in animation {
            let value = keyframes::sample(channel, time);
            if channel.path == Property::MorphTargetWeights {
                weights[channel.node] = Some(value);
                continue;
            }
            let Transform::Parts(parts) = &mut transforms[channel.node] else {
                continue;
            };
            match (channel.path, value.as_slice()) {
                (Property::Translation, &[x, y, z]) => parts.translation = DVec3::new(x, y, z),
                (Property::Scale, &[x, y, z]) => parts.scale = DVec3::new(x, y, z),
                (Property::Rotation, &[x, y, z, w]) => {
                    parts.rotation = DQuat::from_xyzw(x, y, z, w)
                }
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
        Self { world, weights }
    }
}

//! Materials, lights and cameras at one moment.

use std::{collections::BTreeMap, iter};

use super::keyframes;
use crate::scene::{
    Scene,
    document::{Animated, Channel, Described},
    error::Warnings,
    light::Light,
    material::Material,
    read::{AnimatedProperty, Change},
    view::SceneProjection,
};

/// Appearance of a scene at one moment.
#[derive(Debug)]
pub struct SceneAppearance {
    /// Materials that the animation changes, with their indices, and their unlit copies.
    pub materials: Vec<(usize, Material)>,
    /// Lights, in the document's order.
    pub lights: Vec<Option<Light>>,
    /// Projections of cameras, in the document's order.
    pub cameras: Vec<Option<SceneProjection>>,
}

impl SceneAppearance {
    pub fn new(scene: &Scene, animation: &[Channel], time: f64, warnings: &mut Warnings) -> Self {
        let mut changes: BTreeMap<Described, Vec<Change<'_>>> = BTreeMap::new();
        for channel in animation {
            if let Animated::Description(described, pointer) = &channel.target {
                let change = (pointer.as_str(), keyframes::sample(channel, time));
                changes.entry(*described).or_default().push(change);
            }
        }
        let mut looks = Self {
            materials: Vec::new(),
            lights: scene.document.lights.clone(),
            cameras: scene.document.cameras.clone(),
        };
        for (described, changes) in changes {
            let read = scene.descriptions.read(described, &changes, &scene.materials, warnings);
            match read.and_then(|read| read) {
                Ok(property) => looks.set(scene, property),
                Err(fault) => warnings.push(&fault.but("it stays as it is at rest")),
            }
        }
        looks.materials.sort_by_key(|(index, _)| *index);
        looks
    }

    fn set(&mut self, scene: &Scene, property: AnimatedProperty) {
        match property {
            AnimatedProperty::Material(index, material) => {
                let unlit =
                    unlit_copy(scene, index).map(|copy| (copy, Material { unlit: true, ..(*material).clone() }));
                self.materials.extend(unlit);
                self.materials.push((index, *material));
            }
            AnimatedProperty::Light(index, light) => self.lights[index] = Some(light),
            AnimatedProperty::Camera(index, camera) => self.cameras[index] = Some(camera),
        }
    }
}

/// Index of the unlit copy of a material, if it has one.
fn unlit_copy(scene: &Scene, material: usize) -> Option<usize> {
    let copies = &scene.document.unlit_copies;
    let found = copies.binary_search_by_key(&material, |(of, _)| *of).ok()?;
    copies.get(found).map(|(_, copy)| *copy)
}

/// Indices of the materials that channels change, with their unlit copies.
pub fn changing_materials(scene: &Scene, animation: &[Channel]) -> Vec<usize> {
    let targets = animation.iter().map(|channel| &channel.target);
    let materials = targets.filter_map(|target| match target {
        Animated::Description(Described::Material(index), _) => Some(*index),
        _ => None,
    });
    let mut all: Vec<usize> = materials.flat_map(|index| iter::once(index).chain(unlit_copy(scene, index))).collect();
    all.sort_unstable();
    all.dedup();
    all
}

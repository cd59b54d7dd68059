//! Materials, lights and cameras at one moment.

use std::{collections::BTreeMap, iter};

use super::keyframes;
use crate::scene::{
    Scene,
    document::{Animated, Channel, Described},
    error::{Fault, Warnings},
    light::Light,
    material::Material,
    read::Change,
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
            if let Err(fault) = looks.change(scene, described, &changes, warnings) {
                warnings.push(&fault.but("it stays as it is at rest"));
            }
        }
        looks.materials.sort_by_key(|(index, _)| *index);
        looks
    }

    fn change(
        &mut self,
        scene: &Scene,
        described: Described,
        changes: &[Change<'_>],
        warnings: &mut Warnings,
    ) -> Result<(), Fault> {
        let descriptions = &scene.descriptions;
        match described {
            Described::Material(index) => {
                if let Some(at_rest) = scene.materials.get(index) {
                    let material = descriptions.material(index, changes, at_rest, warnings)?;
                    let unlit = unlit_copy(scene, index).map(|copy| {
                        let unlit = true;
                        let material = material.clone();
                        (copy, Material { unlit, ..material })
                    });
                    self.materials.extend(unlit);
                    self.materials.push((index, material));
                }
            }
            Described::Light(index) => {
                if let Some(light) = self.lights.get_mut(index) {
                    *light = Some(descriptions.light(index, changes, warnings)?);
                }
            }
            Described::Camera(index) => {
                if let Some(camera) = self.cameras.get_mut(index) {
                    *camera = Some(descriptions.camera(index, changes)?);
                }
            }
        }
        Ok(())
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

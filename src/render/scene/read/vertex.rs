//! Vertex attributes other than the position. A fault in them is never an error: what can't be read is noted and left
//! out.

use rayon::prelude::*;

use gltf::json::{
    self, Index,
    accessor::ComponentType,
    mesh::{self, MorphTarget, Semantic},
    validation::Checked,
};

use super::{Context, accessor::Accessor, packed::Packed, primitive::gather};
use crate::scene::{
    document::{Displacements, Influences},
    error::Fault,
    material::Material,
};

/// Component types of normals, tangents and displacements, `KHR_mesh_quantization` included.
pub const SIGNED: [ComponentType; 3] = [ComponentType::F32, ComponentType::I8, ComponentType::I16];
/// Component types of texture coordinates, `KHR_mesh_quantization` included.
const ANY: [ComponentType; 5] =
    [ComponentType::F32, ComponentType::I8, ComponentType::U8, ComponentType::I16, ComponentType::U16];
/// Component types of colours and weights.
const FRACTION: [ComponentType; 3] = [ComponentType::F32, ComponentType::U8, ComponentType::U16];

/// Index of the accessor of an attribute.
pub fn attribute_of(item: &mesh::Primitive, semantic: Semantic) -> Option<Index<json::Accessor>> {
    item.attributes.get(&Checked::Valid(semantic)).copied()
}

/// Reads the attributes of one primitive.
pub struct Reader<'r, 'a> {
    /// The primitive.
    pub primitive: &'r mesh::Primitive,
    /// JSON pointer to the primitive.
    pub place: &'r str,
    /// Decoded streams of a compressed primitive.
    pub packed: Option<&'r Packed>,
    /// The document.
    pub context: &'r Context<'a>,
    /// Number of positions, which the other attributes must match.
    pub count: usize,
}

impl<'r> Reader<'r, '_> {
    fn read(
        &self,
        accessor: Result<Accessor<'r>, Fault>,
        place: String,
        components: &[usize],
        types: &[ComponentType],
        notes: &mut Vec<Fault>,
    ) -> Option<Accessor<'r>> {
        let accessor = accessor
            .and_then(|accessor| accessor.expect_components(components)?.expect_type(types)?.expect_count(self.count));
        accessor.map_err(|fault| notes.push(Fault::new(place, format!("is left out, for {fault}")))).ok()
    }

    /// Decoded attribute of a compressed primitive, if it has it.
    pub fn packed(&self, semantic: Semantic) -> Option<Result<Accessor<'r>, Fault>> {
        let name = semantic.to_string();
        let stream = self.packed?.attributes.get(&name)?;
        let described = attribute_of(self.primitive, semantic);
        let described = described.and_then(|index| self.context.model.root.get(index));
        let normalized = described.is_some_and(|accessor| accessor.normalized);
        let place = format!("{}/attributes/{name}", self.place);
        Some(Accessor::of_stream(stream, normalized, &place))
    }

    /// Accessor of an attribute, if the primitive has it.
    pub fn attribute(
        &self,
        semantic: Semantic,
        components: &[usize],
        types: &[ComponentType],
        notes: &mut Vec<Fault>,
    ) -> Option<Accessor<'r>> {
        let place = format!("{}/attributes/{}", self.place, semantic.to_string());
        let index = attribute_of(self.primitive, semantic.clone())?;
        let accessor = self.packed(semantic).unwrap_or_else(|| self.context.accessor(index, &place));
        self.read(accessor, place, components, types, notes)
    }

    /// Both UV sets, if `material` has textures or tangents have to be generated from the set `tangents`.
    pub fn uvs(
        &self,
        material: &Material,
        tangents: Option<u32>,
        sources: &[u32],
        notes: &mut Vec<Fault>,
    ) -> Vec<[f32; 4]> {
        let textures = material.textures().map(|(_, used)| used.uv_set);
        let mut used = [false; 2];
        for set in textures.chain(tangents) {
            if let Some(used) = used.get_mut(set as usize) {
                *used = true;
            }
        }
        if used == [false; 2] {
            return Vec::new();
        }
        let mut set = |set: u32| {
            let accessor = self.attribute(Semantic::TexCoords(set), &[2], &ANY, notes);
            if accessor.is_none() {
                let reason = format!("the material uses TEXCOORD_{set}, which is not there");
                notes.push(Fault::new(format!("{}/attributes", self.place), reason));
            }
            accessor
        };
        let first = used[0].then(|| set(0)).flatten();
        let second = used[1].then(|| set(1)).flatten();
        let read = |accessor: &Option<Accessor<'_>>, source: u32| {
            let uv = accessor.as_ref().map_or([0.0; 2], |a| a.floats(source as usize));
            uv.map(|x| if x.is_finite() { x } else { 0.0 })
        };
        sources
            .par_iter()
            .with_min_len(16_384)
            .map(|&source| {
                let ([u0, v0], [u1, v1]) = (read(&first, source), read(&second, source));
                [u0, v0, u1, v1]
            })
            .collect()
    }

    /// Vertex colours, opaque if the file has no alpha; empty if it has no colours.
    pub fn colors(&self, sources: &[u32], notes: &mut Vec<Fault>) -> Vec<[f32; 4]> {
        let Some(accessor) = self.attribute(Semantic::Colors(0), &[3, 4], &FRACTION, notes) else {
            return Vec::new();
        };
        let accessor = accessor.normalized();
        let opaque = accessor.components == 3;
        let mut colors: Vec<[f32; 4]> = gather(&accessor, sources);
        for color in &mut colors {
            if opaque {
                color[3] = 1.0;
            }
            for channel in color {
                if !channel.is_finite() {
                    *channel = 1.0;
                }
            }
        }
        colors
    }

    /// Tangents of the file; `None` if they have to be generated. Without normals they are ignored, as the
    /// specification requires.
    pub fn tangents(&self, normals: &[[f32; 3]], sources: &[u32], notes: &mut Vec<Fault>) -> Option<Vec<[f32; 4]>> {
        if normals.is_empty() {
            return None;
        }
        let accessor = self.attribute(Semantic::Tangents, &[4], &SIGNED, notes)?;
        let mut tangents: Vec<[f32; 4]> = gather(&accessor, sources);
        let usable = |t: &[f32; 4]| t.iter().all(|x| x.is_finite()) && t[..3].iter().any(|&x| x != 0.0);
        if !tangents.iter().all(usable) {
            notes.push(accessor.fault("has unusable tangents; all are generated instead"));
            return None;
        }
        for tangent in &mut tangents {
            tangent[3] = 1.0_f32.copysign(tangent[3]);
        }
        Some(tangents)
    }

    /// Displacements of the morph targets `items`.
    pub fn targets(&self, items: &[MorphTarget], sources: &[u32], notes: &mut Vec<Fault>) -> Vec<Displacements> {
        let targets = items.iter().enumerate();
        targets
            .map(|(i, item)| {
                let mut stream = |name: &str, index: Option<Index<json::Accessor>>, types: &[_]| {
                    let place = format!("{}/targets/{i}/{name}", self.place);
                    let accessor = self.context.accessor(index?, &place);
                    let accessor = self.read(accessor, place, &[3], types, notes)?;
                    let mut displacements: Vec<[f32; 3]> = gather(&accessor, sources);
                    for x in displacements.as_flattened_mut() {
                        if !x.is_finite() {
                            *x = 0.0;
                        }
                    }
                    Some(displacements)
                };
                Displacements {
                    positions: stream("POSITION", item.positions, &ANY).unwrap_or_default(),
                    normals: stream("NORMAL", item.normals, &SIGNED).unwrap_or_default(),
                    tangents: stream("TANGENT", item.tangents, &SIGNED).unwrap_or_default(),
                }
            })
            .collect()
    }

    /// Joints and weights of all sets. A vertex without weights follows its first joint.
    pub fn influences(&self, sources: &[u32], notes: &mut Vec<Fault>) -> Vec<Influences> {
        let mut sets = Vec::new();
        loop {
            let n = sets.len() as u32;
            let types = [ComponentType::U8, ComponentType::U16];
            let joints = self.attribute(Semantic::Joints(n), &[4], &types, notes);
            let weights = self.attribute(Semantic::Weights(n), &[4], &FRACTION, notes);
            let (Some(joints), Some(weights)) = (joints, weights) else {
                break;
            };
            let weights = weights.normalized();
            sets.push(Influences {
                joints: sources.iter().map(|&v| joints.integers(v as usize).map(|j| j as u16)).collect(),
                weights: gather(&weights, sources),
            });
        }
        normalize_weights(&mut sets, sources.len());
        sets
    }
}

/// Scales the weights of every vertex to a sum of 1.
fn normalize_weights(sets: &mut [Influences], count: usize) {
    for v in 0..count {
        let mut sum = 0.0;
        for weight in sets.iter_mut().flat_map(|set| &mut set.weights[v]) {
            if !(weight.is_finite() && *weight > 0.0) {
                *weight = 0.0;
            }
            sum += *weight;
        }
        if sum > 0.0 && sum.is_finite() {
            for weight in sets.iter_mut().flat_map(|set| &mut set.weights[v]) {
                *weight /= sum;
            }
        } else if let Some(first) = sets.first_mut() {
            first.weights[v] = [1.0, 0.0, 0.0, 0.0];
        }
        // A joint without weight need not exist, so that its index may be invalid.
        for set in sets.iter_mut() {
            for (joint, weight) in set.joints[v].iter_mut().zip(set.weights[v]) {
                if weight == 0.0 {
                    *joint = 0;
                }
            }
        }
    }
}

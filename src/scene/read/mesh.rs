//! Meshes (glTF 2.0, section 3.7). Only those that a node refers to are read.

use rayon::prelude::*;

use gltf::json;

use super::{
    Context,
    limits::MAX_ELEMENTS,
    primitive::{self, Outcome},
};
use crate::scene::{document::Primitive, error::Fault, material::Material};

/// Reads the primitives of the meshes that nodes use, all in parallel; the others stay empty.
pub fn read_all(
    context: &mut Context<'_>,
    materials: &[Material],
) -> Result<Vec<Vec<Primitive>>, Fault> {
    let root = &context.model.root;
    let mut used = vec![false; root.meshes.len()];
    for mesh in root.nodes.iter().filter_map(|node| node.mesh) {
        used[mesh.value()] = true;
    }
    let mut meshes = vec![Vec::new(); root.meshes.len()];
    let mut primitives = Vec::new();
    let all = context.model.all::<json::Mesh>().enumerate();
    for (index, found) in all.filter(|&(i, _)| used[i]) {
        let (mesh, place) = found?;
        let each = mesh.primitives.iter().enumerate();
        primitives.extend(each.map(|(i, p)| (index, p, format!("{place}/primitives/{i}"))));
    }

    let shared = &*context;
    let triangles = primitives
        .iter()
        .map(|(_, item, _)| primitive::claimed_triangles(item, shared))
        .fold(0, u64::saturating_add);
    if triangles > MAX_ELEMENTS {
        return Err(Fault::new(
            "/meshes",
            format!("{triangles} triangles exceed the limit of {MAX_ELEMENTS}; split the scene"),
        ));
    }
    let read: Vec<_> = primitives
        .into_par_iter()
        .map(|(mesh, item, place)| {
            let mut notes = Vec::new();
            let outcome = primitive::read(item, &place, shared, materials, &mut notes);
            (mesh, outcome, notes)
        })
        .collect();
    let (mut points, mut lines) = (0, 0);
    for (mesh, outcome, notes) in read {
        context.warnings.extend(notes);
        match outcome? {
            Outcome::Drawn(primitive) => meshes[mesh].push(*primitive),
            Outcome::Points => points += 1,
            Outcome::Lines => lines += 1,
            Outcome::Nothing => {}
        }
    }
    if points + lines > 0 {
        context.warn(&Fault::new(
            "/meshes",
            format!(
                "only triangles are drawn; primitives left out: {points} of points and {lines} of \
                 lines"
            ),
        ));
    }
    Ok(meshes)
}

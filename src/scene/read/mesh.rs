//! Meshes (glTF 2.0, section 3.7). Only those that a node refers to are read.

use rayon::prelude::*;

use super::{
    Context,
    json::Item,
    limits::MAX_ELEMENTS,
    primitive::{self, Outcome},
};
use crate::scene::{
    document::{Mesh, Node},
    error::Fault,
    material::Material,
};

/// Reads the meshes of `nodes`, all primitives in parallel; the others stay empty.
pub fn read_all(
    context: &mut Context<'_>,
    nodes: &[Node],
    materials: &[Material],
) -> Result<Vec<Mesh>, Fault> {
    let items = context.root.objects("meshes")?;
    let mut used = vec![false; items.len()];
    for mesh in nodes.iter().filter_map(|node| node.mesh) {
        used[mesh] = true;
    }
    let mut meshes = vec![Mesh::default(); items.len()];
    let mut primitives: Vec<(usize, Item<'_>)> = Vec::new();
    for (index, item) in items.iter().enumerate().filter(|&(i, _)| used[i]) {
        primitives.extend(item.objects("primitives")?.into_iter().map(|p| (index, p)));
        if let Some(weights) = item.get("weights") {
            let weights = context.tolerate(weights.as_numbers().map(Some), "the weights are 0");
            meshes[index].weights = weights.unwrap_or_default();
        }
    }

    let shared = &*context;
    let triangles = primitives
        .iter()
        .map(|(_, item)| primitive::claimed_triangles(item, shared))
        .fold(0, u64::saturating_add);
    if triangles > MAX_ELEMENTS {
        return Err(Fault::new(
            "/meshes",
            format!("{triangles} triangles exceed the limit of {MAX_ELEMENTS}; split the scene"),
        ));
    }
    let read: Vec<_> = primitives
        .into_par_iter()
        .map(|(mesh, item)| {
            let mut notes = Vec::new();
            let outcome = primitive::read(&item, shared, materials, &mut notes);
            (mesh, outcome, notes)
        })
        .collect();
    let (mut points, mut lines) = (0, 0);
    for (mesh, outcome, notes) in read {
        context.warnings.extend(notes);
        match outcome? {
            Outcome::Drawn(primitive) => meshes[mesh].primitives.push(*primitive),
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

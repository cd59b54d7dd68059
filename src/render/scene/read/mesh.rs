//! Meshes (glTF 2.0, section 3.7). Meshes to which no node refers are not read.

use std::collections::HashMap;

use rayon::prelude::*;

use gltf::json;

use super::{Context, limits::MAX_ELEMENTS, primitive};
use crate::scene::{document::Primitive, error::Fault, material::Material};

/// Reads the primitives of the meshes that nodes use, all in parallel; the others stay empty. Points and lines without
/// normals get their own [materials](unlit_materials).
pub fn read_all(
    context: &mut Context<'_>,
    materials: &mut Vec<Material>,
) -> Result<(Vec<Vec<Primitive>>, UnlitCopies), Fault> {
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
    let triangles =
        primitives.iter().map(|(_, item, _)| primitive::claimed_triangles(item, shared)).fold(0, u64::saturating_add);
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
            let read = primitive::read(item, &place, shared, materials, &mut notes);
            (mesh, read, notes)
        })
        .collect();
    for (mesh, read, notes) in read {
        context.warnings.extend(notes);
        meshes[mesh].extend(read?);
    }
    let copies = unlit_materials(materials, meshes.iter_mut().flatten());
    Ok((meshes, copies))
}

/// Indices of materials and of their unlit copies, ascending.
pub type UnlitCopies = Vec<(usize, usize)>;

/// Makes points and lines without normals unlit, by copying their materials.
pub fn unlit_materials<'p>(
    materials: &mut Vec<Material>,
    primitives: impl Iterator<Item = &'p mut Primitive>,
) -> UnlitCopies {
    let mut copies = HashMap::new();
    for primitive in primitives.filter(|p| p.is_strokes() && p.normals.is_empty()) {
        let Some(material) = materials.get(primitive.material).filter(|m| !m.unlit) else {
            continue;
        };
        let unlit = Material { unlit: true, ..material.clone() };
        primitive.material = *copies.entry(primitive.material).or_insert_with(|| {
            materials.push(unlit);
            materials.len() - 1
        });
    }
    let mut copies: UnlitCopies = copies.into_iter().collect();
    copies.sort_unstable();
    copies
}

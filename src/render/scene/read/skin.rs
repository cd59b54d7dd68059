//! Skins (glTF 2.0, section 3.7.3).

use std::collections::BTreeSet;

use glam::{DAffine3, DMat3, DVec3};

use gltf::json::{self, Index, accessor::ComponentType};

use super::Context;
use crate::scene::{
    document::{Primitive, Skin},
    error::Fault,
};

/// Reads the skins of the nodes that have a mesh; the others stay empty.
pub fn read_all(context: &Context<'_>) -> Result<Vec<Skin>, Fault> {
    let root = &context.model.root;
    let mut skins = vec![Skin::default(); root.skins.len()];
    let nodes = root.nodes.iter().filter(|node| node.mesh.is_some());
    let used: BTreeSet<usize> = nodes.filter_map(|node| Some(node.skin?.value())).collect();
    for index in used {
        let (item, place) = context.model.get(Index::new(index as u32), "/skins")?;
        skins[index] = read(item, &place, context)?;
    }
    Ok(skins)
}

fn read(item: &json::Skin, place: &str, context: &Context<'_>) -> Result<Skin, Fault> {
    let model = context.model;
    model.check(&item.joints, &format!("{place}/joints"))?;
    let joints: Vec<usize> = item.joints.iter().map(Index::value).collect();
    let Some(matrices) = item.inverse_bind_matrices else {
        return Ok(Skin { inverse_bind: vec![DAffine3::IDENTITY; joints.len()], joints });
    };
    let matrices = context
        .accessor(matrices, &format!("{place}/inverseBindMatrices"))?
        .expect_components(&[16])?
        .expect_type(&[ComponentType::F32])?
        .expect_count(joints.len())?;
    let inverse_bind: Vec<DAffine3> = (0..joints.len())
        .map(|i| {
            let m = matrices.floats::<16>(i).map(f64::from);
            let column = |c: usize| DVec3::new(m[4 * c], m[4 * c + 1], m[4 * c + 2]);
            DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) }
        })
        .collect();
    if let Some(broken) = inverse_bind.iter().position(|m| !m.is_finite()) {
        return Err(matrices.fault(format!("matrix {broken} is not finite")));
    }
    Ok(Skin { joints, inverse_bind })
}

/// Checks that every node's skin has the joints to which its mesh's vertices refer.
pub fn check_joints(nodes: &[json::Node], meshes: &[Vec<Primitive>], skins: &[Skin]) -> Result<(), Fault> {
    let asked = |primitives: &Vec<Primitive>| {
        let sets = primitives.iter().flat_map(|p| &p.influences);
        sets.flat_map(|set| set.joints.as_flattened()).max().copied()
    };
    let asked: Vec<Option<u16>> = meshes.iter().map(asked).collect();
    for (index, node) in nodes.iter().enumerate() {
        let (Some(mesh), Some(skin)) = (node.mesh, node.skin) else {
            continue;
        };
        let (asked, joints) = (asked[mesh.value()], skins[skin.value()].joints.len());
        if let Some(asked) = asked.filter(|&asked| usize::from(asked) >= joints) {
            return Err(Fault::new(
                format!("/nodes/{index}/skin"),
                format!("the mesh's vertices refer to joint {asked}, but the skin has {joints} joints"),
            ));
        }
    }
    Ok(())
}

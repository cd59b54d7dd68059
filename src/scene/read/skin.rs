//! Skins (glTF 2.0, section 3.7.3).

use std::collections::BTreeSet;

use glam::{DAffine3, DMat3, DVec3};

use super::{Context, accessor::Component, json::Item};
use crate::scene::{
    document::{Mesh, Node, Skin},
    error::Fault,
};

/// Reads the skins of the nodes that have a mesh; the others stay empty.
pub fn read_all(context: &Context<'_>, nodes: &[Node]) -> Result<Vec<Skin>, Fault> {
    let items = context.root.objects("skins")?;
    let mut skins = vec![Skin::default(); items.len()];
    let used: BTreeSet<usize> = nodes.iter().filter_map(|node| node.skin).collect();
    for index in used {
        skins[index] = read(&items[index], context, nodes.len())?;
    }
    Ok(skins)
}

fn read(item: &Item<'_>, context: &Context<'_>, nodes: usize) -> Result<Skin, Fault> {
    let joints: Vec<usize> = item
        .array("joints")?
        .iter()
        .map(|joint| joint.as_index("nodes", nodes))
        .collect::<Result<_, _>>()?;
    let Some(matrices) = item.get("inverseBindMatrices") else {
        return Ok(Skin {
            inverse_bind: vec![DAffine3::IDENTITY; joints.len()],
            joints,
        });
    };
    let matrices = context
        .accessor(&matrices)?
        .expect_components(&[16])?
        .expect_type(&[Component::F32])?
        .expect_count(joints.len())?;
    let inverse_bind: Vec<DAffine3> = (0..joints.len())
        .map(|i| {
            let m = matrices.floats::<16>(i).map(f64::from);
            let column = |c: usize| DVec3::new(m[4 * c], m[4 * c + 1], m[4 * c + 2]);
            DAffine3 {
                matrix3: DMat3::from_cols(column(0), column(1), column(2)),
                translation: column(3),
            }
        })
        .collect();
    if let Some(broken) = inverse_bind.iter().position(|m| !m.is_finite()) {
        return Err(matrices.fault(format!("matrix {broken} is not finite")));
    }
    Ok(Skin {
        joints,
        inverse_bind,
    })
}

/// Checks that the skin of every node has the joints that its mesh's vertices ask for.
pub fn check_joints(nodes: &[Node], meshes: &[Mesh], skins: &[Skin]) -> Result<(), Fault> {
    let asked: Vec<Option<u16>> = meshes
        .iter()
        .map(|mesh| {
            let sets = mesh.primitives.iter().flat_map(|p| &p.influences);
            sets.flat_map(|set| set.joints.as_flattened())
                .max()
                .copied()
        })
        .collect();
    for (index, node) in nodes.iter().enumerate() {
        let (Some(mesh), Some(skin)) = (node.mesh, node.skin) else {
            continue;
        };
        let (Some(asked), Some(skin)) = (asked.get(mesh).copied().flatten(), skins.get(skin))
        else {
            continue;
        };
        if usize::from(asked) >= skin.joints.len() {
            return Err(Fault::new(
                format!("/nodes/{index}/skin"),
                format!(
                    "the mesh's vertices refer to joint {asked}, but the skin has {} joints",
                    skin.joints.len()
                ),
            ));
        }
    }
    Ok(())
}

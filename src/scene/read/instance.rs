//! Instances of a node's mesh (`EXT_mesh_gpu_instancing`).

use std::sync::Arc;

use glam::{DAffine3, DQuat, DVec3, Vec3, Vec4};

use super::{
    Context,
    accessor::{Accessor, Component},
    json::Item,
};
use crate::scene::{document::Parts, error::Fault};

/// Reads the transforms of the extension object `extension`, relative to the node.
pub fn read(extension: &Item<'_>, context: &mut Context<'_>) -> Result<Arc<[DAffine3]>, Fault> {
    let attributes = extension.require("attributes")?;
    let attribute = |name: &str, components: usize, types: &[Component]| {
        attributes
            .get(name)
            .map(|item| {
                context
                    .accessor(&item)?
                    .expect_components(&[components])?
                    .expect_type(types)
            })
            .transpose()
    };
    let floats = &[Component::F32];
    let translation = attribute("TRANSLATION", 3, floats)?;
    let rotation = attribute(
        "ROTATION",
        4,
        &[Component::F32, Component::I8, Component::I16],
    )?
    .map(Accessor::normalized);
    let scale = attribute("SCALE", 3, floats)?;

    let all = [&translation, &rotation, &scale];
    let mut counts = all.into_iter().flatten().map(|a| a.count);
    let count = counts
        .next()
        .ok_or_else(|| attributes.fault("has none of TRANSLATION, ROTATION and SCALE"))?;
    if counts.any(|other| other != count) {
        return Err(attributes.fault("the attributes differ in their number of elements"));
    }
    if !all.into_iter().flatten().any(|a| !a.is_void()) && count > 1 {
        return Err(attributes.fault(format!("claims {count} instances without any data")));
    }
    context.budget.add_instances(count, attributes.place())?;

    let instances = (0..count).map(|i| {
        let mut parts = Parts::default();
        if let Some(translation) = &translation {
            parts.translation = finite(translation.floats(i), DVec3::ZERO);
        }
        if let Some(rotation) = &rotation {
            let q = DQuat::from_vec4(Vec4::from_array(rotation.floats(i)).as_dvec4());
            let length = q.length();
            if length > 0.0 && length.is_finite() {
                parts.rotation = q / length;
            }
        }
        if let Some(scale) = &scale {
            parts.scale = finite(scale.floats(i), DVec3::ONE);
        }
        parts.affine()
    });
    Ok(instances.collect())
}

fn finite(v: [f32; 3], otherwise: DVec3) -> DVec3 {
    let v = Vec3::from_array(v).as_dvec3();
    if v.is_finite() { v } else { otherwise }
}

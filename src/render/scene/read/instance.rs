//! Instances of a node's mesh (`EXT_mesh_gpu_instancing`).

use std::{collections::BTreeMap, sync::Arc};

use glam::{DAffine3, DQuat, DVec3, Vec3, Vec4};
use gltf::json::{self, Index, accessor::ComponentType};
use serde_json::{Map, Value};

use super::{Context, accessor::Accessor, model};
use crate::scene::{document::Parts, error::Fault};

/// The extension object.
#[derive(serde::Deserialize)]
struct Instancing {
    attributes: BTreeMap<String, Index<json::Accessor>>,
}

/// Reads the transforms of instances, relative to the node at `place`; `None` if the node has no instances.
pub fn read(others: &Map<String, Value>, place: &str, context: &Context<'_>) -> Result<Option<Arc<[DAffine3]>>, Fault> {
    let found = model::extension(Some(others), "EXT_mesh_gpu_instancing", place)?;
    let Some((Instancing { attributes }, place)) = found else {
        return Ok(None);
    };
    let place = format!("{place}/attributes");
    let attribute = |name: &str, components: usize, types: &[ComponentType]| {
        let accessor = attributes.get(name).map(|&index| {
            context.accessor(index, &format!("{place}/{name}"))?.expect_components(&[components])?.expect_type(types)
        });
        accessor.transpose()
    };
    let floats = &[ComponentType::F32];
    let translation = attribute("TRANSLATION", 3, floats)?;
    let fractions = &[ComponentType::F32, ComponentType::I8, ComponentType::I16];
    let rotation = attribute("ROTATION", 4, fractions)?.map(Accessor::normalized);
    let scale = attribute("SCALE", 3, floats)?;

    let all = [&translation, &rotation, &scale];
    let mut counts = all.into_iter().flatten().map(|a| a.count);
    let fault = |reason: String| Fault::new(place.clone(), reason);
    let count = counts.next().ok_or_else(|| fault("has none of TRANSLATION, ROTATION and SCALE".to_owned()))?;
    if counts.any(|other| other != count) {
        return Err(fault("the attributes differ in their number of elements".to_owned()));
    }
    if !all.into_iter().flatten().any(|a| !a.is_void()) && count > 1 {
        return Err(fault(format!("claims {count} instances without any data")));
    }
    context.budget.add_instances(count, &place)?;

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
    Ok(Some(instances.collect()))
}

fn finite(v: [f32; 3], otherwise: DVec3) -> DVec3 {
    let v = Vec3::from_array(v).as_dvec3();
    if v.is_finite() { v } else { otherwise }
}

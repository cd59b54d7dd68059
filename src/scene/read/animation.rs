//! Animations (glTF 2.0, section 3.11). A channel that cannot be read is left out with a warning.

use std::{collections::HashMap, sync::Arc};

use super::{
    Context,
    accessor::{Accessor, Component},
    json::Item,
};
use crate::scene::{
    document::{Animation, Channel, Interpolation, Node, Path, Transform},
    error::Fault,
};

/// Numbers of accessors that were read already: samplers like to share them.
type Cache = HashMap<String, Arc<[f32]>>;

/// Reads all animations.
pub fn read_all(context: &mut Context<'_>, nodes: &[Node]) -> Result<Vec<Animation>, Fault> {
    let mut cache = Cache::new();
    let mut animations = Vec::new();
    for item in context.root.objects("animations")? {
        let parts = item
            .objects("samplers")
            .and_then(|samplers| Ok(Some((samplers, item.objects("channels")?))));
        let (samplers, items) = context
            .tolerate(parts, "the animation does nothing")
            .unwrap_or_default();
        let mut channels: Vec<Channel> = Vec::new();
        for channel in items {
            let read = read_channel(&channel, &samplers, context, nodes, &mut cache);
            channels.extend(context.tolerate(read, "the channel is left out"));
        }
        animations.push(Animation {
            name: item.name(),
            channels,
        });
    }
    Ok(animations)
}

/// `None` where the channel has no node, or animates something that no node has; both are valid.
fn read_channel(
    item: &Item<'_>,
    samplers: &[Item<'_>],
    context: &Context<'_>,
    nodes: &[Node],
    cache: &mut Cache,
) -> Result<Option<Channel>, Fault> {
    let target = item.require("target")?;
    let path = match target.text("path")? {
        Some("translation") => Path::Translation,
        Some("rotation") => Path::Rotation,
        Some("scale") => Path::Scale,
        Some("weights") => Path::Weights,
        _ => return Ok(None),
    };
    let Some(index) = target.index("node", "nodes", nodes.len())? else {
        return Ok(None);
    };
    if path != Path::Weights
        && let Some(node) = nodes.get(index)
        && matches!(node.transform, Transform::Matrix(_))
    {
        return Err(target.fault(format!(
            "nodes/{index} has a matrix, so that its {path:?} cannot be animated"
        )));
    }
    let sampler = item
        .require("sampler")?
        .as_index("samplers", samplers.len())?;
    let Some(sampler) = samplers.get(sampler) else {
        return Ok(None);
    };
    let interpolation = match sampler.text("interpolation")? {
        None | Some("LINEAR") => Interpolation::Linear,
        Some("STEP") => Interpolation::Step,
        Some("CUBICSPLINE") => Interpolation::CubicSpline,
        Some(other) => return Err(sampler.fault(format!("\"{other}\" is no interpolation"))),
    };
    let times = context
        .accessor(&sampler.require("input")?)?
        .expect_components(&[1])?
        .expect_type(&[Component::F32])?;
    let times = numbers(times, cache)?;
    if !times.is_sorted_by(|a, b| a < b) {
        return Err(sampler.fault("the times of the keyframes do not ascend strictly"));
    }

    let components = match path {
        Path::Translation | Path::Scale => 3,
        Path::Rotation => 4,
        Path::Weights => 1,
    };
    let output = context
        .accessor(&sampler.require("output")?)?
        .expect_components(&[components])?;
    let keyframes = match interpolation {
        Interpolation::CubicSpline => 3 * times.len(),
        Interpolation::Step | Interpolation::Linear => times.len(),
    };
    let per_keyframe = output.count / keyframes;
    let expected = if path == Path::Weights {
        per_keyframe >= 1
    } else {
        per_keyframe == 1
    };
    if !expected || output.count % keyframes != 0 {
        return Err(output.fault(format!(
            "{} elements do not fit {} keyframes of {interpolation:?} {path:?}",
            output.count,
            times.len()
        )));
    }
    Ok(Some(Channel {
        node: index,
        path,
        interpolation,
        values: numbers(output.normalized(), cache)?,
        width: per_keyframe * components,
        times,
    }))
}

/// All numbers of an accessor of up to four components.
fn numbers(accessor: Accessor<'_>, cache: &mut Cache) -> Result<Arc<[f32]>, Fault> {
    if let Some(known) = cache.get(accessor.place()) {
        return Ok(Arc::clone(known));
    }
    accessor.check_justified()?;
    let numbers: Arc<[f32]> = (0..accessor.count)
        .flat_map(|i| {
            accessor
                .floats::<4>(i)
                .into_iter()
                .take(accessor.components)
        })
        .collect();
    if let Some(broken) = numbers.iter().position(|x| !x.is_finite()) {
        let element = broken / accessor.components;
        return Err(accessor.fault(format!("element {element} is not finite")));
    }
    cache.insert(accessor.place().to_owned(), Arc::clone(&numbers));
    Ok(numbers)
}

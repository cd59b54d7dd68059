//! Animations (glTF 2.0, section 3.11) with pointers of `KHR_animation_pointer` to what moves nodes. A channel that cannot be
//! read is left out with a warning.

use std::{collections::HashMap, sync::Arc};

use gltf::json::{
    self, Index,
    accessor::ComponentType,
    animation::{self, Interpolation, Property},
    validation::Checked,
};

use super::{
    Context,
    accessor::Accessor,
    model::{self, Model},
};
use crate::scene::{
    document::{Channel, Node, Transform},
    error::Fault,
};

/// Numbers of accessors that were read already: samplers like to share them.
type Cache = HashMap<String, Arc<[f32]>>;

/// Reads the channels of all animations.
pub fn read_all(context: &mut Context<'_>, nodes: &[Node]) -> Vec<Vec<Channel>> {
    let mut cache = Cache::new();
    let mut animations = Vec::new();
    for found in context.model.all::<json::Animation>() {
        let mut channels: Vec<Channel> = Vec::new();
        let found = context.tolerate(found.map(Some), "the animation does nothing");
        if let Some((item, place)) = found {
            let all = item.channels.iter().enumerate();
            for (i, channel) in all.filter(|(_, c)| !model::is_nothing(c.sampler)) {
                let read = sampler_of(channel, i, item, &place).and_then(|(sampler, at)| {
                    let target = format!("{place}/channels/{i}/target");
                    read_channel(
                        &channel.target,
                        &target,
                        sampler,
                        &at,
                        context,
                        nodes,
                        &mut cache,
                    )
                });
                channels.extend(context.tolerate(read, "the channel is left out"));
            }
        }
        animations.push(channels);
    }
    animations
}

/// The sampler of channel `i`, and its place.
fn sampler_of<'i>(
    channel: &animation::Channel,
    i: usize,
    item: &'i json::Animation,
    place: &str,
) -> Result<(&'i animation::Sampler, String), Fault> {
    let index = channel.sampler.value();
    let sampler = item.samplers.get(index).ok_or_else(|| {
        let reason = format!("the animation has no samplers/{index}");
        Fault::new(format!("{place}/channels/{i}/sampler"), reason)
    })?;
    Ok((sampler, format!("{place}/samplers/{index}")))
}

/// `None` where the channel has no node, or animates something that no node has; both are valid.
fn read_channel(
    target: &animation::Target,
    target_place: &str,
    sampler: &animation::Sampler,
    place: &str,
    context: &Context<'_>,
    nodes: &[Node],
    cache: &mut Cache,
) -> Result<Option<Channel>, Fault> {
    let model = context.model;
    let (node, path, at) = match (target.path, pointed(model, target_place)?) {
        (Checked::Invalid, Some(pointed)) => pointed,
        (Checked::Valid(path), _) => (target.node, path, format!("{target_place}/node")),
        (Checked::Invalid, None) => return Ok(None),
    };
    if model::is_nothing(node) {
        return Ok(None);
    }
    model.check(&node, &at)?;
    let node = node.value();
    if path != Property::MorphTargetWeights && matches!(nodes[node].transform, Transform::Matrix(_))
    {
        let reason = format!("nodes/{node} has a matrix, so that its {path:?} cannot be animated");
        return Err(Fault::new(target_place, reason));
    }
    let interpolation = model.valid(&sampler.interpolation, &format!("{place}/interpolation"))?;
    let times = context
        .accessor(sampler.input, &format!("{place}/input"))?
        .expect_components(&[1])?
        .expect_type(&[ComponentType::F32])?;
    let times = numbers(times, cache)?;
    if !times.is_sorted_by(|a, b| a < b) {
        return Err(Fault::new(
            place,
            "the times of the keyframes do not ascend strictly",
        ));
    }

    let components = match path {
        Property::Translation | Property::Scale => 3,
        Property::Rotation => 4,
        Property::MorphTargetWeights => 1,
    };
    let output = context
        .accessor(sampler.output, &format!("{place}/output"))?
        .expect_components(&[components])?;
    let keyframes = match interpolation {
        Interpolation::CubicSpline => 3 * times.len(),
        Interpolation::Step | Interpolation::Linear => times.len(),
    };
    let per_keyframe = output.count / keyframes;
    let expected = if path == Property::MorphTargetWeights {
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
        node,
        path,
        interpolation,
        values: numbers(output.normalized(), cache)?,
        width: per_keyframe * components,
        times,
    }))
}

/// The node and property that a pointer of the target at `place` names, and where the pointer is.
fn pointed(
    model: &Model,
    place: &str,
) -> Result<Option<(Index<json::Node>, Property, String)>, Fault> {
    let place = format!("{place}/extensions/KHR_animation_pointer/pointer");
    let Some(pointer) = model.text(&place) else {
        return Ok(None);
    };
    let parts: Vec<&str> = pointer.split('/').collect();
    let named = match parts[..] {
        ["", "nodes", node, property] => {
            let property = match property {
                "translation" => Some(Property::Translation),
                "rotation" => Some(Property::Rotation),
                "scale" => Some(Property::Scale),
                "weights" => Some(Property::MorphTargetWeights),
                _ => None,
            };
            node.parse().ok().zip(property)
        }
        _ => None,
    };
    match named {
        Some((node, property)) => Ok(Some((Index::new(node), property, place))),
        None => {
            let reason = format!(
                "{pointer} keeps its value: of pointers, those to the translation, rotation, scale and weights of nodes are \
                 supported"
            );
            Err(Fault::new(place, reason))
        }
    }
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

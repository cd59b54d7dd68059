//! Animations (glTF 2.0, section 3.11) with pointers of `KHR_animation_pointer` to nodes, materials, lights and cameras. A
//! channel that cannot be read is left out with a warning.

use std::{collections::HashMap, sync::Arc};

use gltf::json::{
    self, Index,
    accessor::ComponentType,
    animation::{self, Interpolation, Property},
    extensions::scene::khr_lights_punctual::Light,
    validation::Checked,
};

use super::{
    Context,
    accessor::Accessor,
    described::{Change, Descriptions},
    model, pointer,
};
use crate::scene::{
    document::{Animated, Channel, Described, Node, Transform},
    error::Fault,
    material::Material,
};

/// Reads the channels of all animations, and the descriptions that have to be read again at each moment.
pub fn read_all(
    context: &mut Context<'_>,
    nodes: &[Node],
    materials: &[Material],
) -> (Vec<Vec<Channel>>, Descriptions) {
    let model = context.model;
    let mut reader = ChannelReader {
        descriptions: Descriptions::new(model),
        context,
        nodes,
        cache: KeyframeCache::default(),
        materials,
        examined: 0,
    };
    let mut animations = Vec::new();
    for found in model.all::<json::Animation>() {
        let mut channels: Vec<Channel> = Vec::new();
        let found = reader.context.tolerate(found.map(Some), "the animation does nothing");
        if let Some((item, place)) = found {
            let all = item.channels.iter().enumerate();
            for (i, channel) in all.filter(|(_, c)| !model::is_nothing(c.sampler)) {
                let read = sampler_of(channel, i, item, &place).and_then(|(sampler, at)| {
                    let target = format!("{place}/channels/{i}/target");
                    read_channel(&channel.target, &target, sampler, &at, &mut reader)
                });
                let read = reader.context.tolerate(read.map(Some), "the channel is left out");
                channels.extend(read.into_iter().flatten());
                let notes = reader.cache.notes.drain(..);
                reader.context.warnings.extend(notes);
            }
        }
        animations.push(channels);
    }
    (animations, reader.descriptions)
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

/// Reads a channel. Returns no channel if the target has no node or a property that no node has (both are valid), and
/// several channels if the pointer leads to data that several nodes share.
fn read_channel(
    target: &animation::Target,
    target_place: &str,
    sampler: &animation::Sampler,
    place: &str,
    reader: &mut ChannelReader<'_, '_>,
) -> Result<Vec<Channel>, Fault> {
    let model = reader.context.model;
    let (targets, at) = match (target.path, pointer::of(model, target_place)) {
        (Checked::Invalid, Some((pointer, at))) => (pointer::targets(model, pointer, &at)?, at),
        (Checked::Valid(path), _) if !model::is_nothing(target.node) => {
            let at = format!("{target_place}/node");
            model.check(&target.node, &at)?;
            (vec![Animated::Node(target.node.value(), path)], at)
        }
        _ => return Ok(Vec::new()),
    };
    let Some(first) = targets.first() else {
        return Ok(Vec::new());
    };
    if let Animated::Node(node, path) = *first
        && path != Property::MorphTargetWeights
        && matches!(reader.nodes[node].transform, Transform::Matrix(_))
    {
        let reason = format!("nodes/{node} has a matrix, so that its {path:?} cannot be animated");
        return Err(Fault::new(target_place, reason));
    }
    let channel = read_keyframes(first.clone(), sampler, place, reader)?;
    if let Animated::Description(described, pointer) = first {
        reader.check_effect(*described, pointer, &channel, &at)?;
    }
    let of_target = |target| Channel { target, ..channel.clone() };
    Ok(targets.into_iter().map(of_target).collect())
}

/// The keyframes of the sampler at `place`.
fn read_keyframes(
    target: Animated,
    sampler: &animation::Sampler,
    place: &str,
    reader: &mut ChannelReader<'_, '_>,
) -> Result<Channel, Fault> {
    let (context, cache) = (&*reader.context, &mut reader.cache);
    let interpolation_place = format!("{place}/interpolation");
    let interpolation = context.model.valid(&sampler.interpolation, &interpolation_place)?;
    let input = context
        .accessor(sampler.input, &format!("{place}/input"))?
        .expect_components(&[1])?
        .expect_type(&[ComponentType::F32])?;
    let components: &[usize] = match &target {
        Animated::Node(_, Property::Translation | Property::Scale) => &[3],
        Animated::Node(_, Property::Rotation) => &[4],
        Animated::Node(_, Property::MorphTargetWeights) | Animated::Weight(..) | Animated::Visibility(_) => &[1],
        Animated::Description(..) => &[1, 2, 3, 4],
    };
    if matches!(target, Animated::Visibility(_)) && interpolation != Interpolation::Step {
        let reason = "there is nothing between visible and not: only STEP is possible";
        return Err(Fault::new(interpolation_place, reason));
    }
    let output = context.accessor(sampler.output, &format!("{place}/output"))?.expect_components(components)?;
    let parts = match interpolation {
        Interpolation::CubicSpline => 3,
        Interpolation::Step | Interpolation::Linear => 1,
    };
    let keyframes = parts * input.count;
    let per_keyframe = output.count / keyframes;
    let expected = match target {
        Animated::Node(_, Property::MorphTargetWeights) => per_keyframe >= 1,
        _ => per_keyframe == 1,
    };
    if !expected || output.count % keyframes != 0 {
        return Err(output.fault(format!(
            "{} elements do not fit {} keyframes of {interpolation:?} {target}",
            output.count, input.count
        )));
    }
    let width = per_keyframe * output.components;
    let times = cache.times(&input)?;
    let values = cache.values(&output.normalized(), &times, parts * width)?;
    Ok(Channel { target, interpolation, width, values, times: times.kept })
}

/// Times of keyframes.
#[derive(Clone)]
struct KeyTimes {
    /// JSON pointer to the accessor.
    place: String,
    /// Times, which ascend strictly.
    kept: Arc<[f32]>,
    /// Indices of the keyframes that repeat the time of the one before, ascending.
    repeated: Arc<[usize]>,
}

impl KeyTimes {
    fn new(accessor: &Accessor<'_>) -> Result<Self, Fault> {
        let all = numbers(accessor)?;
        if !all.is_sorted() {
            return Err(accessor.fault("the times of the keyframes do not ascend"));
        }
        let repeats = |i: &usize| all[i - 1] == all[*i];
        let repeated: Arc<[usize]> = (1..all.len()).filter(repeats).collect();
        let mut kept = all;
        kept.dedup();
        Ok(Self { place: accessor.place().to_owned(), kept: kept.into(), repeated })
    }
}

/// Keyframes that were read already; samplers often share accessors.
#[derive(Default)]
struct KeyframeCache {
    times: HashMap<String, Result<KeyTimes, Fault>>,
    /// Values by the places of their own accessor and, if times repeat, of the times' accessor.
    values: HashMap<(String, Option<String>), Arc<[f32]>>,
    /// Faults that are tolerated.
    notes: Vec<Fault>,
}

impl KeyframeCache {
    /// Times of an accessor. A keyframe that repeats the time of the one before is left out with a note.
    fn times(&mut self, accessor: &Accessor<'_>) -> Result<KeyTimes, Fault> {
        if let Some(known) = self.times.get(accessor.place()) {
            return known.clone();
        }
        let times = KeyTimes::new(accessor);
        if let Ok(KeyTimes { repeated, .. }) = &times
            && !repeated.is_empty()
        {
            let reason = format!(
                "{} of {} keyframes repeat the time of the one before and are left out",
                repeated.len(),
                accessor.count
            );
            self.notes.push(accessor.fault(reason));
        }
        let place = accessor.place().to_owned();
        self.times.entry(place).or_insert(times).clone()
    }

    /// Values of an accessor, `width` numbers for each keyframe, without those of the keyframes that `times` leaves out.
    fn values(&mut self, accessor: &Accessor<'_>, times: &KeyTimes, width: usize) -> Result<Arc<[f32]>, Fault> {
        let repeats = !times.repeated.is_empty();
        let key = (accessor.place().to_owned(), repeats.then(|| times.place.clone()));
        if let Some(known) = self.values.get(&key) {
            return Ok(Arc::clone(known));
        }
        let mut values = numbers(accessor)?;
        if repeats {
            let keyframes = values.chunks(width).enumerate();
            let kept = keyframes.filter(|(i, _)| times.repeated.binary_search(i).is_err());
            values = kept.flat_map(|(_, value)| value).copied().collect();
        }
        let values: Arc<[f32]> = values.into();
        self.values.insert(key, Arc::clone(&values));
        Ok(values)
    }
}

/// Reader of channels.
struct ChannelReader<'c, 'm> {
    context: &'c mut Context<'m>,
    nodes: &'c [Node],
    cache: KeyframeCache,
    descriptions: Descriptions,
    materials: &'c [Material],
    /// Number of keyframes whose effect was examined.
    examined: usize,
}

impl ChannelReader<'_, '_> {
    /// Refuses a channel with values that the description can't have at `pointer`, and warns of a channel that changes
    /// nothing.
    fn check_effect(
        &mut self,
        described: Described,
        pointer: &str,
        channel: &Channel,
        place: &str,
    ) -> Result<(), Fault> {
        /// Largest numbers of keyframes that are examined: for one channel, and for all channels together.
        const MOST: usize = 64;
        const MOST_OF_ALL: usize = 1 << 14;
        let model = self.context.model;
        let wrong = |fault: Fault| Fault::new(place, format!("{pointer} keeps its value: {fault}"));
        let descriptions = &self.descriptions;
        // Warnings are dropped here: they are reported when the moment is drawn.
        let mut unheard = self.context.warnings.of_the_same_file();
        let mut read = |changes: &[Change<'_>]| -> Result<_, Fault> {
            Ok(descriptions.read(described, changes, self.materials, &mut unheard)?.ok())
        };
        match described {
            Described::Material(i) => model.check(&Index::<json::Material>::new(i as u32), place)?,
            Described::Light(i) => model.check(&Index::<Light>::new(i as u32), place)?,
            Described::Camera(i) => model.check(&Index::<json::Camera>::new(i as u32), place)?,
        }
        let at_rest = read(&[])?;
        // At least the first keyframe is examined, to check the type.
        let most = MOST.min(MOST_OF_ALL.saturating_sub(self.examined)).max(1);
        let step = channel.times.len().div_ceil(most);
        for keyframe in (0..channel.times.len()).step_by(step) {
            self.examined += 1;
            let values = channel.keyframe(keyframe);
            if read(&[(pointer, values)]).map_err(wrong)? != at_rest {
                return Ok(());
            }
        }
        if self.examined >= MOST_OF_ALL {
            return Ok(());
        }
        let reason = format!("{pointer} by itself changes nothing that is drawn");
        self.context.warn(&Fault::new(place, reason));
        Ok(())
    }
}

/// Numbers of an accessor of up to four components.
fn numbers(accessor: &Accessor<'_>) -> Result<Vec<f32>, Fault> {
    accessor.check_justified()?;
    let numbers: Vec<f32> =
        (0..accessor.count).flat_map(|i| accessor.floats::<4>(i).into_iter().take(accessor.components)).collect();
    if let Some(broken) = numbers.iter().position(|x| !x.is_finite()) {
        let element = broken / accessor.components;
        return Err(accessor.fault(format!("element {element} is not finite")));
    }
    Ok(numbers)
}

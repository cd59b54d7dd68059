//! Animated values between keyframes (glTF 2.0, section 3.11 and appendix C).

use glam::DQuat;
use gltf::json::{Animation, animation::Interpolation};

use super::PoseRequest;
use crate::scene::{
    SceneError,
    document::{Channel, Document},
};

/// Channels of the requested animation; empty if there is none.
pub fn choose<'d>(document: &'d Document, request: &PoseRequest) -> Result<&'d [Channel], SceneError> {
    let animations = &document.root.animations;
    let channels = |index: usize| document.animations.get(index).map(Vec::as_slice);
    let Some(asked) = &request.animation else {
        return Ok(channels(0).filter(|_| request.time > 0.0).unwrap_or_default());
    };
    let named = animations.iter().position(|animation| animation.name.as_ref() == Some(asked));
    let index = named.or_else(|| asked.parse().ok());
    index.and_then(channels).ok_or_else(|| SceneError::NoSuchAnimation {
        file: document.file.clone(),
        asked: asked.clone(),
        known: describe(animations),
    })
}

fn describe(animations: &[Animation]) -> String {
    if animations.is_empty() {
        return "the file has none".to_owned();
    }
    let names: Vec<String> = animations
        .iter()
        .enumerate()
        .map(|(i, animation)| match &animation.name {
            Some(name) => format!("{i} \"{name}\""),
            None => i.to_string(),
        })
        .collect();
    format!("the file has {}", names.join(", "))
}

/// Value of `channel` at `time` in seconds: `channel.width` numbers. Rotations are unit quaternions.
pub fn sample(channel: &Channel, time: f64) -> Vec<f64> {
    let times = &channel.times;
    let last = times.len().saturating_sub(1);
    let seconds = |i: usize| times.get(i).map_or(0.0, |&t| f64::from(t));
    let after = times.partition_point(|&t| f64::from(t) <= time);
    let mut value = if after == 0 {
        channel.keyframe(0)
    } else if after > last || channel.interpolation == Interpolation::Step {
        channel.keyframe(after - 1)
    } else {
        let (start, end) = (seconds(after - 1), seconds(after));
        let fraction = (time - start) / (end - start);
        match channel.interpolation {
            Interpolation::CubicSpline => spline(channel, after - 1, fraction, end - start),
            _ => linear(channel, after - 1, fraction),
        }
    };
    if channel.is_rotation() {
        normalize(&mut value);
    }
    value
}

fn linear(channel: &Channel, i: usize, fraction: f64) -> Vec<f64> {
    let (from, to) = (channel.keyframe(i), channel.keyframe(i + 1));
    if channel.is_rotation() {
        let quaternion = |q: &[f64]| match *q {
            [x, y, z, w] => DQuat::from_xyzw(x, y, z, w).normalize(),
            _ => DQuat::IDENTITY,
        };
        // glam interpolates along the shorter arc.
        return quaternion(&from).slerp(quaternion(&to), fraction).to_array().to_vec();
    }
    let mix = |(a, b)| a + (b - a) * fraction;
    from.into_iter().zip(to).map(mix).collect()
}

/// Cubic Hermite spline; tangents are per second, hence the `duration` of the interval.
fn spline(channel: &Channel, i: usize, t: f64, duration: f64) -> Vec<f64> {
    let (t2, t3) = (t * t, t * t * t);
    let weights =
        [2.0 * t3 - 3.0 * t2 + 1.0, duration * (t3 - 2.0 * t2 + t), -2.0 * t3 + 3.0 * t2, duration * (t3 - t2)];
    let terms = [channel.part(i, 1, 3), channel.part(i, 2, 3), channel.part(i + 1, 1, 3), channel.part(i + 1, 0, 3)];
    let mut value = vec![0.0; channel.width];
    for (weight, term) in weights.into_iter().zip(terms) {
        for (sum, x) in value.iter_mut().zip(term) {
            *sum += weight * x;
        }
    }
    value
}

fn normalize(quaternion: &mut [f64]) {
    let length = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 && length.is_finite() {
        for x in quaternion {
            *x /= length;
        }
    } else if let [x, y, z, w] = quaternion {
        (*x, *y, *z, *w) = (0.0, 0.0, 0.0, 1.0);
    }
}

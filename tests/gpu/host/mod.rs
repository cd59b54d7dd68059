//! A host that works in the library's device: its pictures must not depend on the way in which it lends its buffers
//! and images.

mod alpha;
mod base;
mod behind;
mod besides;
mod blend;
mod completion;
mod draws;
mod facing;
mod filters;
mod formats;
mod frames;
mod indirect;
mod layers;
mod lent;
mod list;
mod machine;
mod mask;
mod pixel_filter;
mod room;
mod rounds;
mod targets;
mod viewport;
mod world;

/// Largest difference of any channel.
fn farthest(a: &[[f32; 4]], b: &[[f32; 4]]) -> f32 {
    assert_eq!(a.len(), b.len());
    let channels = a.as_flattened().iter().zip(b.as_flattened());
    channels.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

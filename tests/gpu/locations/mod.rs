//! Sampling at any locations: compared with images at the same places, and with the exact twin at others.

mod equivalence;
mod extremes;
mod image;
mod sets;
mod shadows;
mod thin;
mod twin;

use gpc::camera::{Pinhole, SampleLocation};

use crate::stage::camera;

/// Pinhole of all stages, for an image of `size` pixels.
pub fn pinhole(size: [u32; 2]) -> Pinhole {
    Pinhole::from_camera(&camera(), size).unwrap()
}

/// A location whose cell is a pixel of the plane.
fn location(uv: [f64; 2], output: u32) -> SampleLocation {
    SampleLocation { uv, jacobian: [[1.0, 0.0], [0.0, 1.0]], output }
}

/// Locations at the centres of an image's pixels.
pub fn planar([width, height]: [u32; 2]) -> Vec<SampleLocation> {
    (0..width * height)
        .map(|pixel| {
            let at = [pixel % width, pixel / width];
            location(at.map(|v| f64::from(v) + 0.5), pixel)
        })
        .collect()
}

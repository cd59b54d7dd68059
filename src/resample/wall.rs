//! Simulation of several projectors that light the same wall.

use super::{Photograph, pixels};
use crate::camera::projector::Projector;

/// Adds up the projectors' light on the wall: an image of `size` = [width, height] of the picture that they show
/// together, rows from the top, linear light, opaque. Each frame appears where its projector's map sends it; places
/// that no projector reaches stay black.
#[must_use]
pub fn light_on_wall(size: [u32; 2], frames: &[(&Projector, &Photograph)]) -> Vec<[f32; 4]> {
    pixels(size, |location| {
        let mut sum = [0.0; 3];
        for (projector, frame) in frames {
            let Some(place) = projector.place(location) else {
                continue;
            };
            let Some(jacobian) = projector.jacobian(place) else {
                continue;
            };
            let light = frame.sample(place, jacobian.inverse());
            for (sum, light) in sum.iter_mut().zip(light) {
                *sum += light;
            }
        }
        let [r, g, b] = sum;
        [r, g, b, 1.0]
    })
}

//! Simulation of several projectors that light the same wall.

use super::Photograph;
use crate::camera::projector::Projector;
use glam::DVec2;
use rayon::prelude::*;

/// Adds up the projectors' light on the wall: an image of `size` = [width, height] of the picture that they show
/// together, rows from the top, linear light, opaque. Each frame appears where its projector's map sends it; places
/// that no projector reaches stay black.
#[must_use]
pub fn light_on_wall(size: [u32; 2], frames: &[(&Projector, &Photograph)]) -> Vec<[f32; 4]> {
    let light = |location: DVec2| {
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
    };
    let row = |row: u32| {
        let light = &light;
        (0..size[0]).into_par_iter().map(move |col| light(DVec2::new(f64::from(col) + 0.5, f64::from(row) + 0.5)))
    };
    (0..size[1]).into_par_iter().flat_map(row).collect()
}

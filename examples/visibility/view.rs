//! What the host shows: the time and the view of each frame, and how it is antialiased.

use crate::slot::SKY;
use glam::{Mat4, Vec3};
use gpc::host::Options;

/// Time of the animation in seconds.
pub fn time(frame: usize) -> f32 {
    0.4 * frame as f32
}

/// Matrix from the world to clip space, y up, and the projection in it.
pub fn camera([width, height]: [u32; 2]) -> (Mat4, Mat4) {
    let aspect = width as f32 / height as f32;
    let projection = Mat4::perspective_infinite_reverse_rh(0.9, aspect, 0.1);
    let view = Mat4::look_at_rh(Vec3::new(1.0, 2.2, 5.5), Vec3::new(0.0, 0.7, 0.0), Vec3::Y);
    (projection * view, projection)
}
/// Options of frames in a size.
pub fn options(size: [u32; 2]) -> Options {
    Options::new(size[0], size[1]).background(Some(SKY))
}

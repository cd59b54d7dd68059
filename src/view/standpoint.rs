//! Where a scene is seen from: one of its cameras, or where the user went.

use super::navigate::{Bounds, Turntable};
use gpc::camera::{Camera, CameraError};
use gpc::scene::SceneCamera;

/// Where a scene is seen from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Standpoint {
    /// A camera of the scene by index.
    Camera(usize),
    /// Anywhere.
    Free(Turntable),
}

impl Standpoint {
    /// The first view of a scene: its first camera, or else one that shows everything.
    pub fn first(cameras: &[SceneCamera], bounds: Bounds, aspect: f64) -> Self {
        if cameras.is_empty() {
            Self::Free(Turntable::fitting(bounds, aspect))
        } else {
            Self::Camera(0)
        }
    }

    /// The camera. One that the scene no longer has becomes a view of everything.
    ///
    /// # Errors
    /// If the user went where no direction is left.
    pub fn camera(
        &self,
        cameras: &[SceneCamera],
        bounds: Bounds,
        aspect: f64,
    ) -> Result<Camera, CameraError> {
        let turntable = match self {
            Self::Camera(index) => match cameras.get(*index) {
                Some(camera) => return Ok(Camera::from_scene(camera)),
                None => Turntable::fitting(bounds, aspect),
            },
            Self::Free(turntable) => *turntable,
        };
        turntable.viewpoint().frame(bounds.0, bounds.1)
    }

    /// Moves; a camera of the scene is left for a turntable that stands there.
    pub fn go(
        &mut self,
        cameras: &[SceneCamera],
        bounds: Bounds,
        aspect: f64,
        change: impl FnOnce(&mut Turntable),
    ) {
        let mut turntable = match self {
            Self::Free(turntable) => *turntable,
            Self::Camera(index) => match cameras.get(*index) {
                Some(camera) => Turntable::of_camera(&Camera::from_scene(camera), bounds),
                None => Turntable::fitting(bounds, aspect),
            },
        };
        change(&mut turntable);
        *self = Self::Free(turntable);
    }
}

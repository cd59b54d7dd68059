//! Standpoints in a scene: one of its cameras, or a place to which the user moved.

use super::navigate::{Bounds, Turntable};
use glam::DVec3;
use gpc::camera::{Camera, CameraError, Orbit, Viewpoint};
use gpc::scene::SceneCamera;

/// Standpoint at the start, in the first scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Start {
    /// First camera of the scene, or a view of the whole scene if it has none.
    #[default]
    First,
    /// Camera with this name or index.
    Camera(String),
    /// A position. Without a target, the camera looks at the scene's centre.
    Place {
        eye: DVec3,
        target: Option<DVec3>,
        /// Vertical field of view in degrees.
        fov: f64,
    },
    /// View of the whole scene from an angle.
    Around(Orbit),
}

/// Error: a standpoint that does not exist.
#[derive(Debug, thiserror::Error)]
pub enum NoStart {
    #[error("there is no camera {asked}; the scene has {found}")]
    Camera { asked: String, found: String },
    #[error(transparent)]
    Impossible(#[from] CameraError),
}

impl Start {
    /// The standpoint of the first scene, in an image of `aspect` = width / height.
    ///
    /// # Errors
    /// If the scene has no such camera, or the place and target give no view.
    pub fn standpoint(&self, cameras: &[SceneCamera], bounds: Bounds, aspect: f64) -> Result<Standpoint, NoStart> {
        let turntable = match self {
            Self::First => return Ok(Standpoint::first(cameras, bounds, aspect)),
            Self::Camera(asked) => return find(asked, cameras).map(Standpoint::Camera),
            Self::Place { eye, target, fov } => {
                let viewpoint = Viewpoint {
                    eye: *eye,
                    target: target.unwrap_or(0.5 * (bounds.0 + bounds.1)),
                    up: DVec3::Y,
                    fov: *fov,
                };
                Turntable::of_viewpoint(&viewpoint, bounds)?
            }
            Self::Around(orbit) => Turntable::of_orbit(orbit, bounds, aspect)?,
        };
        Ok(Standpoint::Free(turntable))
    }
}

fn find(asked: &str, cameras: &[SceneCamera]) -> Result<usize, NoStart> {
    SceneCamera::find(cameras, asked).ok_or_else(|| NoStart::Camera {
        asked: asked.to_owned(),
        found: match cameras.len() {
            0 => "none".to_owned(),
            1 => "camera 0 alone".to_owned(),
            count => format!("those from 0 to {}", count - 1),
        },
    })
}

/// Standpoint from which a scene is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Standpoint {
    /// Index of a camera of the scene.
    Camera(usize),
    /// A turntable, which can stand anywhere.
    Free(Turntable),
}

impl Standpoint {
    /// The standpoint of a newly opened scene: its first camera, or a view of the whole scene if it has none.
    pub fn first(cameras: &[SceneCamera], bounds: Bounds, aspect: f64) -> Self {
        if cameras.is_empty() { Self::Free(Turntable::fitting(bounds, aspect)) } else { Self::Camera(0) }
    }

    /// The camera at this standpoint. An index that the scene does not have gives a view of the whole scene.
    ///
    /// # Errors
    /// If eye and target have come to coincide.
    pub fn camera(&self, cameras: &[SceneCamera], bounds: Bounds, aspect: f64) -> Result<Camera, CameraError> {
        let turntable = match self {
            Self::Camera(index) => match cameras.get(*index) {
                Some(camera) => return Ok(Camera::from_scene(camera)),
                None => Turntable::fitting(bounds, aspect),
            },
            Self::Free(turntable) => *turntable,
        };
        turntable.viewpoint().frame(bounds.0, bounds.1)
    }

    /// Moves the standpoint. A camera of the scene is first replaced by a turntable at its position.
    pub fn go(&mut self, cameras: &[SceneCamera], bounds: Bounds, aspect: f64, change: impl FnOnce(&mut Turntable)) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;
    use gpc::scene::SceneProjection;

    const BOUNDS: Bounds = (DVec3::ZERO, DVec3::ONE);

    fn camera(name: &str) -> SceneCamera {
        SceneCamera {
            name: Some(name.to_owned()),
            eye: DVec3::ZERO,
            axes: DMat3::IDENTITY,
            projection: SceneProjection::Perspective { yfov: 1.0, aspect: None, near: 0.1, far: None },
        }
    }

    #[test]
    fn cameras_are_found_by_name_or_index() {
        let cameras = [camera("left"), camera("0")];
        let find = |asked: &str| {
            let start = Start::Camera(asked.to_owned());
            start.standpoint(&cameras, BOUNDS, 1.0)
        };
        assert_eq!(find("left").unwrap(), Standpoint::Camera(0));
        assert_eq!(find("0").unwrap(), Standpoint::Camera(1));
        assert_eq!(find("1").unwrap(), Standpoint::Camera(1));
        for asked in ["2", "all", "-1"] {
            let error = find(asked).unwrap_err().to_string();
            assert!(error.contains("from 0 to 1"), "{error}");
        }
    }

    #[test]
    fn a_place_without_a_target_looks_at_the_centre() {
        let start = Start::Place { eye: DVec3::new(0.5, 0.5, 4.0), target: None, fov: 40.0 };
        let Ok(Standpoint::Free(turntable)) = start.standpoint(&[], BOUNDS, 1.0) else {
            panic!("a turntable");
        };
        assert_eq!(turntable.target, DVec3::splat(0.5));
        assert!((turntable.distance - 3.5).abs() < 1e-12 && turntable.azimuth.abs() < 1e-9);
    }
}

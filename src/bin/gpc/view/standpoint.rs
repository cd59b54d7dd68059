//! Standpoints in a scene: one of its cameras, or a place to which the user moved.

use super::navigate::{Bounds, Turntable};
use crate::cli::exit::Usage;
use crate::cli::render::args::CameraArgs;
use crate::cli::render::view;
use gpc::camera::{Camera, CameraError};
use gpc::scene::SceneCamera;

/// Standpoint from which a scene is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Standpoint {
    /// Index of a camera of the scene.
    Camera(usize),
    /// A turntable, which can stand anywhere.
    Free(Turntable),
}

impl Standpoint {
    /// The standpoint that the command's options ask for, in an image of `aspect` = width / height.
    ///
    /// # Errors
    /// If the scene has no such camera, or the options describe no view.
    pub fn asked(args: &CameraArgs, cameras: &[SceneCamera], bounds: Bounds, aspect: f64) -> Result<Self, Usage> {
        if let Some(view) = view::describe(args, cameras, bounds, aspect)? {
            return Ok(Self::Free(Turntable::aimed(&view.camera, view.target, bounds)));
        }
        let index = args.camera.as_deref().map(|asked| view::find(asked, cameras));
        Ok(Self::Camera(index.transpose()?.unwrap_or(0)))
    }

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
    use glam::{DMat3, DVec3};
    use gpc::camera::Orbit;
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

    fn turntable(args: &CameraArgs) -> Turntable {
        match Standpoint::asked(args, &[camera("left")], BOUNDS, 1.0) {
            Ok(Standpoint::Free(turntable)) => turntable,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn cameras_are_found_by_name_or_index() {
        let find = |asked: &str| {
            let args = CameraArgs { camera: Some(asked.to_owned()), ..CameraArgs::default() };
            Standpoint::asked(&args, &[camera("left"), camera("0")], BOUNDS, 1.0)
        };
        assert_eq!(find("left").unwrap(), Standpoint::Camera(0));
        assert_eq!(find("0").unwrap(), Standpoint::Camera(1));
        assert_eq!(find("1").unwrap(), Standpoint::Camera(1));
        for asked in ["2", "all", "-1"] {
            let error = find(asked).unwrap_err().to_string();
            assert!(error.contains("0 \"left\", 1 \"0\""), "{error}");
        }
    }

    #[test]
    fn a_place_without_a_target_looks_at_the_centre() {
        let place = CameraArgs { eye: Some(DVec3::new(0.5, 0.5, 4.0)), ..CameraArgs::default() };
        let found = turntable(&place);
        assert_eq!(found.target, DVec3::splat(0.5));
        assert!((found.distance - 3.5).abs() < 1e-12 && found.azimuth.abs() < 1e-9);
    }

    #[test]
    fn places_and_angles_are_taken_over() {
        let (eye, target) = (DVec3::new(3.0, 4.0, 5.0), DVec3::new(0.5, 0.25, -1.0));
        let place = CameraArgs { eye: Some(eye), target: Some(target), fov: Some(30.0), ..CameraArgs::default() };
        let found = turntable(&place);
        assert!((found.viewpoint().eye - eye).length() < 1e-9);
        assert_eq!((found.target, found.fov.round()), (target, 30.0));
        let nowhere = CameraArgs { target: Some(eye), ..place };
        assert!(Standpoint::asked(&nowhere, &[], BOUNDS, 1.0).is_err());
        let orbit = Orbit { azimuth: 100.0, elevation: -20.0, zoom: 2.0, fov: 50.0 };
        let found = turntable(&CameraArgs {
            azimuth: Some(orbit.azimuth),
            elevation: Some(orbit.elevation),
            zoom: Some(orbit.zoom),
            fov: Some(orbit.fov),
            ..CameraArgs::default()
        });
        let expected = orbit.frame(BOUNDS.0, BOUNDS.1, 1.0).unwrap();
        assert!((found.viewpoint().eye - expected.eye).length() < 1e-9);
        assert!((found.azimuth - 100.0).abs() < 1e-9 && (found.elevation + 20.0).abs() < 1e-9);
    }
}

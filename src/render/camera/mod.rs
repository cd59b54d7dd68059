//! Cameras: position, direction, projection, and the locations at which they sample.
//!
//! [`Camera`] is a planar pinhole camera as files describe it; it knows no image size. [`Pinhole`] is the general
//! camera: a centre of projection and an image plane in pixels.
//!
//! World space is glTF's: right-handed, y up. View space has its origin at the eye, x right, y up, and looks along -z.
//! Clip space has y up as well; depth runs from 1 at the near plane to 0 at the far plane (reversed), so that float
//! depth is precise at any distance. Pixel positions are x right, y down, with the image's upper left corner at (0,
//! 0).

mod framing;
mod map;
pub mod panorama;
mod pinhole;
pub mod projector;
mod rig;
mod sample_location;
pub mod set;
pub mod zoom;

pub use framing::{Orbit, Viewpoint};
pub use map::LocationMap;
pub use pinhole::{Pinhole, PinholeError, Ray};
pub use rig::{Rig, RigError};
pub use sample_location::SampleLocation;

use crate::scene::{SceneCamera, SceneProjection};
use glam::{DMat3, DMat4, DQuat, DVec2, DVec3, DVec4};

/// Projection of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Perspective: lines of sight meet at the eye.
    Perspective {
        /// Vertical field of view in radians, above 0 and below pi.
        fov: f64,
        /// Distance of the near plane, above 0.
        near: f64,
        /// Distance of the far plane; `None` is infinite.
        far: Option<f64>,
    },
    /// Orthographic projection: lines of sight are parallel.
    Orthographic {
        /// Half of the image's height in world units, above 0.
        half_height: f64,
        /// Distance of the near plane; may be negative.
        near: f64,
        /// Distance of the far plane, above `near`.
        far: f64,
    },
}

/// A camera in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position of the eye in world space.
    pub eye: DVec3,
    /// Axes of view space in world space, as columns: right, up and backward, orthonormal.
    pub axes: DMat3,
    /// Projection of the camera.
    pub projection: Projection,
    /// Shift of the image plane to the right and down, in widths and heights of the image; the picture moves the other
    /// way. Zero centres the image on the direction of view. A shift by a fraction of a pixel samples the same picture
    /// at other places.
    pub shift: DVec2,
}

/// Error: a camera that can't exist.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CameraError {
    /// Eye, target and up that give no direction: not finite, eye and target coincide, or up lies along the view.
    #[error(
        "eye {eye}, target {target} and up {up} give no direction to look at: eye and target must differ, and up must not lie along the view"
    )]
    Direction {
        /// Position of the camera.
        eye: DVec3,
        /// Point that the camera looks at.
        target: DVec3,
        /// Direction that is up in the image.
        up: DVec3,
    },
    /// Vertical field of view in degrees that is not between 0 and 180.
    #[error("a field of view of {0} degrees: it must be above 0 and below 180")]
    FieldOfView(f64),
}

impl Camera {
    /// Perspective camera at `eye` that looks at `target`, with `up` as close to the image's upward direction as
    /// possible. `fov_degrees` is the vertical field of view.
    ///
    /// # Errors
    /// [`CameraError`] if eye and target coincide, `up` lies along the view, or the field of view is not between 0 and
    /// 180 degrees.
    pub fn look_at(eye: DVec3, target: DVec3, up: DVec3, fov_degrees: f64, near: f64) -> Result<Self, CameraError> {
        if !(fov_degrees > 0.0 && fov_degrees < 180.0) {
            return Err(CameraError::FieldOfView(fov_degrees));
        }
        let axes = axes_towards(target - eye, up).ok_or(CameraError::Direction { eye, target, up })?;
        Ok(Self {
            eye,
            axes,
            projection: Projection::Perspective { fov: fov_degrees.to_radians(), near, far: None },
            shift: DVec2::ZERO,
        })
    }

    /// Camera of a scene file. If the image has another aspect ratio than the file's camera, the height of the view is
    /// kept.
    #[must_use]
    pub fn from_scene(camera: &SceneCamera) -> Self {
        let projection = match camera.projection {
            SceneProjection::Perspective { yfov, near, far, .. } => Projection::Perspective { fov: yfov, near, far },
            SceneProjection::Orthographic { ymag, near, far, .. } => {
                Projection::Orthographic { half_height: ymag, near, far }
            }
        };
        Self { eye: camera.eye, axes: camera.axes, projection, shift: DVec2::ZERO }
    }

    /// This camera, turned about the vertical axis through `point` by `degrees`, counter-clockwise as seen from above.
    #[must_use]
    pub fn turned(&self, point: DVec3, degrees: f64) -> Self {
        let turn = DQuat::from_rotation_y(degrees.to_radians());
        Self { eye: point + turn * (self.eye - point), axes: DMat3::from_quat(turn) * self.axes, ..*self }
    }

    /// Unit vector that the camera looks along.
    #[must_use]
    pub fn direction(&self) -> DVec3 {
        -self.axes.z_axis
    }

    /// Whether the projection is orthographic: lines of sight are parallel.
    #[must_use]
    pub fn is_orthographic(&self) -> bool {
        matches!(self.projection, Projection::Orthographic { .. })
    }

    /// Matrix from world space to view space.
    #[must_use]
    pub fn view(&self) -> DMat4 {
        self.view_from(DVec3::ZERO)
    }

    /// Matrix from positions relative to `origin` to view space. The computation is in double precision, so that large
    /// coordinates of `origin` and of the eye cancel before anything is rounded.
    #[must_use]
    pub fn view_from(&self, origin: DVec3) -> DMat4 {
        let turn = self.axes.transpose();
        let shift = turn * (origin - self.eye);
        DMat4::from_cols(turn.x_axis.extend(0.0), turn.y_axis.extend(0.0), turn.z_axis.extend(0.0), shift.extend(1.0))
    }

    /// Matrix from view space to clip space, for an image of `aspect` = width / height.
    #[must_use]
    pub fn projection_matrix(&self, aspect: f64) -> DMat4 {
        let centred = match self.projection {
            Projection::Perspective { fov, near, far } => {
                let f = 1.0 / (0.5 * fov).tan();
                // depth * w is `near` if the far plane is at infinity; otherwise it is linear, 1 at the near plane and
                // 0 at the far plane.
                let (a, b) = far.map_or((0.0, near), |far| (near / (far - near), near * far / (far - near)));
                DMat4::from_cols(
                    DVec4::new(f / aspect, 0.0, 0.0, 0.0),
                    DVec4::new(0.0, f, 0.0, 0.0),
                    DVec4::new(0.0, 0.0, a, -1.0),
                    DVec4::new(0.0, 0.0, b, 0.0),
                )
            }
            Projection::Orthographic { half_height, near, far } => {
                let depth = 1.0 / (far - near);
                DMat4::from_cols(
                    DVec4::new(1.0 / (half_height * aspect), 0.0, 0.0, 0.0),
                    DVec4::new(0.0, 1.0 / half_height, 0.0, 0.0),
                    DVec4::new(0.0, 0.0, depth, 0.0),
                    DVec4::new(0.0, 0.0, far * depth, 1.0),
                )
            }
        };
        // Clip space is 2 high and y up.
        let moved = DVec3::new(-2.0 * self.shift.x, 2.0 * self.shift.y, 0.0);
        DMat4::from_translation(moved) * centred
    }

    /// Matrix from positions relative to `origin` to (x w, y w, depth w, w). The pixel positions x and y are relative
    /// to the centre of an image of `width` x `height` pixels, y down.
    #[must_use]
    pub fn pixel_matrix(&self, origin: DVec3, width: f64, height: f64) -> DMat4 {
        let to_pixels = DMat4::from_diagonal(DVec4::new(0.5 * width, -0.5 * height, 1.0, 1.0));
        to_pixels * self.projection_matrix(width / height) * self.view_from(origin)
    }
}

/// Axes (right, up and backward) of a camera that looks along `forward`; `None` if these vectors give no direction.
fn axes_towards(forward: DVec3, up: DVec3) -> Option<DMat3> {
    let back = -forward.try_normalize()?;
    let right = up.try_normalize()?.cross(back);
    let right = if right.length() > 1e-9 {
        right.normalize()
    } else {
        return None;
    };
    let axes = DMat3::from_cols(right, back.cross(right), back);
    axes.is_finite().then_some(axes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn project(camera: &Camera, p: DVec3) -> DVec3 {
        let c =
            camera.pixel_matrix(DVec3::new(1.0, 2.0, 3.0), 200.0, 100.0) * (p - DVec3::new(1.0, 2.0, 3.0)).extend(1.0);
        c.truncate() / c.w
    }

    #[test]
    fn a_point_above_and_right_of_the_axis_projects_up_and_right() {
        let camera = Camera::look_at(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, DVec3::Y, 90.0, 0.5).unwrap();
        let p = project(&camera, DVec3::new(1.0, 2.0, 0.0));
        assert!((p - DVec3::new(10.0, -20.0, 0.1)).length() < 1e-12, "{p}");
    }

    #[test]
    fn depth_is_one_at_the_near_plane_and_zero_at_the_far_one() {
        let mut camera = Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 60.0, 0.5).unwrap();
        assert!((project(&camera, DVec3::new(0.0, 0.0, -0.5)).z - 1.0).abs() < 1e-12);
        camera.projection = Projection::Perspective { fov: 1.0, near: 0.5, far: Some(10.0) };
        assert!((project(&camera, DVec3::new(0.0, 0.0, -0.5)).z - 1.0).abs() < 1e-12);
        assert!(project(&camera, DVec3::new(0.0, 0.0, -10.0)).z.abs() < 1e-12);
        camera.projection = Projection::Orthographic { half_height: 2.0, near: 0.5, far: 10.0 };
        assert!((project(&camera, DVec3::new(0.0, 0.0, -0.5)).z - 1.0).abs() < 1e-12);
        assert!(project(&camera, DVec3::new(0.0, 1.0, -10.0)).z.abs() < 1e-12);
        assert!((project(&camera, DVec3::new(0.0, 1.0, -10.0)).y + 25.0).abs() < 1e-12);
    }

    #[test]
    fn a_shift_moves_every_distance_alike() {
        let eye = DVec3::new(0.0, 0.0, 5.0);
        let centred = Camera::look_at(eye, DVec3::ZERO, DVec3::Y, 50.0, 0.5).unwrap();
        let orthographic =
            Camera { projection: Projection::Orthographic { half_height: 2.0, near: 0.5, far: 10.0 }, ..centred };
        for camera in [centred, orthographic] {
            // The shift is a quarter of a pixel to the right and half a pixel down, in an image of 200 x 100 pixels.
            let shifted = Camera { shift: DVec2::new(0.25 / 200.0, 0.5 / 100.0), ..camera };
            for point in [DVec3::ONE, DVec3::new(-3.0, 0.2, -40.0)] {
                let moved = project(&shifted, point) - project(&camera, point);
                assert!((moved - DVec3::new(-0.25, -0.5, 0.0)).length() < 1e-12, "{moved}");
            }
        }
    }

    #[test]
    fn no_direction_is_an_error() {
        assert!(Camera::look_at(DVec3::ONE, DVec3::ONE, DVec3::Y, 60.0, 0.1).is_err());
        assert!(Camera::look_at(DVec3::ZERO, DVec3::Y, DVec3::Y, 60.0, 0.1).is_err());
        assert!(Camera::look_at(DVec3::ZERO, DVec3::X, DVec3::Y, 180.0, 0.1).is_err());
        assert!(Camera::look_at(DVec3::NAN, DVec3::X, DVec3::Y, 60.0, 0.1).is_err());
    }
}

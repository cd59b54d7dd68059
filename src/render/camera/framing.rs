//! Cameras from viewpoints that a user chooses: around a whole scene, or anywhere in it.

use super::{Camera, CameraError};
use glam::DVec3;

/// View of a whole scene from an angle around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Angle around the vertical axis in degrees; 0 looks along -z, 90 along -x.
    pub azimuth: f64,
    /// Angle above the horizon in degrees.
    pub elevation: f64,
    /// Enlargement, above 0: 1 fits the bounding sphere into the image, 2 shows everything twice as large.
    pub zoom: f64,
    /// Vertical field of view in degrees, above 0 and below 180.
    pub fov: f64,
}

impl Default for Orbit {
    fn default() -> Self {
        Self { azimuth: 35.0, elevation: 20.0, zoom: 1.0, fov: 40.0 }
    }
}

impl Orbit {
    /// Camera that sees the box from `low` to `high`, in an image of `aspect` = width / height.
    ///
    /// # Errors
    /// [`CameraError`] if an angle is not finite or the field of view not between 0 and 180 degrees.
    pub fn frame(&self, low: DVec3, high: DVec3, aspect: f64) -> Result<Camera, CameraError> {
        let center = 0.5 * (low + high);
        let radius = (0.5 * (high - low).length()).max(1e-9 * center.length()).max(1e-12);
        let half = 0.5 * self.fov.to_radians();
        let narrower = if aspect < 1.0 { (half.tan() * aspect).atan() } else { half };
        let distance = radius / narrower.sin() / self.zoom;
        let (azimuth, elevation) = (self.azimuth.to_radians(), self.elevation.clamp(-89.99, 89.99).to_radians());
        let from = DVec3::new(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos());
        let eye = center + distance * from;
        // The near plane is close enough for a camera inside of the scene; reversed depth stays precise all the same.
        let near = 1e-4 * radius.max(distance);
        Camera::look_at(eye, center, DVec3::Y, self.fov, near)
    }
}

/// Position of a camera, and the point that it looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// Position of the camera.
    pub eye: DVec3,
    /// Point that the camera looks at.
    pub target: DVec3,
    /// Direction that is up in the image.
    pub up: DVec3,
    /// Vertical field of view in degrees, above 0 and below 180.
    pub fov: f64,
}

impl Viewpoint {
    /// Camera at this viewpoint, for a scene in the box from `low` to `high`. Its near plane is close enough to show
    /// objects between eye and target, however large the scene is.
    ///
    /// # Errors
    /// [`CameraError`] if eye and target coincide, `up` lies along the view, or the field of view is not between 0 and
    /// 180 degrees.
    pub fn frame(&self, low: DVec3, high: DVec3) -> Result<Camera, CameraError> {
        let near = 1e-3 * (self.target - self.eye).length().min(0.1 * (high - low).length());
        Camera::look_at(self.eye, self.target, self.up, self.fov, near.max(1e-12))
    }
}

//! Cameras that stand where someone wants to look from: around a whole scene, or anywhere in it.

use super::{Camera, CameraError};
use glam::DVec3;

/// Viewing direction around a scene, from which the whole scene is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Degrees around the vertical axis; 0 looks along -z, 90 along -x.
    pub azimuth: f64,
    /// Degrees above the horizon.
    pub elevation: f64,
    /// 1 fits the bounding sphere into the image, 2 shows everything twice as large.
    pub zoom: f64,
    /// Vertical field of view in degrees.
    pub fov: f64,
}

impl Default for Orbit {
    fn default() -> Self {
        Self {
            azimuth: 35.0,
            elevation: 20.0,
            zoom: 1.0,
            fov: 40.0,
        }
    }
}

impl Orbit {
    /// A camera around the box from `low` to `high`, for an image of `aspect` = width / height.
    ///
    /// # Errors
    /// If an angle is not finite or the field of view not within 0 to 180 degrees.
    pub fn frame(&self, low: DVec3, high: DVec3, aspect: f64) -> Result<Camera, CameraError> {
        let center = 0.5 * (low + high);
        let radius = (0.5 * (high - low).length())
            .max(1e-9 * center.length())
            .max(1e-12);
        let half = 0.5 * self.fov.to_radians();
        let narrower = if aspect < 1.0 {
            (half.tan() * aspect).atan()
        } else {
            half
        };
        let distance = radius / narrower.sin() / self.zoom;
        let (azimuth, elevation) = (
            self.azimuth.to_radians(),
            self.elevation.clamp(-89.99, 89.99).to_radians(),
        );
        let from = DVec3::new(
            azimuth.sin() * elevation.cos(),
            elevation.sin(),
            azimuth.cos() * elevation.cos(),
        );
        let eye = center + distance * from;
        // Close enough for a camera inside of the scene; reversed depth keeps its precision all the same.
        let near = 1e-4 * radius.max(distance);
        Camera::look_at(eye, center, DVec3::Y, self.fov, near)
    }
}

/// A place to stand at and one to look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// Place of the camera.
    pub eye: DVec3,
    /// Point that the camera looks at.
    pub target: DVec3,
    /// Upward direction.
    pub up: DVec3,
    /// Vertical field of view in degrees.
    pub fov: f64,
}

impl Viewpoint {
    /// A camera for a scene in the box from `low` to `high`: its near plane leaves room for what stands between eye and
    /// target, however large the scene.
    ///
    /// # Errors
    /// If these give no direction or the field of view is not within 0 to 180 degrees.
    pub fn frame(&self, low: DVec3, high: DVec3) -> Result<Camera, CameraError> {
        let near = 1e-3
            * (self.target - self.eye)
                .length()
                .min(0.1 * (high - low).length());
        Camera::look_at(self.eye, self.target, self.up, self.fov, near.max(1e-12))
    }
}

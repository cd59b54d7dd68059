//! Navigation about a scene: a turntable around a target, with the vertical axis upright.

use glam::{DVec2, DVec3};
use gpc::camera::{Camera, Orbit, Projection, Viewpoint};

/// Degrees of a turn by a drag over the height of the image.
const DEGREES_A_HEIGHT: f64 = 180.0;
/// Largest elevation in degrees: seen straight from above or below, a turntable has no sideways direction.
const STEEPEST: f64 = 89.99;

/// Standpoint of a camera at a distance from its target, with the angles of [`Orbit`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turntable {
    /// Point that stays in the middle of the image while the camera turns.
    pub target: DVec3,
    /// Angle around the vertical axis in degrees; 0 looks along -z, 90 along -x.
    pub azimuth: f64,
    /// Angle above the horizon in degrees.
    pub elevation: f64,
    /// Distance from eye to target.
    pub distance: f64,
    /// Vertical field of view in degrees.
    pub fov: f64,
}

/// The box around a scene: lower and upper corner.
pub type Bounds = (DVec3, DVec3);

/// Directions of view that have a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Front,
    Right,
    Top,
    Corner,
}

impl Side {
    /// Azimuth and elevation of the direction in degrees.
    fn angles(self) -> (f64, f64) {
        match self {
            Self::Front => (0.0, 0.0),
            Self::Right => (90.0, 0.0),
            Self::Top => (0.0, STEEPEST),
            Self::Corner => (45.0, 30.0),
        }
    }
}

impl Turntable {
    /// Turntable that sees all of a scene from the default direction, in an image of `aspect` = width / height.
    pub fn fitting(bounds: Bounds, aspect: f64) -> Self {
        let default = Orbit::default();
        let mut turntable = Self {
            target: DVec3::ZERO,
            azimuth: default.azimuth,
            elevation: default.elevation,
            distance: 1.0,
            fov: default.fov,
        };
        turntable.fit(bounds, aspect);
        turntable
    }

    /// Turntable at a camera's position, upright. Its target is the point on the camera's axis that is nearest to the
    /// scene's centre. An orthographic camera is replaced by one at the distance from which the target has the same
    /// size.
    pub fn of_camera(camera: &Camera, (low, high): Bounds) -> Self {
        let direction = camera.direction();
        let ahead = (0.5 * (low + high) - camera.eye).dot(direction);
        let ahead = if ahead > 0.0 { ahead } else { 1.0 };
        let target = camera.eye + ahead * direction;
        let (fov, distance) = match camera.projection {
            Projection::Perspective { fov, .. } => (fov.to_degrees(), ahead),
            Projection::Orthographic { half_height, .. } => {
                let fov = Orbit::default().fov;
                (fov, half_height / (0.5 * fov.to_radians()).tan())
            }
        };
        Self {
            target,
            azimuth: (-direction.x).atan2(-direction.z).to_degrees().rem_euclid(360.0),
            elevation: (-direction.y).clamp(-1.0, 1.0).asin().to_degrees(),
            distance,
            fov,
        }
        .clamped()
    }

    /// Turntable at a camera's position, upright, with another target on the camera's axis.
    pub fn aimed(camera: &Camera, target: DVec3, bounds: Bounds) -> Self {
        Self { target, distance: (camera.eye - target).length(), ..Self::of_camera(camera, bounds) }
    }

    /// The eye, target and field of view for a camera.
    pub fn viewpoint(&self) -> Viewpoint {
        Viewpoint {
            eye: self.target + self.distance * self.backward(),
            target: self.target,
            up: DVec3::Y,
            fov: self.fov,
        }
    }

    /// Changes the distance until all of a scene is in view, in the same direction.
    pub fn fit(&mut self, bounds: Bounds, aspect: f64) {
        let orbit = Orbit { fov: self.fov, ..Orbit::default() };
        self.target = 0.5 * (bounds.0 + bounds.1);
        // Angles and field of view of a turntable are always in range.
        if let Ok(camera) = orbit.frame(bounds.0, bounds.1, aspect) {
            self.distance = (camera.eye - self.target).length();
        }
    }

    /// Turns to a side, around the same target.
    pub fn look_from(&mut self, side: Side) {
        (self.azimuth, self.elevation) = side.angles();
    }

    /// Turns by a drag in pixels of an image of height `height`, so that the near side follows the pointer.
    pub fn orbit(&mut self, drag: DVec2, height: f64) {
        self.azimuth = (self.azimuth - drag.x / height * DEGREES_A_HEIGHT).rem_euclid(360.0);
        self.elevation += drag.y / height * DEGREES_A_HEIGHT;
        *self = self.clamped();
    }

    /// Moves eye and target by a drag in pixels, so that points at the target's distance follow the pointer.
    pub fn pan(&mut self, drag: DVec2, height: f64) {
        let (right, up) = self.across();
        let pixel = 2.0 * self.half_height() / height;
        self.target += pixel * (drag.y * up - drag.x * right);
    }

    /// Divides the distance by a factor. The point at the target's distance under the pointer stays there; `pointer`
    /// is in pixels from the middle of an image of height `height`, y down.
    pub fn zoom(&mut self, factor: f64, pointer: DVec2, height: f64) {
        let (right, up) = self.across();
        let pixel = 2.0 * self.half_height() / height;
        let fixed = self.target + pixel * (pointer.x * right - pointer.y * up);
        self.target = fixed + (self.target - fixed) / factor;
        self.distance /= factor;
    }

    /// Moves eye and target so that a point comes into the middle, in the same direction of view.
    pub fn recentre(&mut self, point: DVec3) {
        let shift = point - self.target;
        // The eye moves sideways only, so that its distance changes by the difference of depth.
        let deeper = -shift.dot(self.backward());
        self.target = point;
        self.distance = (self.distance + deeper).max(1e-6 * self.distance);
    }

    /// Moves eye and target. The components of `by` are right, up and forward, in units of the scene.
    pub fn fly(&mut self, by: DVec3) {
        let (right, up) = self.across();
        self.target += by.x * right + by.y * up - by.z * self.backward();
    }

    /// Turns the camera about its eye by a drag in pixels of an image of height `height`, so that the image follows
    /// the pointer.
    pub fn look(&mut self, drag: DVec2, height: f64) {
        let eye = self.target + self.distance * self.backward();
        let turn = self.fov / height * drag;
        self.azimuth = (self.azimuth + turn.x).rem_euclid(360.0);
        self.elevation -= turn.y;
        *self = self.clamped();
        self.target = eye - self.distance * self.backward();
    }

    /// Half of the image's height at the target's distance, in units of the scene.
    fn half_height(&self) -> f64 {
        self.distance * (0.5 * self.fov.to_radians()).tan()
    }

    /// Unit vector from target to eye.
    fn backward(&self) -> DVec3 {
        let (azimuth, elevation) = (self.azimuth.to_radians(), self.elevation.to_radians());
        DVec3::new(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos())
    }

    /// Unit vectors to the right and up in the image.
    fn across(&self) -> (DVec3, DVec3) {
        let back = self.backward();
        let right = DVec3::Y.cross(back).normalize();
        (right, back.cross(right))
    }

    fn clamped(self) -> Self {
        Self { elevation: self.elevation.clamp(-STEEPEST, STEEPEST), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Bounds = (DVec3::new(-1.0, 0.0, -2.0), DVec3::new(3.0, 2.0, 2.0));
    const SIZE: [f64; 2] = [400.0, 200.0];

    fn camera(turntable: &Turntable) -> Camera {
        turntable.viewpoint().frame(BOUNDS.0, BOUNDS.1).unwrap()
    }

    /// Place of a point in the image: pixels from its middle, y down.
    fn seen(turntable: &Turntable, point: DVec3) -> DVec2 {
        let matrix = camera(turntable).pixel_matrix(DVec3::ZERO, SIZE[0], SIZE[1]);
        let clip = matrix * point.extend(1.0);
        DVec2::new(clip.x, clip.y) / clip.w
    }

    fn turntable() -> Turntable {
        Turntable::fitting(BOUNDS, 2.0)
    }

    #[test]
    fn the_first_view_is_that_of_an_orbit() {
        let expected = Orbit::default().frame(BOUNDS.0, BOUNDS.1, 2.0).unwrap();
        let found = camera(&turntable());
        assert!((found.eye - expected.eye).length() < 1e-9);
        assert!((found.direction() - expected.direction()).length() < 1e-9);
    }

    #[test]
    fn zooming_keeps_what_is_under_the_pointer() {
        let before = turntable();
        let pointer = DVec2::new(120.0, -50.0);
        let (right, up) = before.across();
        let pixel = 2.0 * before.half_height() / SIZE[1];
        let point = before.target + pixel * (pointer.x * right - pointer.y * up);
        assert!((seen(&before, point) - pointer).length() < 1e-9);
        let mut after = before;
        after.zoom(1.7, pointer, SIZE[1]);
        assert!((seen(&after, point) - pointer).length() < 1e-9);
        assert!((after.distance * 1.7 - before.distance).abs() < 1e-9);
        after.zoom(1.0 / 1.7, pointer, SIZE[1]);
        assert!((after.target - before.target).length() < 1e-9);
    }

    #[test]
    fn panning_moves_the_target_with_the_pointer() {
        let before = turntable();
        let mut after = before;
        let drag = DVec2::new(30.0, 12.0);
        after.pan(drag, SIZE[1]);
        assert!((seen(&after, before.target) - drag).length() < 1e-9);
    }

    #[test]
    fn orbiting_keeps_the_target_and_stops_at_the_poles() {
        let mut turntable = turntable();
        turntable.orbit(DVec2::new(50.0, 1e4), SIZE[1]);
        assert_eq!(turntable.elevation, STEEPEST);
        assert!((turntable.azimuth - (35.0 - 45.0 + 360.0)).abs() < 1e-9);
        assert!(seen(&turntable, turntable.target).length() < 1e-9);
        // The near side follows the pointer.
        let mut turned = super::tests::turntable();
        let near = turned.target + 0.5 * turned.backward();
        turned.orbit(DVec2::new(10.0, 5.0), SIZE[1]);
        let moved = seen(&turned, near);
        assert!(moved.x > 0.0 && moved.y > 0.0, "{moved}");
    }

    #[test]
    fn flying_moves_the_eye_and_looking_turns_it() {
        let before = turntable();
        let mut after = before;
        after.fly(DVec3::new(0.1, 0.2, 0.3));
        let moved = after.viewpoint().eye - before.viewpoint().eye;
        let (right, up) = before.across();
        let expected = 0.1 * right + 0.2 * up - 0.3 * before.backward();
        assert!((moved - expected).length() < 1e-9);
        // A small drag moves the middle of the image along.
        let mut after = before;
        after.look(DVec2::new(4.0, -3.0), SIZE[1]);
        assert!((after.viewpoint().eye - before.viewpoint().eye).length() < 1e-9);
        let shift = seen(&after, before.target) - DVec2::new(4.0, -3.0);
        assert!(shift.length() < 0.5, "{shift}");
    }

    #[test]
    fn a_camera_of_the_scene_is_taken_over() {
        let mut before = turntable();
        before.orbit(DVec2::new(77.0, -60.0), SIZE[1]);
        let taken = Turntable::of_camera(&camera(&before), BOUNDS);
        let expected = before.viewpoint();
        let found = taken.viewpoint();
        assert!((found.eye - expected.eye).length() < 1e-9);
        assert!((taken.azimuth - before.azimuth).abs() < 1e-9);
        assert!((taken.elevation - before.elevation).abs() < 1e-9);
    }

    #[test]
    fn sides_look_along_the_axes() {
        let mut turntable = turntable();
        for (side, expected) in [(Side::Front, DVec3::NEG_Z), (Side::Right, DVec3::NEG_X), (Side::Top, DVec3::NEG_Y)] {
            turntable.look_from(side);
            assert!((camera(&turntable).direction() - expected).length() < 1e-3);
        }
    }

    #[test]
    fn recentring_turns_to_a_point() {
        let mut turntable = turntable();
        let point = DVec3::new(2.0, 1.5, 1.0);
        let before = turntable.viewpoint().eye;
        turntable.recentre(point);
        assert!(seen(&turntable, point).length() < 1e-9);
        let moved = turntable.viewpoint().eye - before;
        assert!(moved.dot(turntable.backward()).abs() < 1e-9, "it comes no nearer");
    }
}

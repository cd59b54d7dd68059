//! Navigation by mouse: dragging and the wheel.

use super::cover::Change;
use super::fly::Flight;
use super::lens::Lenses;
use super::navigate::Turntable;
use super::photo::Framing;
use super::pick;
use super::pointer::Drag;
use super::window::Viewer;
use glam::DVec2;
use gpc::camera::{Camera, Pinhole};
use std::time::Instant;
use winit::event::MouseButton;

/// Zoom factor of one notch of the wheel.
pub const NOTCH: f64 = 1.15;
/// Pixels of a touchpad or of a drag that count as one notch, at a scale factor of 1.
const PIXELS_A_NOTCH: f64 = 40.0;
/// Largest distance of the pointer from the line of a split that takes hold of it, in pixels at a scale factor of 1.
const GRIP: f64 = 6.0;

/// Zoom factor of a pinch; `delta` is the change of the fingers' distance as a share of that distance.
pub fn pinched(delta: f64) -> f64 {
    // Some systems end a gesture with NaN.
    if delta.is_finite() { (1.0 + delta).clamp(0.5, 2.0) } else { 1.0 }
}

impl Viewer {
    /// Changes the standpoint.
    pub fn go(&mut self, change: impl FnOnce(&mut Turntable)) {
        if let Some(bounds) = self.canvas.stage().map(|stage| stage.bounds) {
            let mut standpoint = self.standpoint;
            standpoint.go(self.cameras(), bounds, self.aspect(), change);
            self.standpoint = standpoint;
            self.restart();
        }
    }

    /// Renders all pictures anew.
    pub fn restart(&mut self) {
        self.canvas.restart(Instant::now());
        self.view_changed(Change::View);
    }

    /// Changes the active lens. Returns whether there is one.
    pub fn change_lens(&mut self, change: impl FnOnce(&mut Lenses)) -> bool {
        if self.cover.lenses.regions().is_empty() {
            return false;
        }
        change(&mut self.cover.lenses);
        self.cover_changed();
        true
    }

    /// Changes the visible part of the photograph. Returns whether there is a photograph.
    pub fn reframe(&mut self, change: impl FnOnce(&mut Framing)) -> bool {
        let Some(easel) = &mut self.easel else {
            return false;
        };
        change(&mut easel.framing);
        self.view_changed(Change::Scene);
        true
    }

    /// Place in the picture, or in the photograph if one is shown, under a place of the window; all in pixels.
    pub fn plane_place(&self, pointer: DVec2) -> DVec2 {
        match &self.easel {
            Some(easel) => easel.framing.place(pointer),
            None => pointer,
        }
    }

    pub fn press(&mut self, button: MouseButton) {
        let grip = GRIP * self.window.scale_factor();
        let near_split =
            self.split_column().is_some_and(|column| (self.pointer.place().x - f64::from(column)).abs() < grip);
        let drag = match button {
            MouseButton::Left if near_split => Drag::Split,
            MouseButton::Left if self.modifiers.shift_key() => Drag::Pan,
            MouseButton::Left if !self.cover.lenses.regions().is_empty() => Drag::Lens,
            MouseButton::Left if self.easel.is_some() => Drag::Pan,
            MouseButton::Left if self.flight.is_some() => Drag::Look,
            MouseButton::Left => Drag::Orbit,
            MouseButton::Middle => Drag::Pan,
            MouseButton::Right => Drag::Zoom,
            _ => return,
        };
        if drag == Drag::Lens {
            let place = self.plane_place(self.pointer.place());
            self.change_lens(|lenses| lenses.press(place));
        }
        let is_double = self.pointer.pressed(drag, Instant::now());
        if is_double && drag == Drag::Orbit {
            self.recentre();
        }
    }

    pub fn drag(&mut self, drag: Drag, by: DVec2) {
        let [width, height] = self.size();
        match drag {
            Drag::Orbit => self.go(|turntable| turntable.orbit(by, height)),
            Drag::Look => self.go(|turntable| turntable.look(by, height)),
            Drag::Pan => {
                if !self.reframe(|framing| framing.pan(by)) {
                    self.go(|turntable| turntable.pan(by, height));
                }
            }
            Drag::Zoom => {
                let factor = NOTCH.powf(-self.notches(by.y));
                self.zoom(factor, 0.5 * DVec2::new(width, height));
            }
            Drag::Lens => {
                let place = self.plane_place(self.pointer.place());
                self.change_lens(|lenses| lenses.drag(place));
            }
            Drag::Split => {
                self.split = (self.pointer.place().x / width).clamp(0.0, 1.0);
                self.is_dirty = true;
            }
        }
    }

    /// Notches of a wheel that equal a number of pixels of a touchpad or drag.
    pub fn notches(&self, pixels: f64) -> f64 {
        pixels / (PIXELS_A_NOTCH * self.window.scale_factor())
    }

    /// Pixels of a touchpad that equal a number of notches of a wheel.
    pub fn pixels_of_notches(&self, notches: DVec2) -> DVec2 {
        notches * (PIXELS_A_NOTCH * self.window.scale_factor())
    }

    /// Enlarges by a factor: the active lens, the speed of flying, or otherwise the view at the pointer.
    pub fn wheel(&mut self, factor: f64) {
        if self.change_lens(|lenses| lenses.enlarge(factor)) {
            return;
        }
        match &mut self.flight {
            Some(flight) => {
                flight.change_speed(factor);
                let speed = flight.speed();
                self.notes.say(format!("{speed:.3} units a second"));
            }
            None => self.zoom(factor, self.pointer.place()),
        }
        self.is_dirty = true;
    }

    /// Starts or ends flying.
    pub fn toggle_flight(&mut self) {
        self.flight = match (&self.flight, self.canvas.stage()) {
            (None, Some(stage)) => {
                let diagonal = (stage.bounds.1 - stage.bounds.0).length();
                Some(Flight::new(diagonal))
            }
            _ => None,
        };
        self.notes.say(match self.flight {
            Some(_) => "flying: F ends it",
            None => "turning around the target",
        });
    }

    /// Moves the eye along the flight up to `now`.
    pub fn fly(&mut self, now: Instant) {
        if let Some(flight) = self.flight.as_mut().filter(|flight| flight.is_moving()) {
            let by = flight.advance(now);
            self.go(|turntable| turntable.fly(by));
        }
    }

    /// Zooms by a factor about `place` in the window: the point shown at `place` stays there.
    fn zoom(&mut self, factor: f64, place: DVec2) {
        if self.reframe(|framing| framing.zoom(factor, place)) {
            return;
        }
        let [width, height] = self.size();
        let pointer = place - 0.5 * DVec2::new(width, height);
        self.go(|turntable| turntable.zoom(factor, pointer, height));
    }

    /// Turns so that the point under the pointer comes into the middle.
    fn recentre(&mut self) {
        let Some(stage) = self.canvas.stage() else {
            return;
        };
        let size = self.pixels();
        let camera = self.standpoint.camera(self.cameras(), stage.bounds, self.aspect());
        let pinhole = camera.ok().and_then(|camera: Camera| Pinhole::from_camera(&camera, size).ok());
        let hit = pinhole
            .map(|pinhole| pinhole.ray(self.pointer.place()))
            .and_then(|ray| pick::first_hit(&stage.pose.geometry, &ray));
        if let Some(point) = hit {
            self.go(|turntable| turntable.recentre(point));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pinch_is_a_factor() {
        assert_eq!(pinched(0.1), 1.1);
        assert_eq!(pinched(-0.25), 0.75);
        assert_eq!(pinched(f64::NAN), 1.0);
        assert_eq!((pinched(-3.0), pinched(9.0)), (0.5, 2.0));
    }
}

//! State of the mouse: the pointer's place, and the effect of a drag.

use glam::DVec2;
use std::time::{Duration, Instant};

/// Longest time between the presses of a double click.
const DOUBLE: Duration = Duration::from_millis(400);
const NEAR: f64 = 5.0;

/// Effect of a drag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drag {
    Orbit,
    Look,
    Pan,
    Zoom,
    Split,
    Lens,
}

/// State of the mouse.
#[derive(Debug, Default)]
pub struct Pointer {
    place: DVec2,
    drag: Option<Drag>,
    last_press: Option<(Instant, DVec2)>,
}

impl Pointer {
    /// Place of the pointer, in pixels from the window's upper left corner.
    pub fn place(&self) -> DVec2 {
        self.place
    }

    /// Moves the pointer. Returns the drag and its length in pixels, if a button is held.
    pub fn moved(&mut self, to: DVec2) -> Option<(Drag, DVec2)> {
        let by = to - self.place;
        self.place = to;
        self.drag.map(|drag| (drag, by))
    }

    /// Starts a drag. Returns whether this is the second press of a double click.
    pub fn pressed(&mut self, drag: Drag, now: Instant) -> bool {
        let is_double = self
            .last_press
            .take()
            .is_some_and(|(then, place)| now - then < DOUBLE && (place - self.place).length() < NEAR);
        if !is_double {
            self.last_press = Some((now, self.place));
        }
        self.drag = Some(drag);
        is_double
    }

    /// Ends the drag.
    pub fn released(&mut self) {
        self.drag = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drags_say_how_far() {
        let mut pointer = Pointer::default();
        assert_eq!(pointer.moved(DVec2::new(3.0, 4.0)), None);
        pointer.pressed(Drag::Pan, Instant::now());
        let moved = pointer.moved(DVec2::new(5.0, 3.0));
        assert_eq!(moved, Some((Drag::Pan, DVec2::new(2.0, -1.0))));
        pointer.released();
        assert_eq!(pointer.moved(DVec2::ZERO), None);
    }

    #[test]
    fn two_presses_in_a_place_are_a_double_click() {
        let start = Instant::now();
        let after = |ms| start + Duration::from_millis(ms);
        let mut pointer = Pointer::default();
        assert!(!pointer.pressed(Drag::Orbit, start));
        assert!(pointer.pressed(Drag::Orbit, after(200)));
        // A third press starts a new double click.
        assert!(!pointer.pressed(Drag::Orbit, after(300)));
        assert!(!pointer.pressed(Drag::Orbit, after(800)));
        pointer.moved(DVec2::new(50.0, 0.0));
        assert!(!pointer.pressed(Drag::Orbit, after(900)));
    }
}

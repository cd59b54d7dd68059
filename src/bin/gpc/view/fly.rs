//! Flying through a scene: held keys move the eye.

use glam::DVec3;
use std::time::{Duration, Instant};
use winit::keyboard::{KeyCode, PhysicalKey};

/// Seconds that the eye takes to fly along the scene's diagonal, unless the wheel sets another speed.
const SECONDS_A_DIAGONAL: f64 = 10.0;
/// Longest time step of the eye, however long a picture takes.
const LONGEST: Duration = Duration::from_millis(500);

/// Direction in which a key moves the eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    Forward,
    Back,
    Left,
    Right,
    Up,
    Down,
}

impl Way {
    /// Direction of a key, by the key's position on the keyboard.
    pub fn of(key: PhysicalKey) -> Option<Self> {
        let PhysicalKey::Code(code) = key else {
            return None;
        };
        Some(match code {
            KeyCode::KeyW | KeyCode::ArrowUp => Self::Forward,
            KeyCode::KeyS | KeyCode::ArrowDown => Self::Back,
            KeyCode::KeyA | KeyCode::ArrowLeft => Self::Left,
            KeyCode::KeyD | KeyCode::ArrowRight => Self::Right,
            KeyCode::KeyE | KeyCode::PageUp => Self::Up,
            KeyCode::KeyQ | KeyCode::PageDown => Self::Down,
            _ => return None,
        })
    }

    /// Unit vector with the components right, up and forward.
    fn direction(self) -> DVec3 {
        match self {
            Self::Forward => DVec3::Z,
            Self::Back => DVec3::NEG_Z,
            Self::Left => DVec3::NEG_X,
            Self::Right => DVec3::X,
            Self::Up => DVec3::Y,
            Self::Down => DVec3::NEG_Y,
        }
    }
}

/// Movement of the eye by keys.
#[derive(Clone, Debug)]
pub struct Flight {
    held: Vec<Way>,
    /// Speed in units of the scene a second.
    speed: f64,
    /// Time at which the eye was last moved; `None` while no key is held.
    last: Option<Instant>,
}

impl Flight {
    /// Flight through a scene whose diagonal has this length.
    pub fn new(diagonal: f64) -> Self {
        Self { held: Vec::new(), speed: diagonal / SECONDS_A_DIAGONAL, last: None }
    }

    /// Speed in units of the scene a second.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    pub fn change_speed(&mut self, factor: f64) {
        self.speed *= factor;
    }

    /// Records that a key was pressed.
    pub fn hold(&mut self, way: Way, now: Instant) {
        if !self.held.contains(&way) {
            self.held.push(way);
        }
        self.last.get_or_insert(now);
    }

    /// Records that a key was released.
    pub fn release(&mut self, way: Way) {
        self.held.retain(|held| *held != way);
        if self.held.is_empty() {
            self.last = None;
        }
    }

    /// Stops the flight, as if all keys were released.
    pub fn stop(&mut self) {
        self.held.clear();
        self.last = None;
    }

    /// Whether any key is held.
    pub fn is_moving(&self) -> bool {
        self.last.is_some()
    }

    /// Movement of the eye since the last call: right, up and forward, in units of the scene.
    pub fn advance(&mut self, now: Instant) -> DVec3 {
        let Some(last) = &mut self.last else {
            return DVec3::ZERO;
        };
        let passed = now.saturating_duration_since(*last).min(LONGEST);
        *last = now;
        let directions = self.held.iter().map(|way| way.direction());
        let direction: DVec3 = directions.sum();
        self.speed * passed.as_secs_f64() * direction.normalize_or_zero()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn held_keys_move_as_fast_in_every_direction() {
        let start = Instant::now();
        let after = |ms| start + Duration::from_millis(ms);
        let mut flight = Flight::new(20.0);
        assert_eq!(flight.advance(after(100)), DVec3::ZERO);
        flight.hold(Way::Forward, after(100));
        assert!((flight.advance(after(200)) - 0.2 * DVec3::Z).length() < 1e-9);
        flight.hold(Way::Left, after(200));
        let moved = flight.advance(after(300));
        assert!((moved.length() - 0.2).abs() < 1e-9 && moved.x < 0.0 && moved.z > 0.0);
        // Key repeats change nothing, and opposite keys cancel each other.
        flight.hold(Way::Left, after(300));
        flight.release(Way::Forward);
        flight.hold(Way::Right, after(300));
        assert!(flight.is_moving() && flight.advance(after(400)) == DVec3::ZERO);
        flight.stop();
        assert!(!flight.is_moving());
    }

    #[test]
    fn a_picture_that_took_long_moves_the_eye_a_little() {
        let start = Instant::now();
        let mut flight = Flight::new(10.0);
        flight.change_speed(2.0);
        flight.hold(Way::Up, start);
        let moved = flight.advance(start + Duration::from_secs(100));
        assert!((moved - DVec3::Y).length() < 1e-9, "{moved}");
    }

    #[test]
    fn letters_and_arrows_mean_the_same() {
        let way = |code| Way::of(PhysicalKey::Code(code));
        for (letter, arrow) in [
            (KeyCode::KeyW, KeyCode::ArrowUp),
            (KeyCode::KeyA, KeyCode::ArrowLeft),
            (KeyCode::KeyS, KeyCode::ArrowDown),
            (KeyCode::KeyD, KeyCode::ArrowRight),
            (KeyCode::KeyE, KeyCode::PageUp),
            (KeyCode::KeyQ, KeyCode::PageDown),
        ] {
            assert!(way(letter).is_some() && way(letter) == way(arrow));
        }
        assert_eq!(way(KeyCode::KeyF), None);
    }
}

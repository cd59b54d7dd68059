//! Playback of an animation: playing, paused, or moved by hand.

use std::time::Instant;

/// Speeds that the keys select, in seconds of the animation a second.
const SPEEDS: [f64; 7] = [0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0];

/// Playback that runs from 0 to the end of an animation and then starts again.
#[derive(Clone, Debug)]
pub struct Player {
    time: f64,
    duration: f64,
    speed: f64,
    /// Time at which the animation was last advanced; `None` while it is paused.
    last: Option<Instant>,
}

impl Player {
    /// Makes a paused player at `time`; both are in seconds of the animation.
    pub fn new(time: f64, duration: f64) -> Self {
        Self { time, duration, speed: 1.0, last: None }
    }

    /// Time of the animation in seconds.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Duration of the animation in seconds.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Speed in seconds of the animation a second.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Whether the animation plays.
    pub fn is_playing(&self) -> bool {
        self.last.is_some()
    }

    /// Starts or pauses the animation.
    pub fn toggle(&mut self, now: Instant) {
        self.last = match self.last {
            Some(_) => None,
            None => Some(now),
        };
    }

    /// Moves to a time of the animation in seconds.
    pub fn seek(&mut self, time: f64) {
        self.time = time.clamp(0.0, self.duration);
    }

    /// Changes the speed by a number of steps.
    pub fn change_speed(&mut self, steps: i32) {
        let found = SPEEDS.iter().position(|speed| *speed >= self.speed);
        let index = found.unwrap_or(SPEEDS.len() - 1) as i32 + steps;
        self.speed = SPEEDS[index.clamp(0, SPEEDS.len() as i32 - 1) as usize];
    }

    /// Advances the animation up to `now`, if it plays.
    pub fn advance(&mut self, now: Instant) {
        if let Some(last) = self.last.replace(now) {
            let passed = now.saturating_duration_since(last).as_secs_f64();
            let time = self.time + self.speed * passed;
            self.time = if self.duration > 0.0 { time.rem_euclid(self.duration) } else { 0.0 };
        } else {
            self.last = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn plays_round_and_round_at_its_speed() {
        let start = Instant::now();
        let after = |ms| start + Duration::from_millis(ms);
        let mut player = Player::new(1.0, 2.0);
        player.advance(after(500));
        assert!(!player.is_playing() && player.time() == 1.0);
        player.toggle(after(500));
        player.advance(after(750));
        assert!((player.time() - 1.25).abs() < 1e-9);
        player.change_speed(1);
        player.advance(after(1250));
        assert!((player.time() - 0.25).abs() < 1e-9);
        player.toggle(after(1300));
        player.advance(after(9000));
        assert!((player.time() - 0.25).abs() < 1e-9);
    }

    #[test]
    fn speeds_and_times_stay_in_range() {
        let mut player = Player::new(0.0, 2.0);
        player.change_speed(100);
        assert_eq!(player.speed(), 8.0);
        player.change_speed(-100);
        assert_eq!(player.speed(), 0.125);
        player.seek(5.0);
        assert_eq!(player.time(), 2.0);
        let mut still = Player::new(0.0, 0.0);
        still.toggle(Instant::now());
        still.advance(Instant::now() + Duration::from_secs(1));
        assert_eq!(still.time(), 0.0);
    }
}

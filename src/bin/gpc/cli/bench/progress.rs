//! Progress on standard error, if that is a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// A progress bar that names the scene and the step of its measurement.
pub struct Progress {
    bar: ProgressBar,
    scene: String,
}

impl Progress {
    /// Makes a bar of `parts` scenes, curves and checks.
    pub fn new(parts: usize) -> Self {
        let style = ProgressStyle::with_template("{spinner} {pos}/{len}, {elapsed}  {wide_msg}");
        let bar = ProgressBar::new(parts as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(Duration::from_millis(200));
        Self { bar, scene: String::new() }
    }

    /// Begins to measure a scene.
    pub fn begin(&mut self, scene: &str) {
        self.scene = scene.to_owned();
        self.say("loading");
    }

    /// Names the step of the measurement.
    pub fn say(&self, what: &str) {
        self.bar.set_message(format!("{}: {what}", self.scene));
    }

    /// Ends the scene: calls `print` while the bar is hidden.
    pub fn suspend<R>(&self, print: impl FnOnce() -> R) -> R {
        self.bar.inc(1);
        self.bar.suspend(print)
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

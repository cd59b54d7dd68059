//! Progress on standard error, where that is a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// Says which scene is being measured, and what of it.
pub struct Progress {
    bar: ProgressBar,
    scene: String,
}

impl Progress {
    /// Begins a bar of so many scenes, curves and checks.
    pub fn new(parts: usize) -> Self {
        let style = ProgressStyle::with_template("{spinner} {pos}/{len}, {elapsed}  {wide_msg}");
        let bar = ProgressBar::new(parts as u64)
            .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(Duration::from_millis(200));
        Self {
            bar,
            scene: String::new(),
        }
    }

    /// Begins a scene.
    pub fn begin(&mut self, scene: &str) {
        self.scene = scene.to_owned();
        self.say("loading");
    }

    /// Says what is being done to the scene.
    pub fn say(&self, what: &str) {
        self.bar.set_message(format!("{}: {what}", self.scene));
    }

    /// The scene is done: prints with the bar out of the way.
    pub fn suspend<R>(&self, print: impl FnOnce() -> R) -> R {
        self.bar.inc(1);
        self.bar.suspend(print)
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

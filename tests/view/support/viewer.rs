//! The viewer in a window, with real input.

use super::PATIENCE;
use super::display::Display;
use super::program::Program;
use std::ops::{Deref, DerefMut};
use std::path::Path;
use std::process::ExitStatus;
use std::time::{Duration, Instant};

/// The viewer, and its messages.
pub struct Viewer<'a> {
    display: &'a Display,
    program: Program,
}

impl<'a> Viewer<'a> {
    /// Opens scenes in a window, and waits until they are shown.
    pub fn open(display: &'a Display, folder: &Path, arguments: &[&str]) -> Self {
        Self::open_with(display, folder, arguments, &[])
    }

    /// Opens scenes as [`Self::open`] does, with variables of the environment.
    pub fn open_with(display: &'a Display, folder: &Path, arguments: &[&str], variables: &[(&str, &Path)]) -> Self {
        let program = Program::start(
            Program::viewer(folder, arguments)
                .env("DISPLAY", &display.name)
                .env_remove("WAYLAND_DISPLAY")
                .envs(variables.iter().copied()),
        );
        display.input(&["search", "--sync", "--name", "gpc$", "windowfocus"]);
        Self { display, program }
    }

    /// Repeats an action until a line contains a text, because a window may not be ready for it.
    pub fn repeat_until(&mut self, text: &str, mut act: impl FnMut(&Display)) -> String {
        let until = Instant::now() + PATIENCE;
        loop {
            act(self.display);
            let soon = Instant::now() + Duration::from_secs(3);
            if let Some(line) = self.wait_until(text, soon) {
                return line;
            }
            assert!(Instant::now() < until, "no line with {text:?} came after {:#?}", self.said);
        }
    }

    pub fn key(&self, key: &str) {
        self.display.input(&["key", key]);
    }

    /// Drags with a button, starting in the window's middle.
    pub fn drag(&self, button: &str, to: [&str; 2]) {
        self.display.input(&[
            "mousemove",
            "160",
            "100",
            "mousedown",
            button,
            "mousemove",
            "170",
            "104",
            "mousemove",
            to[0],
            to[1],
            "mouseup",
            button,
        ]);
    }

    /// Waits until the window has the focus and reacts to keys: until it answers when asked for a command.
    pub fn focus(&mut self, answer: &str) {
        self.repeat_until(answer, |display| display.input(&["key", "ctrl+c"]));
    }

    /// Hides the panel.
    pub fn show_picture_alone(&mut self) {
        self.focus("copied: ");
        self.key("p");
    }

    /// Arguments of the `gpc render` command that makes the picture.
    pub fn command(&mut self) -> Vec<String> {
        // The window may not have the focus yet.
        let line = self.repeat_until("copied: gpc ", |display| display.input(&["key", "ctrl+c"]));
        let (_, command) = line.split_once("copied: gpc ").unwrap();
        let words = command.split(' ');
        words.map(|word| word.trim_matches('\'').to_owned()).collect()
    }

    /// Closes the window, and waits for that.
    pub fn quit(&mut self) -> ExitStatus {
        self.key("q");
        self.ended()
    }

    /// Closes the window, and asserts that there were no error messages.
    pub fn close(mut self) {
        self.key("q");
        self.ended_well();
    }
}

impl Deref for Viewer<'_> {
    type Target = Program;

    fn deref(&self) -> &Program {
        &self.program
    }
}

impl DerefMut for Viewer<'_> {
    fn deref_mut(&mut self) -> &mut Program {
        &mut self.program
    }
}

//! Notes: messages that the window shows for a while.

use crate::cli::exit;
use std::time::{Duration, Instant};

/// Time for which a note is shown. Errors stay until the user asks for something else.
const SEEN: Duration = Duration::from_secs(6);

/// Notes in the window.
#[derive(Debug, Default)]
pub struct Notes(Vec<Note>);

/// A note in the window.
#[derive(Debug)]
pub struct Note {
    pub text: String,
    pub is_error: bool,
    since: Instant,
}

impl Notes {
    /// Shows a note in the window and logs it. A note that is repeated is shown once.
    pub fn say(&mut self, text: impl Into<String>) {
        let text = text.into();
        log::info!("{text}");
        self.0.retain(|note| note.text != text);
        self.add(text, false);
    }

    /// Shows an error and logs it, once.
    pub fn fail(&mut self, error: &anyhow::Error) {
        let text = exit::message(error);
        if !self.0.iter().any(|note| note.is_error && note.text == text) {
            log::error!("{text}");
            self.add(text, true);
        }
    }

    fn add(&mut self, text: String, is_error: bool) {
        self.0.push(Note { text, is_error, since: Instant::now() });
    }

    /// Removes errors.
    pub fn clear_errors(&mut self) {
        self.0.retain(|note| !note.is_error);
    }

    /// Removes notes that were shown for long enough.
    pub fn expire(&mut self, now: Instant) {
        self.0.retain(|note| note.is_error || now < note.since + SEEN);
    }

    /// Notes to show.
    pub fn all(&self) -> &[Note] {
        &self.0
    }

    /// Time at which the next note disappears.
    pub fn next_change(&self) -> Option<Instant> {
        let passing = self.0.iter().filter(|note| !note.is_error);
        passing.map(|note| note.since + SEEN).min()
    }
}

//! Notes: messages that the window shows for a while.

use std::time::{Duration, Instant};

/// Notes are seen for this long; errors until something else is asked for.
const SEEN: Duration = Duration::from_secs(6);

/// Sentences in the window.
#[derive(Debug)]
pub struct Notes {
    notes: Vec<Note>,
    /// Puts errors into words.
    describe: fn(&anyhow::Error) -> String,
}

/// A sentence in the window.
#[derive(Debug)]
pub struct Note {
    pub text: String,
    pub is_error: bool,
    since: Instant,
}

impl Notes {
    pub fn new(describe: fn(&anyhow::Error) -> String) -> Self {
        Self {
            notes: Vec::new(),
            describe,
        }
    }

    /// Says something, in the window and on standard error. What is said again is seen once.
    pub fn say(&mut self, text: impl Into<String>) {
        let text = text.into();
        log::info!("{text}");
        self.notes.retain(|note| note.text != text);
        self.add(text, false);
    }

    /// Says what went wrong, once.
    pub fn fail(&mut self, error: &anyhow::Error) {
        let text = (self.describe)(error);
        if !self
            .notes
            .iter()
            .any(|note| note.is_error && note.text == text)
        {
            log::error!("{text}");
            self.add(text, true);
        }
    }

    fn add(&mut self, text: String, is_error: bool) {
        self.notes.push(Note {
            text,
            is_error,
            since: Instant::now(),
        });
    }

    /// Forgets errors.
    pub fn clear_errors(&mut self) {
        self.notes.retain(|note| !note.is_error);
    }

    /// Notes that are shown now.
    pub fn seen(&mut self, now: Instant) -> &[Note] {
        self.notes
            .retain(|note| note.is_error || now < note.since + SEEN);
        &self.notes
    }

    /// Time at which the next note disappears.
    pub fn next_change(&self) -> Option<Instant> {
        let passing = self.notes.iter().filter(|note| !note.is_error);
        passing.map(|note| note.since + SEEN).min()
    }
}

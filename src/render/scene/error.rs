//! Errors of scenes, and their places in the file.

use std::{fmt, io, sync::Arc};

/// Error of loading or posing a scene. Every message names the file and, if there is one, the place in it as a JSON
/// pointer (RFC 6901).
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// File that can't be read.
    #[error("{file}: cannot be read: {source}")]
    Read {
        /// Name of the file.
        file: String,
        /// Error of the system.
        source: Arc<io::Error>,
    },
    /// Bytes that are not a complete glTF 2.0 file.
    #[error("{file}: {reason}")]
    NotGltf {
        /// Name of the file.
        file: String,
        /// What the bytes are instead, or which part is missing.
        reason: String,
    },
    /// File of a version of glTF other than 2.0.
    #[error("{file}: /asset: glTF {found} is not supported, only 2.0 is; {way_out}")]
    Version {
        /// Name of the file.
        file: String,
        /// Version of the file.
        found: String,
        /// Advice to the user.
        way_out: &'static str,
    },
    /// File that requires an extension that is not supported.
    #[error("{file}: /extensionsRequired: {name} is not supported; {way_out}")]
    Extension {
        /// Name of the file.
        file: String,
        /// Name of the extension.
        name: String,
        /// Advice to the user.
        way_out: String,
    },
    /// Broken part of the file without which the scene can't be drawn.
    #[error("{file}: {place}: {reason}")]
    Malformed {
        /// Name of the file.
        file: String,
        /// JSON pointer to the broken part.
        place: String,
        /// Expectation, and what was found instead.
        reason: String,
    },
    /// Request for a scene that the file lacks.
    #[error("{file}: there is no scene {asked}, the file has {count} (counted from 0)")]
    NoSuchScene {
        /// Name of the file.
        file: String,
        /// Index asked for.
        asked: usize,
        /// Number of scenes in the file.
        count: usize,
    },
    /// Request for an animation that the file lacks.
    #[error("{file}: there is no animation \"{asked}\"; {known}")]
    NoSuchAnimation {
        /// Name of the file.
        file: String,
        /// Name or index asked for.
        asked: String,
        /// Animations of the file, in words.
        known: String,
    },
    /// Request for a variant of the materials that the file lacks.
    #[error("{file}: there is no variant \"{asked}\"; {known}")]
    NoSuchVariant {
        /// Name of the file.
        file: String,
        /// Name asked for.
        asked: String,
        /// Variants of the file, in words.
        known: String,
    },
    /// Scene that is too large to be posed, most likely because a small file repeats its content.
    #[error(
        "{file}: {count} {what} exceed the limit of {limit}; split the scene or draw fewer instances"
    )]
    TooLarge {
        /// Name of the file.
        file: String,
        /// Counted items, such as triangles.
        what: &'static str,
        /// Number of items, or a lower bound of it.
        count: u64,
        /// Largest number of items that is allowed.
        limit: u64,
    },
}

/// Fault at a place in the file, which becomes an error or a warning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    /// JSON pointer to the place.
    pub place: String,
    /// Expectation, and what was found instead.
    pub reason: String,
}

impl Fault {
    pub fn new(place: impl Into<String>, reason: impl Into<String>) -> Self {
        Self {
            place: place.into(),
            reason: reason.into(),
        }
    }

    /// Adds the consequence to the fault's reason.
    #[must_use]
    pub fn but(self, consequence: &str) -> Self {
        Self::new(self.place, format!("{}; {consequence}", self.reason))
    }

    pub fn into_error(self, file: &str) -> SceneError {
        SceneError::Malformed {
            file: file.to_owned(),
            place: self.place,
            reason: self.reason,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.reason)
    }
}

/// Warnings about a file. Only the first [`Warnings::KEPT`] are kept and the others counted, so that a file with a
/// fault in every element does not flood its user.
#[derive(Debug)]
pub(super) struct Warnings {
    file: String,
    list: Vec<String>,
    dropped: usize,
}

impl Warnings {
    const KEPT: usize = 100;

    pub fn new(file: &str) -> Self {
        Self {
            file: file.to_owned(),
            list: Vec::new(),
            dropped: 0,
        }
    }

    /// Empty list of warnings about the same file.
    pub fn of_the_same_file(&self) -> Self {
        Self::new(&self.file)
    }

    /// Adds the warnings of another list.
    pub fn append(&mut self, others: Self) {
        let room = Self::KEPT.saturating_sub(self.list.len());
        self.dropped += others.dropped + others.list.len().saturating_sub(room);
        self.list.extend(others.list.into_iter().take(room));
    }

    pub fn push(&mut self, fault: &Fault) {
        if self.list.len() < Self::KEPT {
            self.list.push(format!("{}: {fault}", self.file));
        } else {
            self.dropped += 1;
        }
    }

    pub fn extend(&mut self, faults: impl IntoIterator<Item = Fault>) {
        for fault in faults {
            self.push(&fault);
        }
    }

    pub fn into_vec(mut self) -> Vec<String> {
        if self.dropped > 0 {
            self.list
                .push(format!("{}: and {} more warnings", self.file, self.dropped));
        }
        self.list
    }
}

//! What can go wrong with a scene, and where in the file.

use std::{fmt, io, sync::Arc};

/// Why a scene cannot be loaded or posed. Every message names the file and, where there is one,
/// the place in it as a JSON pointer (RFC 6901).
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The scene's file cannot be read at all.
    #[error("{file}: cannot be read: {source}")]
    Read {
        /// The file.
        file: String,
        /// What the system said.
        source: Arc<io::Error>,
    },
    /// The bytes are not a complete glTF 2.0 file.
    #[error("{file}: {reason}")]
    NotGltf {
        /// The file.
        file: String,
        /// What it is instead, or what it lacks.
        reason: String,
    },
    /// The file is written for a version of glTF other than 2.0.
    #[error("{file}: /asset: glTF {found} is not supported, only 2.0 is; {way_out}")]
    Version {
        /// The file.
        file: String,
        /// The version found.
        found: String,
        /// What the user can do.
        way_out: &'static str,
    },
    /// The file requires an extension that this crate does not implement.
    #[error("{file}: /extensionsRequired: {name} is not supported; {way_out}")]
    Extension {
        /// The file.
        file: String,
        /// The extension.
        name: String,
        /// What the user can do.
        way_out: String,
    },
    /// Something that has to be drawn is broken.
    #[error("{file}: {place}: {reason}")]
    Malformed {
        /// The file.
        file: String,
        /// JSON pointer to the fault.
        place: String,
        /// What was expected and what was found.
        reason: String,
    },
    /// The request names a scene that the file lacks.
    #[error("{file}: there is no scene {asked}, the file has {count} (counted from 0)")]
    NoSuchScene {
        /// The file.
        file: String,
        /// Index asked for.
        asked: usize,
        /// Number of scenes in the file.
        count: usize,
    },
    /// The request names an animation that the file lacks.
    #[error("{file}: there is no animation \"{asked}\"; {known}")]
    NoSuchAnimation {
        /// The file.
        file: String,
        /// Name or index asked for.
        asked: String,
        /// The animations that there are, in words.
        known: String,
    },
    /// The request names a variant of the materials that the file lacks.
    #[error("{file}: there is no variant \"{asked}\"; {known}")]
    NoSuchVariant {
        /// The file.
        file: String,
        /// Name asked for.
        asked: String,
        /// The variants that there are, in words.
        known: String,
    },
    /// The scene is larger than can be posed, most likely through repetition of a small file's content.
    #[error(
        "{file}: {count} {what} exceed the limit of {limit}; split the scene or draw fewer instances"
    )]
    TooLarge {
        /// The file.
        file: String,
        /// What is counted.
        what: &'static str,
        /// How many there are, at least.
        count: u64,
        /// How many there may be.
        limit: u64,
    },
}

/// A fault at a place in the file, which whoever meets it turns into an error or a warning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    /// JSON pointer.
    pub place: String,
    /// What was expected and what was found.
    pub reason: String,
}

impl Fault {
    pub fn new(place: impl Into<String>, reason: impl Into<String>) -> Self {
        Self {
            place: place.into(),
            reason: reason.into(),
        }
    }

    /// The fault, and what follows from it.
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

/// Warnings about one file; only the first [`Warnings::KEPT`] are kept, the others counted, so that a
/// file broken in every element does not bury its user.
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

    /// None so far about the same file.
    pub fn of_the_same_file(&self) -> Self {
        Self::new(&self.file)
    }

    /// Adds those of another list.
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

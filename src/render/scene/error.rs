//! Errors of scenes, and their places in the file.

use std::{collections::BTreeMap, fmt, io, sync::Arc};

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
    #[error("{file}: {count} {what} exceed the limit of {limit}; split the scene or draw fewer instances")]
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
pub(crate) struct Fault {
    /// JSON pointer to the place.
    pub place: String,
    /// Expectation, and what was found instead.
    pub reason: String,
}

impl Fault {
    pub fn new(place: impl Into<String>, reason: impl Into<String>) -> Self {
        Self { place: place.into(), reason: reason.into() }
    }

    /// Adds the consequence to the fault's reason.
    #[must_use]
    pub fn but(self, consequence: &str) -> Self {
        Self::new(self.place, format!("{}; {consequence}", self.reason))
    }

    pub fn into_error(self, file: &str) -> SceneError {
        SceneError::Malformed { file: file.to_owned(), place: self.place, reason: self.reason }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.reason)
    }
}

/// Warnings about a file. Only the first [`Warnings::KEPT`] are kept and the others counted, so that a file with a
/// fault in every element does not flood its user. What a reader met and does not use is counted by its kind, and named
/// in one warning at the end.
#[derive(Debug)]
pub(crate) struct Warnings {
    file: String,
    list: Vec<String>,
    dropped: usize,
    /// Kinds of things that are left out.
    left_out: BTreeMap<String, LeftOut>,
}

/// Number of things of one kind that a reader met and does not use, and descriptions of them.
#[derive(Debug, Default)]
struct LeftOut {
    count: u64,
    /// The first [`LeftOut::NAMED`] different descriptions.
    named: Vec<String>,
    /// Whether there are other descriptions.
    more: bool,
}

impl LeftOut {
    const NAMED: usize = 20;

    fn add(&mut self, count: u64, name: &str) {
        self.count += count;
        if name.is_empty() || self.named.iter().any(|other| other == name) {
            return;
        }
        if self.named.len() < Self::NAMED {
            self.named.push(name.to_owned());
        } else {
            self.more = true;
        }
    }
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}", self.count)?;
        for (index, name) in self.named.iter().enumerate() {
            write!(f, "{} {name}", if index == 0 { ":" } else { "," })?;
        }
        f.write_str(if self.more { ", ...)" } else { ")" })
    }
}

impl Warnings {
    const KEPT: usize = 100;

    pub fn new(file: &str) -> Self {
        Self { file: file.to_owned(), list: Vec::new(), dropped: 0, left_out: BTreeMap::new() }
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
        for (kind, other) in others.left_out {
            let ours = self.left_out.entry(kind).or_default();
            other.named.iter().for_each(|name| ours.add(0, name));
            ours.count += other.count;
            ours.more |= other.more;
        }
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

    /// Counts `count` things of a kind that the file has and the reader does not use. `name` describes them further,
    /// unless it is empty.
    pub fn leave_out(&mut self, kind: &str, count: usize, name: &str) {
        if count > 0 {
            let left_out = self.left_out.entry(kind.to_owned()).or_default();
            left_out.add(count as u64, name);
        }
    }

    pub fn into_vec(mut self) -> Vec<String> {
        if self.dropped > 0 {
            self.list.push(format!("{}: and {} more warnings", self.file, self.dropped));
        }
        if !self.left_out.is_empty() {
            let kinds = self.left_out.iter();
            let kinds: Vec<String> = kinds.map(|(kind, left_out)| format!("{kind} {left_out}")).collect();
            self.list.push(format!("{}: left out: {}", self.file, kinds.join("; ")));
        }
        self.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_out_is_counted_and_named_once() {
        let mut warnings = Warnings::new("file");
        (0..200).for_each(|i| warnings.push(&Fault::new(i.to_string(), "fault")));
        warnings.leave_out("textures", 1, "a.tif: TIFF is not supported");
        warnings.leave_out("face colours", 12, "");
        let mut others = warnings.of_the_same_file();
        others.leave_out("textures", 2, "b.gif: GIF is not supported");
        others.leave_out("textures", 0, "none");
        warnings.append(others);
        let list = warnings.into_vec();
        assert_eq!(list.len(), Warnings::KEPT + 2);
        assert_eq!(
            list[Warnings::KEPT + 1],
            "file: left out: face colours (12); textures (3: a.tif: TIFF is not supported, b.gif: GIF is not supported)"
        );
        let mut many = Warnings::new("file");
        (0..50).for_each(|i| many.leave_out("properties", 1, &format!("p{i}")));
        let [line] = many.into_vec().try_into().unwrap();
        assert!(line.starts_with("file: left out: properties (50: p0, p1,"), "{line}");
        assert!(line.ends_with("p19, ...)"), "{line}");
    }
}

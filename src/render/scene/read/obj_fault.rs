//! The line of an OBJ file that the parser refuses. The parser itself does not report it.

use std::borrow::Cow;

use tobj::{LoadError, LoadOptions};

use crate::scene::error::Fault;

/// Elements to which indices refer, in the order of a face's corner.
const NAMED: [&str; 3] = ["vertex", "texture coordinate", "normal"];

/// Index that is out of range at its line.
struct OutOfRange {
    line: usize,
    /// Index into [`NAMED`].
    kind: usize,
    index: isize,
}

impl OutOfRange {
    /// The fault, unless the element that the index refers to exists by now.
    fn fault(&self, counts: [usize; 3]) -> Option<Fault> {
        let Self { line, kind, index } = *self;
        let (name, count) = (NAMED[kind], counts[kind]);
        // If there are no elements of a kind, the parser ignores indices to them.
        let is_ignored = kind > 0 && count == 0;
        let is_there = usize::try_from(index).is_ok_and(|index| (1..=count).contains(&index));
        let reason = format!("{name} {index} is named, and there are {count}, counted from 1");
        (!is_ignored && !is_there).then(|| fault(line, &reason))
    }
}

fn fault(line: usize, reason: &str) -> Fault {
    let reason = format!("the OBJ file is broken: {reason}; export it again");
    Fault::new(format!("line {line}"), reason)
}

/// Finds the fault for which the parser refuses a file, and its line; `None` if it can't be found.
pub fn find(obj: &[u8]) -> Option<Fault> {
    let text = String::from_utf8_lossy(obj);
    let mut counts = [0; 3];
    let mut out_of_range: Vec<OutOfRange> = Vec::new();
    for (line, statement) in statements(&text) {
        let mut words = statement.split_whitespace();
        let kind = match words.next() {
            Some("v") => 0,
            Some("vt") => 1,
            Some("vn") => 2,
            Some("f" | "l" | "p") => {
                for word in words {
                    let Some(indices) = indices(word) else {
                        let reason = format!("\"{word}\" names no corner");
                        return Some(fault(line, &reason));
                    };
                    let named = indices.into_iter().enumerate();
                    out_of_range.extend(named.filter_map(|(kind, index)| {
                        let index = index?;
                        let back = index.unsigned_abs();
                        let is_relative = index < 0 && back <= counts[kind];
                        let is_there = index > 0 && back <= counts[kind];
                        // The corner has neither a texture coordinate nor a normal.
                        let is_none = index == 0 && kind > 0;
                        let is_fine = is_relative || is_there || is_none;
                        (!is_fine).then_some(OutOfRange { line, kind, index })
                    }));
                }
                continue;
            }
            // Faces are made at the end of their object, from the elements that exist by then.
            Some("o" | "g") => {
                let found = out_of_range.drain(..).find_map(|it| it.fault(counts));
                if found.is_some() {
                    return found;
                }
                continue;
            }
            _ => continue,
        };
        if let Err(error) = parsed(&statement) {
            return Some(fault(line, &error.to_string()));
        }
        counts[kind] += 1;
    }
    out_of_range.iter().find_map(|it| it.fault(counts))
}

/// Result of the parser for a statement that depends on no others.
fn parsed(statement: &str) -> Result<(), LoadError> {
    let no_materials = |_: &_| Err(LoadError::OpenFileFailed);
    tobj::load_obj_buf(
        &mut statement.as_bytes(),
        &LoadOptions::default(),
        no_materials,
    )
    .map(|_| ())
}

/// Indices of a corner, written `vertex/texture coordinate/normal`; each may be missing.
fn indices(corner: &str) -> Option<[Option<isize>; 3]> {
    let mut indices = [None; 3];
    for (place, word) in corner.split('/').enumerate() {
        if !word.is_empty() {
            *indices.get_mut(place)? = Some(word.parse().ok()?);
        }
    }
    Some(indices)
}

/// Statements of a text, with the numbers of the lines in which they begin, from 1.
fn statements(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let mut lines = (1..).zip(text.lines());
    std::iter::from_fn(move || {
        let (number, line) = lines.next()?;
        let mut statement = Cow::Borrowed(line);
        // A statement that ends in a backslash continues in the next line.
        while statement.ends_with('\\') {
            let joined = statement.to_mut();
            joined.pop();
            joined.push(' ');
            joined.push_str(lines.next().map_or("", |(_, next)| next));
        }
        Some((number, statement))
    })
}

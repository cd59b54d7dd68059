//! Statements and numbers of text formats.

use std::borrow::Cow;

use crate::scene::error::Fault;

/// Statements of a text with the numbers of the lines in which they begin, from 1. Lines end with LF, CR or both. A
/// statement that ends in a backslash continues in the next line.
pub fn statements(text: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, [u8]>)> {
    let mut lines = (1..).zip(Lines(text.strip_prefix(BOM).unwrap_or(text)));
    std::iter::from_fn(move || {
        let (number, line) = lines.next()?;
        let mut statement = Cow::Borrowed(line);
        while statement.last() == Some(&b'\\') {
            let Some((_, next)) = lines.next() else {
                break;
            };
            let joined = statement.to_mut();
            joined.pop();
            joined.push(b' ');
            joined.extend(next);
        }
        Some((number, statement))
    })
}

/// Byte-order mark of UTF-8.
pub const BOM: &[u8] = b"\xEF\xBB\xBF";

/// Lines of a text.
pub struct Lines<'t>(pub &'t [u8]);

impl<'t> Iterator for Lines<'t> {
    type Item = &'t [u8];

    fn next(&mut self) -> Option<&'t [u8]> {
        if self.0.is_empty() {
            return None;
        }
        let end = self.0.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        let (line, rest) = self.0.split_at(end.unwrap_or(self.0.len()));
        let rest = rest.strip_prefix(b"\r\n").or_else(|| rest.get(1..));
        self.0 = rest.unwrap_or(&[]);
        Some(line)
    }
}

/// Words of a statement.
pub fn words(statement: &[u8]) -> impl Iterator<Item = &[u8]> {
    statement.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// The first word of a statement, and the rest without blanks around it.
pub fn keyword(statement: &[u8]) -> (&[u8], &[u8]) {
    let statement = statement.trim_ascii();
    let end = statement.iter().position(u8::is_ascii_whitespace);
    let (word, rest) = statement.split_at(end.unwrap_or(statement.len()));
    (word, rest.trim_ascii_start())
}

/// Text of a name or message; bytes that are not Unicode are replaced.
pub fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Text in UTF-16 with a byte-order mark, as UTF-8; other bytes as they are.
pub fn utf8(bytes: &[u8]) -> Cow<'_, [u8]> {
    let from: fn([u8; 2]) -> u16 = match bytes {
        [0xFF, 0xFE, ..] => u16::from_le_bytes,
        [0xFE, 0xFF, ..] => u16::from_be_bytes,
        _ => return Cow::Borrowed(bytes),
    };
    let units: Vec<u16> = bytes[2..].as_chunks().0.iter().map(|unit| from(*unit)).collect();
    Cow::Owned(String::from_utf16_lossy(&units).into_bytes())
}

/// A number, also with the exponent of Fortran (`1.5d0`). Every spelling of a number that is none gives NaN, including those of old C libraries such as `-nan(ind)`,
/// `1.#QNAN` and `-1.#IND00`.
pub fn number(word: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(word).ok()?;
    let fortran = || text.contains(['d', 'D']).then(|| text.replace(['d', 'D'], "e").parse().ok()).flatten();
    let parsed = text.parse().ok();
    parsed.or_else(|| is_none(word).then_some(f64::NAN)).or_else(fortran)
}

fn is_none(word: &[u8]) -> bool {
    let unsigned = word.strip_prefix(b"-").or_else(|| word.strip_prefix(b"+"));
    let unsigned = unsigned.unwrap_or(word).to_ascii_lowercase();
    let end = unsigned.iter().position(|byte| !byte.is_ascii_alphabetic());
    let name = &unsigned[..end.unwrap_or(unsigned.len())];
    let names: [&[u8]; 8] = [b"nan", b"nanq", b"nans", b"qnan", b"snan", b"inf", b"infinity", b"ind"];
    names.contains(&name) || unsigned.starts_with(b"1.#")
}

/// The fault of a file that its format does not allow.
pub fn broken(format: &str, place: impl Into<String>, reason: &str) -> Fault {
    Fault::new(place, format!("the {format} file is broken: {reason}; export it again"))
}

/// The reason why a word is refused as a number.
pub fn no_number(word: &[u8]) -> String {
    let shown = text(&word[..word.len().min(40)]);
    let point = shown.replacen(',', ".", 1);
    if point.parse::<f64>().is_ok() {
        return format!("\"{shown}\" has a decimal comma; write \"{point}\"");
    }
    format!("\"{shown}\" is not a number")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_none_in_any_spelling() {
        for word in
            ["nan", "NaN", "-nan", "-nan(ind)", "nan(snan)", "1.#QNAN", "-1.#IND00", "1.#INF", "+NAN", "-1.#IND"]
        {
            assert!(!number(word.as_bytes()).unwrap().is_finite(), "{word}");
        }
        assert_eq!(number(b"-1.5e2"), Some(-150.0));
        assert_eq!((number(b"-1.5D2"), number(b"1d-1")), (Some(-150.0), Some(0.1)));
        assert_eq!(number(b"infinity"), Some(f64::INFINITY));
        for word in ["", "one", "1,5", "0x10", "1.5.2", "\u{fc}", "nancy", "-", "d", "1d", "1d1d1"] {
            assert_eq!(number(word.as_bytes()), None, "{word}");
        }
        assert_eq!(no_number(b"1,5"), "\"1,5\" has a decimal comma; write \"1.5\"");
        assert_eq!(no_number(b"one"), "\"one\" is not a number");
    }

    #[test]
    fn statements_with_all_line_ends() {
        let text = b"\xEF\xBB\xBFa\r\nb \\\nc\r\rd\\\r\ne\n\nf\\";
        let found: Vec<_> = statements(text).map(|(line, s)| (line, super::text(&s))).collect();
        let expected = [(1, "a"), (2, "b  c"), (4, ""), (5, "d e"), (7, ""), (8, "f\\")];
        assert_eq!(found, expected.map(|(line, s)| (line, s.to_owned())));
    }
}

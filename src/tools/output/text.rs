//! Text in PNG files: tEXt chunks (PNG Specification, Third Edition, section 11.3.3.2).

use super::OutputError;

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
const TEXT: &[u8] = b"tEXt";

/// Length and type before a chunk's data, and the checksum after it.
const AROUND: usize = 12;

/// Puts a text into an encoded PNG, right after its header. Keyword and text must be ASCII, the keyword 1 to 79
/// characters long.
///
/// # Errors
/// [`OutputError::Encode`] if the bytes are no PNG, or keyword or text can't be held.
pub fn add_text(png: &[u8], keyword: &str, text: &str) -> Result<Vec<u8>, OutputError> {
    let refuse = |reason: &str| Err(OutputError::Encode(reason.to_owned()));
    if !(1..=79).contains(&keyword.len()) || !keyword.is_ascii() || !text.is_ascii() {
        return refuse("a PNG's keyword must be 1 to 79 ASCII characters, its text ASCII");
    }
    let Some((header, rest)) = header(png).and_then(|length| png.split_at_checked(length)) else {
        return refuse("text can be put into a PNG only");
    };
    let data = [keyword.as_bytes(), &[0], text.as_bytes()].concat();
    let Ok(length) = u32::try_from(data.len()) else {
        return refuse("the text is too long for a PNG");
    };
    let checksum = crc32fast::hash(&[TEXT, &data].concat());
    Ok([
        header,
        &length.to_be_bytes(),
        TEXT,
        &data,
        &checksum.to_be_bytes(),
        rest,
    ]
    .concat())
}

/// The text of the first chunk with a keyword; `None` where there is none, or the bytes are no PNG.
#[must_use]
pub fn find_text(png: &[u8], keyword: &str) -> Option<String> {
    let mut rest = png.strip_prefix(SIGNATURE)?;
    loop {
        let length = u32::from_be_bytes(rest.get(..4)?.try_into().ok()?) as usize;
        let end = length.checked_add(AROUND)?;
        let chunk = rest.get(..end)?;
        if chunk.get(4..8) == Some(TEXT) {
            let data = chunk.get(8..end - 4)?;
            let text = data
                .strip_prefix(keyword.as_bytes())
                .and_then(|rest| rest.strip_prefix(&[0]));
            if let Some(text) = text {
                // Latin-1 is the start of Unicode.
                return Some(text.iter().copied().map(char::from).collect());
            }
        }
        rest = rest.get(end..)?;
    }
}

/// Where the header chunk ends.
fn header(png: &[u8]) -> Option<usize> {
    const DATA: usize = 13;
    let end = SIGNATURE.len() + AROUND + DATA;
    (png.starts_with(SIGNATURE) && png.len() > end).then_some(end)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{decode, encode_rgb};

    #[test]
    fn a_text_is_found_again_and_the_picture_is_the_same() {
        let png = encode_rgb([2, 1], &[[1, 2, 3], [4, 5, 6]]).unwrap();
        let noted = add_text(&png, "note", "first").unwrap();
        let noted = add_text(&noted, "other", "second").unwrap();
        assert_eq!(find_text(&noted, "note").as_deref(), Some("first"));
        assert_eq!(find_text(&noted, "other").as_deref(), Some("second"));
        assert_eq!(find_text(&noted, "not"), None);
        assert_eq!(decode(&noted, "a").unwrap(), decode(&png, "a").unwrap());
    }

    #[test]
    fn broken_files_have_no_text() {
        let png = add_text(&encode_rgb([1, 1], &[[0; 3]]).unwrap(), "note", "text").unwrap();
        for length in 0..png.len() {
            assert!(find_text(&png[..length], "other").is_none());
        }
        assert!(add_text(b"JFIF", "note", "text").is_err());
        assert!(add_text(&png, "", "text").is_err() && add_text(&png, "note", "ü").is_err());
    }
}

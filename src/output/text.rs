//! Text in PNG files: tEXt chunks (PNG Specification, Third Edition, section 11.3.3.2).

use super::OutputError;
use image::ImageFormat;
use png::text_metadata::{EncodableTextChunk, TEXtChunk};
use std::io::Cursor;

/// Number of bytes of a PNG's signature and header chunk, which all other chunks follow.
const HEADER: usize = 8 + 25;

/// Inserts a text into an encoded PNG, right after its header. Keyword and text are Latin-1; the keyword has 1 to 79
/// characters.
///
/// # Errors
/// [`OutputError::Encode`] if the bytes are no PNG, or if a PNG can't hold the keyword or the text.
pub fn add_text(png: &[u8], keyword: &str, text: &str) -> Result<Vec<u8>, OutputError> {
    let is_png = image::guess_format(png).is_ok_and(|format| format == ImageFormat::Png);
    let Some((header, rest)) = png.split_at_checked(HEADER).filter(|_| is_png) else {
        let reason = "text can be put into a PNG only";
        return Err(OutputError::Encode(reason.to_owned()));
    };
    let mut noted = header.to_vec();
    TEXtChunk::new(keyword, text).encode(&mut noted).map_err(|error| OutputError::Encode(error.to_string()))?;
    noted.extend(rest);
    Ok(noted)
}

/// Text of the first tEXt chunk with this keyword; `None` if there is none, or if the bytes are no PNG.
#[must_use]
pub fn find_text(png: &[u8], keyword: &str) -> Option<String> {
    let mut reader = png::Decoder::new(Cursor::new(png)).read_info().ok()?;
    // Text chunks may also follow the pixels.
    reader.finish().ok()?;
    let mut texts = reader.info().uncompressed_latin1_text.iter();
    texts.find(|text| text.keyword == keyword).map(|text| text.text.clone())
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
        let accented = add_text(&png, "note", "é").unwrap();
        assert_eq!(find_text(&accented, "note").as_deref(), Some("é"));
        assert_eq!(decode(&noted, "a").unwrap(), decode(&png, "a").unwrap());
    }

    #[test]
    fn broken_files_have_no_text() {
        let png = add_text(&encode_rgb([1, 1], &[[0; 3]]).unwrap(), "note", "text").unwrap();
        for length in 0..png.len() {
            assert!(find_text(&png[..length], "other").is_none());
        }
        assert!(add_text(b"JFIF", "note", "text").is_err());
        assert!(add_text(&png, "", "text").is_err() && add_text(&png, "note", "€").is_err());
    }
}

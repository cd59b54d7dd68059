//! Buffers and images by URI: data URIs and files beside the scene (glTF 2.0, section 2.8).

use std::{
    borrow::Cow,
    fs::{self, File},
    io::Read,
    path::{Component, Path, PathBuf},
};

use base64::{
    Engine,
    alphabet::STANDARD,
    engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig},
};
use percent_encoding::percent_decode_str;

use super::container::is_lfs_pointer;

/// Base64 decoder that accepts data with and without padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// Reads what `uri` refers to, relative to the folder `base`, and at most `limit` bytes of a file. The error is a
/// reason without the place.
pub fn fetch(uri: &str, base: Option<&Path>, limit: u64) -> Result<Vec<u8>, String> {
    if let Some((scheme, rest)) = uri.split_at_checked(5)
        && scheme.eq_ignore_ascii_case("data:")
    {
        return decode_data(rest);
    }
    if let Some((scheme, _)) = uri.split_once(':') {
        // A scheme is a letter, then letters, digits, +, - and dots (RFC 3986). A drive letter looks the same and is
        // refused too: it would make the scene unusable elsewhere.
        let mut letters = scheme.chars();
        if letters.next().is_some_and(|c| c.is_ascii_alphabetic())
            && letters.all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c))
        {
            return Err(format!(
                "URIs of scheme \"{scheme}\" are not fetched; put the file beside the scene"
            ));
        }
    }
    let base = base.ok_or_else(|| {
        format!("\"{uri}\" is a file beside the scene, but the scene was not read from a folder")
    })?;
    let path = locate(uri, base)?;
    read_file(&path, limit)
}

/// Decodes the part of a data URI after `data:` (RFC 2397).
fn decode_data(rest: &str) -> Result<Vec<u8>, String> {
    let (kind, data) = rest
        .split_once(',')
        .ok_or("the data URI has no comma before its data")?;
    let data = Cow::from(percent_decode_str(data));
    if kind.ends_with(";base64") {
        BASE64
            .decode(&*data)
            .map_err(|error| format!("the data URI's base64 is broken: {error}"))
    } else {
        Ok(data.into_owned())
    }
}

/// File of a relative reference: unescaped, as the specification requires, or otherwise as it is written.
fn locate(uri: &str, base: &Path) -> Result<PathBuf, String> {
    let decoded = Cow::from(percent_decode_str(uri));
    let decoded = std::str::from_utf8(&decoded)
        .map_err(|_| format!("\"{uri}\" is not UTF-8 when unescaped"))?;
    let relative = Path::new(decoded);
    let inside = |c: Component<'_>| !matches!(c, Component::Prefix(_) | Component::RootDir);
    if decoded.contains('\0') || !relative.components().all(inside) {
        return Err(format!("\"{uri}\" is not a relative path"));
    }
    let unescaped = base.join(relative);
    let verbatim = base.join(uri);
    if !unescaped.exists() && verbatim.exists() {
        return Ok(verbatim);
    }
    Ok(unescaped)
}

fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let failed = |error: std::io::Error| format!("{} cannot be read: {error}", path.display());
    // Opening a pipe or a device might block, or reading it never end.
    let found = fs::metadata(path).map_err(failed)?;
    if !found.is_file() {
        return Err(format!("{} is not a regular file", path.display()));
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(limit).read_to_end(&mut bytes))
        .map_err(failed)?;
    if is_lfs_pointer(&bytes) {
        return Err(format!(
            "{} is a Git LFS pointer, not the file itself; fetch it with `git lfs pull`",
            path.display()
        ));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_uris_in_base64_and_percent_encoding() {
        let fetch = |uri| fetch(uri, None, u64::MAX);
        assert_eq!(fetch("data:;base64,AAEC").unwrap(), [0, 1, 2]);
        assert_eq!(fetch("data:x/y;base64,AAE").unwrap(), [0, 1]);
        assert_eq!(fetch("data:text/plain,a%20b").unwrap(), b"a b");
        assert!(fetch("data:;base64").is_err());
        assert!(fetch("data:;base64,A").is_err());
    }

    #[test]
    fn only_relative_paths_to_regular_files() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a b❤.bin"), [7]).unwrap();
        let fetch = |uri| fetch(uri, Some(folder.path()), 10);
        assert_eq!(fetch("a%20b%E2%9D%A4.bin").unwrap(), [7]);
        assert_eq!(fetch("a b❤.bin").unwrap(), [7]);
        for bad in [
            "/etc/hostname",
            "http://x/y",
            "file:///etc/hostname",
            ".",
            "none.bin",
            "%FF",
        ] {
            assert!(fetch(bad).is_err(), "{bad}");
        }
    }
}

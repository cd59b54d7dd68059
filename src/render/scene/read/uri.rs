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

/// What a URI refers to.
#[derive(Debug)]
pub struct Fetched {
    pub bytes: Vec<u8>,
    /// Fault of the URI that other programs tolerate too.
    pub note: Option<String>,
}

/// Reads what `uri` refers to, relative to the folder `base`, and at most `limit` bytes of a file. The error is a
/// reason without the place.
pub fn fetch(uri: &str, base: Option<&Path>, limit: u64) -> Result<Fetched, String> {
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
            return Err(format!("URIs of scheme \"{scheme}\" are not fetched; put the file beside the scene"));
        }
    }
    let base =
        base.ok_or_else(|| format!("\"{uri}\" is a file beside the scene, but the scene was not read from a folder"))?;
    let (path, note) = locate(uri, base)?;
    let bytes = read_file(&path, limit)?;
    Ok(Fetched { bytes, note })
}

/// What two URIs have in common if they refer to the same file, or are the same data.
pub fn identity<'u>(uri: &'u str, base: Option<&Path>) -> Cow<'u, Path> {
    let is_data = uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"));
    let file = base.filter(|_| !is_data).and_then(|base| fs::canonicalize(locate(uri, base).ok()?.0).ok());
    file.map_or(Cow::Borrowed(Path::new(uri)), Cow::Owned)
}

/// Decodes the part of a data URI after `data:` (RFC 2397) as browsers do (the Fetch standard's "data: URL processor"): the
/// word `base64` in any case, white space in base64, and a fragment.
fn decode_data(rest: &str) -> Result<Fetched, String> {
    let (rest, _fragment) = rest.split_once('#').unwrap_or((rest, ""));
    let (kind, data) = rest.split_once(',').ok_or("the data URI has no comma before its data")?;
    let data = Cow::from(percent_decode_str(data));
    let is_base64 =
        kind.trim_end().rsplit_once(';').is_some_and(|(_, last)| last.trim_start().eq_ignore_ascii_case("base64"));
    if !is_base64 {
        let (bytes, note) = (data.into_owned(), None);
        return Ok(Fetched { bytes, note });
    }
    let has_space = data.iter().any(u8::is_ascii_whitespace);
    let data = match has_space {
        true => Cow::Owned(data.iter().copied().filter(|b| !b.is_ascii_whitespace()).collect()),
        false => data,
    };
    let bytes = BASE64.decode(&*data).map_err(|error| format!("the data URI's base64 is broken: {error}"))?;
    let note = has_space.then(|| "the data URI's base64 has white space, which is ignored".to_owned());
    Ok(Fetched { bytes, note })
}

/// File of a relative reference, and a fault of the reference. The file is the first that exists of these: the reference
/// unescaped, as the specification requires; as it is written; without query and fragment; each of them with slashes in the
/// place of backslashes. If none exists, the first is returned.
fn locate(uri: &str, base: &Path) -> Result<(PathBuf, Option<String>), String> {
    let bare = uri.split(['?', '#']).next().unwrap_or_default();
    let mut candidates = Vec::new();
    for written in [uri, bare] {
        let decoded = Cow::from(percent_decode_str(written));
        let decoded =
            String::from_utf8(decoded.into_owned()).map_err(|_| format!("\"{uri}\" is not UTF-8 when unescaped"))?;
        candidates.extend([decoded, written.to_owned()]);
    }
    let with_slashes: Vec<String> = candidates.iter().map(|c| c.replace('\\', "/")).collect();
    let backslashes = candidates.len();
    candidates.extend(with_slashes);
    let is_relative = |path: &String| {
        let inside = |c: Component<'_>| !matches!(c, Component::Prefix(_) | Component::RootDir);
        !path.is_empty() && !path.contains('\0') && Path::new(path).components().all(inside)
    };
    if !candidates.first().is_some_and(is_relative) {
        return Err(format!("\"{uri}\" is not a relative path"));
    }
    let exists = |path: &String| is_relative(path) && base.join(path).exists();
    let found = candidates.iter().position(exists).unwrap_or(0);
    let note = (found >= backslashes)
        .then(|| format!("\"{uri}\" has backslashes, which are read as slashes; other programs may not find the file"));
    Ok((base.join(&candidates[found]), note))
}

fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let failed = |error: std::io::Error| format!("{} cannot be read: {error}", path.display());
    // Opening a pipe or a device might block, or reading it never end.
    let found = fs::metadata(path).map_err(failed)?;
    if !found.is_file() {
        return Err(format!("{} is not a regular file", path.display()));
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(limit).read_to_end(&mut bytes)).map_err(failed)?;
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
        let bytes = |uri| {
            let Fetched { bytes, note } = fetch(uri).unwrap();
            assert_eq!(note, None, "{uri}");
            bytes
        };
        assert_eq!(bytes("data:;base64,AAEC"), [0, 1, 2]);
        assert_eq!(bytes("data:x/y;base64,AAE"), [0, 1]);
        assert_eq!(bytes("DATA:x/y;charset=utf-8; Base64,AAEC#part"), [0, 1, 2]);
        assert_eq!(bytes("data:text/plain,a%20b"), b"a b");
        assert_eq!(bytes("data:x/base64,AAEC"), b"AAEC");
        assert!(fetch("data:;base64").is_err());
        assert!(fetch("data:;base64,A").is_err());
        for spaced in ["data:;base64,AA\nEC\r\n", "data:;base64, AAE%0AC"] {
            let Fetched { bytes, note } = fetch(spaced).unwrap();
            assert_eq!(bytes, [0, 1, 2]);
            assert!(note.unwrap().contains("white space"));
        }
    }

    #[test]
    fn only_relative_paths_to_regular_files() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a b❤.bin"), [7]).unwrap();
        let fetch = |uri| fetch(uri, Some(folder.path()), 10);
        assert_eq!(fetch("a%20b%E2%9D%A4.bin").unwrap().bytes, [7]);
        assert_eq!(fetch("a b❤.bin").unwrap().bytes, [7]);
        for bad in [
            "/etc/hostname",
            "http://x/y",
            "file:///etc/hostname",
            ".",
            "none.bin",
            "?a%20b❤.bin",
            "\\etc\\hostname",
            "%5C%5Cetc%5Chostname",
            "%FF",
        ] {
            assert!(fetch(bad).is_err(), "{bad}");
        }
    }
    /// A file's own name counts before any other reading of it.
    #[test]
    fn queries_fragments_and_backslashes_lead_to_the_file() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("in")).unwrap();
        let files = [("in/a.bin", 1), ("in/b#c?d.bin", 2), ("in/b", 3)];
        for (name, byte) in files {
            std::fs::write(folder.path().join(name), [byte]).unwrap();
        }
        let fetch = |uri| {
            let Fetched { bytes, note } = fetch(uri, Some(folder.path()), 10).unwrap();
            (bytes[0], note.is_some())
        };
        for (uri, expected) in [
            ("in/a.bin?v=3", (1, false)),
            ("in/a.bin#1", (1, false)),
            ("in/a.bin?v=3#1", (1, false)),
            ("in/b#c?d.bin", (2, false)),
            ("in/b%23c%3Fd.bin", (2, false)),
            ("in/b#c", (3, false)),
            ("in\\a.bin", (1, true)),
            ("in%5Ca.bin?v=3", (1, true)),
            (".\\in\\..\\in\\b#c?d.bin", (2, true)),
        ] {
            assert_eq!(fetch(uri), expected, "{uri}");
        }
    }
}

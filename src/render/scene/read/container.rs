//! JSON document and binary chunk of a file (glTF 2.0, section 4).

use serde_json::Value;

use super::foreign;
use crate::scene::{SceneError, error::Warnings};

/// The two halves of a glTF file.
#[derive(Debug)]
pub struct Container<'a> {
    /// The JSON document.
    pub json: Value,
    /// The GLB's binary chunk.
    pub binary: Option<&'a [u8]>,
}

/// First line of the text that Git LFS leaves in place of a file that was not fetched.
const LFS_POINTER: &[u8] = b"version https://git-lfs.github.com/spec/";

/// Whether `bytes` are a Git LFS pointer instead of the file itself.
pub fn is_lfs_pointer(bytes: &[u8]) -> bool {
    bytes.starts_with(LFS_POINTER)
}

/// Whether `bytes` start as a GLB does.
pub fn is_glb(bytes: &[u8]) -> bool {
    bytes.starts_with(b"glTF")
}

/// Distinguishes GLB from JSON by content, and splits it.
pub fn open<'a>(bytes: &'a [u8], file: &str, warnings: &mut Warnings) -> Result<Container<'a>, SceneError> {
    let refuse = |reason: String| SceneError::NotGltf { file: file.to_owned(), reason };
    if bytes.is_empty() {
        return Err(refuse("the file is empty".to_owned()));
    }
    if is_lfs_pointer(bytes) {
        return Err(refuse("this is a Git LFS pointer, not the file itself; fetch it with `git lfs pull`".to_owned()));
    }
    let (json, binary) = if is_glb(bytes) { split_glb(bytes, file, warnings)? } else { (bytes, None) };
    let json = json.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(json);
    match json.iter().find(|byte| !byte.is_ascii_whitespace()) {
        Some(b'{') => {}
        Some(_) => {
            let hint = foreign::hint(bytes);
            return Err(refuse(
                hint.unwrap_or_else(|| "is neither a GLB nor a glTF JSON document, nor OBJ, STL or PLY".to_owned()),
            ));
        }
        None => return Err(refuse("the JSON document is empty".to_owned())),
    }
    let json = serde_json::from_slice(json).map_err(|error| refuse(format!("the JSON document is broken: {error}")))?;
    Ok(Container { json, binary })
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let word = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes(word.try_into().ok()?))
}

/// JSON and binary chunk of a GLB; unknown chunks are skipped, as the specification asks, and named.
fn split_glb<'a>(
    bytes: &'a [u8],
    file: &str,
    warnings: &mut Warnings,
) -> Result<(&'a [u8], Option<&'a [u8]>), SceneError> {
    let refuse = |reason: String| SceneError::NotGltf { file: file.to_owned(), reason };
    let truncated =
        |what: &str| refuse(format!("the GLB is truncated: {what}, the file ends after {} bytes", bytes.len()));
    let version = word(bytes, 4).ok_or_else(|| truncated("its header has 12 bytes"))?;
    if version != 2 {
        return Err(SceneError::Version {
            file: file.to_owned(),
            found: format!("{version}.0 (GLB header)"),
            way_out: CONVERT_OLD,
        });
    }
    let length = word(bytes, 8).ok_or_else(|| truncated("its header has 12 bytes"))? as usize;
    let body = bytes.get(..length).ok_or_else(|| truncated(&format!("its header declares {length} bytes")))?;

    warnings.leave_out("bytes behind the GLB", bytes.len() - length, "");
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while at < body.len() {
        let (Some(size), Some(kind)) = (word(body, at), word(body, at + 4)) else {
            return Err(truncated(&format!("a chunk header starts at {at}")));
        };
        let chunk = (at + 8)
            .checked_add(size as usize)
            .and_then(|end| body.get(at + 8..end))
            .ok_or_else(|| truncated(&format!("the chunk at {at} declares {size} bytes")))?;
        match &kind.to_le_bytes() {
            b"JSON" if json.is_none() => json = Some(chunk),
            b"BIN\0" if binary.is_none() => binary = Some(chunk),
            other => warnings.leave_out("chunks", 1, String::from_utf8_lossy(other).trim_end_matches('\0')),
        }
        at += 8 + chunk.len();
    }
    let json = json.ok_or_else(|| refuse("the GLB has no JSON chunk".to_owned()))?;
    Ok((json, binary))
}

/// Advice for files of glTF 1.0.
pub const CONVERT_OLD: &str = "convert it with `gltf-pipeline -i OLD -o NEW.glb`";

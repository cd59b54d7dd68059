//! KTX2 images where the feature `basisu` is off: they are refused.

/// Whether the extension is supported.
pub const AVAILABLE: bool = false;

const REFUSED: &str = "is a KTX2 image, for which the feature `basisu` is needed; convert it to PNG, JPEG or WebP";

/// The error that names the feature.
pub fn dimensions(_: &[u8]) -> Result<(u32, u32), String> {
    Err(REFUSED.to_owned())
}

/// The error that names the feature.
pub fn decode(_: &[u8]) -> Result<Vec<u8>, String> {
    Err(REFUSED.to_owned())
}

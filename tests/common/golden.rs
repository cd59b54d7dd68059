//! Comparison with the golden images in `tests/goldens`, with a common tolerance.
//!
//! The images were made on lavapipe. With `GPC_BLESS` set in the environment, a test writes its image and fails, so
//! that no run both makes and passes a golden image.

use std::path::{Path, PathBuf};

use image::RgbaImage;

/// Largest difference of a channel, in code values, that is ignored.
const TOLERANCE: u8 = 3;
/// Largest number of pixels that may differ by more.
const OUTLIERS: usize = 10;

/// Folder of the golden images: in the repository, or in the folder `GPC_ROOT` on a machine without it.
pub fn folder() -> PathBuf {
    let root = std::env::var_os("GPC_ROOT").unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
    Path::new(&root).join("tests/goldens")
}

/// Compares an image with the golden image `name`.png in a folder.
///
/// # Errors
/// A description of the difference, or a message that the golden image is missing.
pub fn compare(folder: &Path, name: &str, found: &RgbaImage) -> Result<(), String> {
    let path = folder.join(format!("{name}.png"));
    if std::env::var_os("GPC_BLESS").is_some() {
        found.save(&path).map_err(|error| error.to_string())?;
        return Err(format!("{} written; look at it, then unset GPC_BLESS", path.display()));
    }
    let golden =
        image::open(&path).map_err(|error| format!("{}: {error}; GPC_BLESS=1 makes it", path.display()))?.to_rgba8();
    if golden.dimensions() != found.dimensions() {
        return Err(format!("{name} has {:?} pixels and the golden {:?}", found.dimensions(), golden.dimensions()));
    }
    let differs =
        |(a, b): (&image::Rgba<u8>, &image::Rgba<u8>)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > TOLERANCE);
    let outliers = golden.pixels().zip(found.pixels()).filter(|&pair| differs(pair)).count();
    if outliers > OUTLIERS {
        return Err(format!("{name}: {outliers} pixels differ by more than {TOLERANCE} code values; {OUTLIERS} may"));
    }
    Ok(())
}

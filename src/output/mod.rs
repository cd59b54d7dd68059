//! Image files: encoding rendered images, decoding files to compare them, and writing films ([`VideoWriter`]).
//!
//! Rendered colours are linear light with premultiplied alpha. Each format stores them as follows:
//!
//! | name ends in | holds |
//! |---|---|
//! | `.png` | sRGB, 8 bits a channel, straight alpha; without alpha where every pixel is opaque |
//! | `.16.png` | the same with 16 bits a channel |
//! | `.jpg`, `.jpeg` | sRGB over black, quality 95 |
//! | `.exr` | scene-linear float32, premultiplied alpha; AOVs as layers of the same part |
//!
//! An EXR's layers are the channels `depth.Z` (float32), `id.Y` (UINT), `normal.X`, `normal.Y`, `normal.Z`
//! (float32), `superpixels.Y` (UINT) and `samples.Y` (UINT). Beside the other formats an AOV is a PNG file
//! of its own: see [`encode_aov`].

mod aov;
mod decode;
mod encode;
mod error;
mod exr;
mod format;
mod radiance;
mod text;
mod video;
mod write;

pub use aov::{Aov, AovKind};
pub use decode::{DecodedImage, DecodedLight, decode, decode_light, decode_linear, is_image, read};
pub use encode::{codes, encode, encode_aov, encode_rgb, encode_rgba, encode_shares};
pub use error::{OutputError, UnknownFormat};
pub use format::Format;
pub use text::{add_text, find_text};
pub use video::{VideoFormat, VideoWriter};
pub use write::write_atomically;

/// Rendered image: RGBA in linear light with premultiplied alpha, rows from the top.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    size: [u32; 2],
    pixels: &'a [[f32; 4]],
}

impl<'a> Picture<'a> {
    /// Wraps the pixels of an image of `size` = [width, height].
    ///
    /// # Errors
    /// [`OutputError::PixelCount`] if the number of pixels is not width times height, or is 0.
    pub fn new(size: [u32; 2], pixels: &'a [[f32; 4]]) -> Result<Self, OutputError> {
        check_count(size, pixels.len())?;
        Ok(Self { size, pixels })
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// RGBA in linear light, rows from the top.
    #[must_use]
    pub fn pixels(&self) -> &'a [[f32; 4]] {
        self.pixels
    }
}

fn check_count(size: [u32; 2], found: usize) -> Result<(), OutputError> {
    let [width, height] = size;
    let expected = u64::from(width) * u64::from(height);
    if expected == 0 || expected != found as u64 {
        return Err(OutputError::PixelCount { width, height, found });
    }
    Ok(())
}

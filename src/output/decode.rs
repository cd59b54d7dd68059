//! Decoding of image files, for comparisons and as inputs.

use super::{OutputError, Picture, check_count, exr, radiance};
use crate::color::srgb;
use crate::scene::{Warnings, check_texels};
use image::ImageReader;
use rayon::prelude::*;
use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

/// Image as a display shows it: sRGB-encoded colours of 0 to 1 over black, and alpha.
///
/// Translucent colours of a PNG are multiplied by alpha in linear light and encoded again, so that colour which is
/// invisible does not count. The values of an EXR are clamped to 0 to 1 and encoded; they are not tone-mapped.
#[derive(Clone, Debug, PartialEq)]
pub struct DecodedImage {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// RGBA of 0 to 1, rows from the top.
    pub pixels: Vec<[f32; 4]>,
}

impl DecodedImage {
    /// Image of `size` = [width, height] of sRGB codes with straight alpha, as PNG files hold them.
    ///
    /// # Errors
    /// [`OutputError::PixelCount`] if the number of pixels is not width times height, or is 0.
    pub fn from_codes(size: [u32; 2], codes: &[[u8; 4]]) -> Result<Self, OutputError> {
        check_count(size, codes.len())?;
        let show = |code: &[u8; 4]| show_straight(code.map(|v| f32::from(v) / 255.0));
        Ok(Self { size, pixels: codes.par_iter().map(show).collect() })
    }
}

impl From<&Picture<'_>> for DecodedImage {
    /// Converts a rendered image to the image that a display shows, without the rounding of a file.
    fn from(picture: &Picture<'_>) -> Self {
        Self { size: picture.size(), pixels: picture.pixels().par_iter().copied().map(show_linear).collect() }
    }
}

const EXR_MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// Reads a PNG, JPEG or EXR file; the content tells the format.
///
/// # Errors
/// [`OutputError::Read`] if the file can't be read, otherwise as [`decode`].
pub fn read(path: &Path) -> Result<DecodedImage, OutputError> {
    let bytes = std::fs::read(path).map_err(|source| OutputError::Read { path: path.to_path_buf(), source })?;
    decode(&bytes, &path.display().to_string())
}

/// Decodes a PNG, JPEG or EXR image; the content tells the format. `name` stands for the file in messages.
///
/// # Errors
/// [`OutputError::Decode`] if the bytes are in none of these formats or broken, [`OutputError::NotANumber`] for an EXR
/// with NaN.
pub fn decode(bytes: &[u8], name: &str) -> Result<DecodedImage, OutputError> {
    let decoded = if bytes.starts_with(&EXR_MAGIC) {
        exr::decode(bytes, &mut Warnings::new(name)).map(|decoded| (decoded.size, decoded.pixels, true))
    } else {
        display_referred(bytes).map(|(size, pixels)| (size, pixels, false))
    };
    let (size, pixels, linear) = decoded.map_err(|reason| OutputError::Decode {
        file: name.to_owned(),
        reason,
        expected: "a PNG, JPEG or EXR image",
    })?;
    if let Some(index) = pixels.iter().position(|p| p.iter().any(|v| v.is_nan())) {
        let width = size[0] as usize;
        return Err(OutputError::NotANumber { file: name.to_owned(), x: index % width, y: index / width });
    }
    let show = if linear { show_linear } else { show_straight };
    Ok(DecodedImage { size, pixels: pixels.into_par_iter().map(show).collect() })
}

/// Decodes an EXR or Radiance (.hdr) image to [width, height] and its unchanged values: linear light, premultiplied
/// alpha, rows from the top. `name` stands for the file in messages.
///
/// # Errors
/// [`OutputError::Decode`] if the bytes are in neither format or broken.
pub fn decode_linear(bytes: &[u8], name: &str) -> Result<([u32; 2], Vec<[f32; 4]>), OutputError> {
    let opaque = |colors: Vec<[f32; 3]>| colors.into_iter().map(|[r, g, b]| [r, g, b, 1.0]);
    let mut left_out = Warnings::new(name);
    let decoded = if bytes.starts_with(&EXR_MAGIC) {
        exr::decode(bytes, &mut left_out).map(|decoded| (decoded.size, decoded.pixels))
    } else {
        radiance::decode(bytes, &mut left_out).map(|(size, colors)| (size, opaque(colors).collect()))
    };
    decoded.map_err(|reason| not_linear(name, reason))
}

/// Light from all directions, as an image.
#[derive(Clone, Debug, PartialEq)]
pub struct DecodedLight {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Linear colours, rows from the top.
    pub colors: Vec<[f32; 3]>,
    /// Warnings about the file. The last one counts and names what the file has and is not used.
    pub warnings: Vec<String>,
}

/// Decodes an EXR or Radiance image as [`decode_linear`] does, but without alpha. Infinite light is replaced by the largest
/// finite value of the image. `name` stands for the file in messages.
///
/// # Errors
/// As [`decode_linear`], and if the image has the faces of a cube.
pub fn decode_light(bytes: &[u8], name: &str) -> Result<DecodedLight, OutputError> {
    let mut warnings = Warnings::new(name);
    let decoded = if bytes.starts_with(&EXR_MAGIC) {
        exr::decode(bytes, &mut warnings).and_then(|decoded| opaque_light(decoded, &mut warnings))
    } else {
        radiance::decode(bytes, &mut warnings)
    };
    let (size, mut colors) = decoded.map_err(|reason| not_linear(name, reason))?;
    let mut warnings = warnings.into_vec();
    let (infinite, bound) = bound_light(&mut colors);
    if infinite > 0 {
        warnings.insert(0, format!("{name}: {infinite} pixels are infinitely bright and are taken as {bound}"));
    }
    Ok(DecodedLight { size, colors, warnings })
}

/// Size and colours of a sky, in which nothing is seen behind transparent pixels.
fn opaque_light(decoded: exr::Decoded, warnings: &mut Warnings) -> Result<([u32; 2], Vec<[f32; 3]>), String> {
    if decoded.is_cube {
        return Err("it has the faces of a cube (its envmap); convert it to latitude and longitude".to_owned());
    }
    let mut see_through = 0;
    let colors = decoded.pixels.into_iter().map(|[r, g, b, a]| {
        // Where there are no data, alpha is 0.
        see_through += usize::from(a != 1.0 && [r, g, b, a] != [0.0; 4]);
        [r, g, b]
    });
    let colors = colors.collect();
    warnings.leave_out("transparency of pixels", see_through, "");
    Ok((decoded.size, colors))
}

/// Replaces infinite light by the largest finite value of the image, but at least the largest of a half float, beyond which
/// programs write infinity. Returns the number of colours that were changed, and the value.
fn bound_light(colors: &mut [[f32; 3]]) -> (usize, f32) {
    let finite = |x: &f32| x.is_finite();
    let most = colors.as_flattened().iter().copied().filter(finite);
    let most = most.fold(f32::from(half::f16::MAX), f32::max);
    let mut changed = 0;
    for color in colors {
        if color.contains(&f32::INFINITY) {
            changed += 1;
            *color = color.map(|x| if x == f32::INFINITY { most } else { x });
        }
    }
    (changed, most)
}

fn not_linear(name: &str, reason: String) -> OutputError {
    OutputError::Decode { file: name.to_owned(), reason, expected: "an EXR or Radiance (.hdr) image" }
}

/// Size and sRGB-encoded pixels with straight alpha, of a PNG or JPEG.
fn display_referred(bytes: &[u8]) -> Result<([u32; 2], Vec<[f32; 4]>), String> {
    let reader = || {
        let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format();
        reader.map_err(|error| error.to_string())
    };
    let (width, height) = reader()?.into_dimensions().map_err(|error| error.to_string())?;
    check_texels(width.into(), height.into(), bytes.len())?;
    let image = reader()?.decode().map_err(|error| error.to_string())?;
    let size = [image.width(), image.height()];
    let pixels = image.into_rgba32f().pixels().map(|p| p.0).collect();
    Ok((size, pixels))
}

fn show_linear([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let encode = |v: f32| srgb::encode(f64::from(v)) as f32;
    [encode(r), encode(g), encode(b), a.clamp(0.0, 1.0)]
}

fn show_straight([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    // Decoding and encoding again would change the last bit of opaque colours.
    if a >= 1.0 {
        return [r, g, b, 1.0];
    }
    let over_black = |v: f32| srgb::encode(srgb::decode(f64::from(v)) * f64::from(a)) as f32;
    [over_black(r), over_black(g), over_black(b), a]
}

/// Whether a file begins like a PNG or a JPEG; false if it can't be read.
#[must_use]
pub fn is_image(path: &Path) -> bool {
    let mut start = [0; 3];
    let read = File::open(path).and_then(|mut file| file.read_exact(&mut start));
    read.is_ok() && (start == *b"\x89PN" || start == *b"\xff\xd8\xff")
}

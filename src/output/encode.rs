//! Encoding: from linear light to the bytes of an image file.

use super::{Aov, Format, OutputError, Picture, check_count, exr};
use crate::color::srgb;
use crate::sampling::MAX_SAMPLES;
use bytemuck::NoUninit;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use rayon::prelude::*;

const JPEG_QUALITY: u8 = 95;

/// Encodes a picture. AOVs become layers of an EXR; other formats leave them out.
///
/// # Errors
/// [`OutputError::PixelCount`] if an AOV has another size, [`OutputError::Encode`] if the format can't hold the
/// picture: a JPEG's sides are at most 65,535.
pub fn encode(format: Format, picture: &Picture<'_>, aovs: &[Aov]) -> Result<Vec<u8>, OutputError> {
    let size = picture.size();
    match format {
        Format::Png8 => encode_rgba(size, &codes(picture)),
        Format::Png16 => {
            let codes = straight_codes(picture, u16::MAX);
            png_rgba(size, &codes, u16::MAX, [ExtendedColorType::Rgb16, ExtendedColorType::Rgba16])
        }
        Format::Jpeg => jpeg(picture),
        Format::Exr => exr::encode(picture, aovs),
    }
}

/// Encodes an AOV of `size` = [width, height] as a PNG for viewing:
///
/// - depth: 16-bit grey, linear in distance, 65,535 at the nearest pixel, 1 at the furthest, 0 where nothing is
///   visible;
/// - id: a colour for each triangle, black where nothing is visible;
/// - normal: x, y and z from -1 to 1 as red, green and blue from 0 to 255, black where nothing is visible;
/// - superpixels: white for superpixels;
/// - samples: 16-bit grey, 65,535 for 1,024 samples.
///
/// # Errors
/// [`OutputError::PixelCount`] if the AOV does not have this size, [`OutputError::Encode`] if the encoder fails.
pub fn encode_aov(size: [u32; 2], aov: &Aov) -> Result<Vec<u8>, OutputError> {
    check_count(size, aov.len())?;
    let grey16 = |codes: Vec<u16>| png(size, bytemuck::cast_slice(&codes), ExtendedColorType::L16);
    match aov {
        Aov::Depth(depths) => grey16(depth_codes(depths)),
        Aov::Id(ids) => encode_rgb(size, &ids.iter().map(|id| id_color(*id)).collect::<Vec<_>>()),
        Aov::Normal(normals) => {
            let code = |v: f32| ((f64::from(v) * 0.5 + 0.5) * 255.0).round() as u8;
            let color = |normal: &[f32; 3]| match normal {
                [0.0, 0.0, 0.0] => [0; 3],
                normal => normal.map(code),
            };
            encode_rgb(size, &normals.iter().map(color).collect::<Vec<_>>())
        }
        Aov::Superpixels(flags) => {
            let codes: Vec<_> = flags.iter().map(|flag| u8::from(*flag) * u8::MAX).collect();
            png(size, &codes, ExtendedColorType::L8)
        }
        Aov::Samples(counts) => {
            let unit = f64::from(u16::MAX) / f64::from(MAX_SAMPLES);
            let code = |count: &u32| (f64::from(*count) * unit).round() as u16;
            grey16(counts.iter().map(code).collect())
        }
    }
}

/// Encodes sRGB colours as a PNG with 8 bits a channel; `size` is [width, height] in pixels.
///
/// # Errors
/// [`OutputError::PixelCount`] if the number of pixels is not width times height, [`OutputError::Encode`] if the
/// encoder fails.
pub fn encode_rgb(size: [u32; 2], pixels: &[[u8; 3]]) -> Result<Vec<u8>, OutputError> {
    check_count(size, pixels.len())?;
    png(size, pixels.as_flattened(), ExtendedColorType::Rgb8)
}

/// Encodes sRGB colours with straight alpha as a PNG with 8 bits a channel, without alpha if every pixel is opaque; `size` is
/// [width, height] in pixels.
///
/// # Errors
/// [`OutputError::PixelCount`] if the number of pixels is not width times height, [`OutputError::Encode`] if the
/// encoder fails.
pub fn encode_rgba(size: [u32; 2], pixels: &[[u8; 4]]) -> Result<Vec<u8>, OutputError> {
    check_count(size, pixels.len())?;
    png_rgba(size, pixels, u8::MAX, [ExtendedColorType::Rgb8, ExtendedColorType::Rgba8])
}

/// Encodes a value of 0 to 1 for each pixel as a 16-bit grey PNG: linear, with 65,535 for 1.
///
/// # Errors
/// [`OutputError::PixelCount`] if the number of values is not width times height, [`OutputError::Encode`] if the
/// encoder fails.
pub fn encode_shares(size: [u32; 2], shares: &[f32]) -> Result<Vec<u8>, OutputError> {
    check_count(size, shares.len())?;
    let code = |share: &f32| (share.clamp(0.0, 1.0) * f32::from(u16::MAX)).round() as u16;
    let codes: Vec<_> = shares.iter().map(code).collect();
    png(size, bytemuck::cast_slice(&codes), ExtendedColorType::L16)
}

/// Codes of 8 bits of sRGB colours and straight alpha, as PNG files hold them.
#[must_use]
pub fn codes(picture: &Picture<'_>) -> Vec<[u8; 4]> {
    straight_codes(picture, u8::MAX.into()).iter().map(|code| code.map(|c| c as u8)).collect()
}

/// Codes from 0 to `top` of sRGB colours and straight alpha.
fn straight_codes(picture: &Picture<'_>, top: u16) -> Vec<[u16; 4]> {
    let scale = f64::from(top);
    let code = |[r, g, b, a]: &[f32; 4]| {
        let alpha = f64::from(*a);
        let alpha_code = (alpha.clamp(0.0, 1.0) * scale).round() as u16;
        // The colour of a transparent pixel is set to 0: after division by a tiny alpha it would be arbitrary, and cost
        // bytes.
        let color = |premultiplied: f32| match alpha_code {
            0 => 0,
            _ => (srgb::encode(f64::from(premultiplied) / alpha) * scale).round() as u16,
        };
        [color(*r), color(*g), color(*b), alpha_code]
    };
    picture.pixels().par_iter().map(code).collect()
}

fn jpeg(picture: &Picture<'_>) -> Result<Vec<u8>, OutputError> {
    // A premultiplied colour equals the colour over black.
    let code = |[r, g, b, _]: &[f32; 4]| [*r, *g, *b].map(|v| srgb::encode_u8(f64::from(v)));
    let pixels: Vec<_> = picture.pixels().par_iter().map(code).collect();
    let [width, height] = picture.size();
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY)
        .write_image(pixels.as_flattened(), width, height, ExtendedColorType::Rgb8)
        .map_err(|error| OutputError::Encode(error.to_string()))?;
    Ok(bytes)
}

/// Encodes codes with straight alpha, without alpha if that of every pixel is `opaque`.
fn png_rgba<T: NoUninit + PartialEq + Sync>(
    size: [u32; 2],
    pixels: &[[T; 4]],
    opaque: T,
    [rgb, rgba]: [ExtendedColorType; 2],
) -> Result<Vec<u8>, OutputError> {
    if pixels.par_iter().any(|pixel| pixel[3] != opaque) {
        return png(size, bytemuck::cast_slice(pixels.as_flattened()), rgba);
    }
    let colors: Vec<_> = pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
    png(size, bytemuck::cast_slice(&colors), rgb)
}

fn png(size: [u32; 2], samples: &[u8], color: ExtendedColorType) -> Result<Vec<u8>, OutputError> {
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(samples, size[0], size[1], color)
        .map_err(|error| OutputError::Encode(error.to_string()))?;
    Ok(bytes)
}

fn depth_codes(depths: &[f32]) -> Vec<u16> {
    let finite = depths.iter().copied().filter(|depth| depth.is_finite());
    let (near, far) =
        finite.fold((f32::INFINITY, f32::NEG_INFINITY), |(near, far), depth| (near.min(depth), far.max(depth)));
    let [near, far] = [near, far].map(f64::from);
    let code = |depth: &f32| {
        if !depth.is_finite() {
            return 0;
        }
        let range = (far - near).max(f64::MIN_POSITIVE);
        let nearness = (far - f64::from(*depth)) / range;
        (1.0 + nearness * f64::from(u16::MAX - 1)).round() as u16
    };
    depths.iter().map(code).collect()
}

/// Colour for a triangle's ID; neighbouring IDs get clearly different colours.
fn id_color(id: u32) -> [u8; 3] {
    if id == 0 {
        return [0; 3];
    }
    // The finalizer of MurmurHash3 spreads every bit of the ID over the word.
    let mut hash = id;
    hash = (hash ^ (hash >> 16)).wrapping_mul(0x85eb_ca6b);
    hash = (hash ^ (hash >> 13)).wrapping_mul(0xc2b2_ae35);
    hash ^= hash >> 16;
    // Black is reserved for the background.
    [hash, hash >> 8, hash >> 16].map(|bits| (bits as u8) | 0x20)
}

//! Painted textures.

use image::{ExtendedColorType, ImageEncoder, codecs::png};

/// Paints a square picture and encodes it as PNG. `paint` gets the centre of a texel, in coordinates of 0 to 1 with
/// rows from the top.
pub fn paint(size: u32, paint: impl Fn(f64, f64) -> [u8; 4]) -> Vec<u8> {
    let mut pixels = Vec::with_capacity(4 * (size * size) as usize);
    let centre = |i: u32| (f64::from(i) + 0.5) / f64::from(size);
    for y in 0..size {
        for x in 0..size {
            pixels.extend(paint(centre(x), centre(y)));
        }
    }
    let mut bytes = Vec::new();
    png::PngEncoder::new_with_quality(&mut bytes, png::CompressionType::Best, png::FilterType::Adaptive)
        .write_image(&pixels, size, size, ExtendedColorType::Rgba8)
        .expect("writing to memory succeeds");
    bytes
}

/// Coverage of a texel whose centre has the signed `distance` (negative inside) from an edge: 0 half a texel outside,
/// 1 half a texel inside.
pub fn coverage(distance: f64, size: u32) -> f64 {
    (0.5 - distance * f64::from(size)).clamp(0.0, 1.0)
}

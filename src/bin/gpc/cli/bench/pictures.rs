//! Small pictures, enlarged parts of images, and error maps.

use anyhow::Context;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gpc::compare::heat_color;
use gpc::output::{self, DecodedImage};
use image::codecs::jpeg::JpegEncoder;
use image::{RgbImage, imageops};
use std::ops::Range;

/// Largest width of small pictures in pixels.
const SMALL: u32 = 480;
const JPEG_QUALITY: u8 = 80;
/// Largest width and height of a window in pixels.
const WINDOW: [usize; 2] = [48, 30];
/// Distance in pixels between the places at which a window is tried.
const STRIDE: usize = 6;
/// The error that maps show brightest, in sRGB-encoded values of 0 to 1.
pub const BRIGHTEST: f32 = 0.25;

/// The root of the mean squared error of each pixel, in sRGB-encoded values of 0 to 1.
pub struct ErrorMap {
    size: [usize; 2],
    errors: Vec<f32>,
}

/// A rectangular part of an image, in pixels.
#[derive(Clone, Copy)]
pub struct CropBox {
    /// Upper left pixel.
    pub low: [usize; 2],
    pub size: [usize; 2],
}

/// An image's colours, RGB of 0 to 1.
pub fn colors(image: &DecodedImage) -> Vec<[f32; 3]> {
    image.pixels.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect()
}

impl ErrorMap {
    /// The errors of an image that has the reference's size.
    pub fn new(reference: &DecodedImage, image: &DecodedImage) -> Self {
        let error = |(a, b): (&[f32; 4], &[f32; 4])| {
            let squares = a.iter().zip(b).take(3).map(|(a, b)| (a - b).powi(2));
            (squares.sum::<f32>() / 3.0).sqrt()
        };
        Self {
            size: reference.size.map(|side| side as usize),
            errors: reference.pixels.iter().zip(&image.pixels).map(error).collect(),
        }
    }

    /// Colours of the errors, from black (none) through purple and orange to light yellow ([`BRIGHTEST`] and above).
    /// The scale is linear in the square root of the error, because most errors are small.
    pub fn colors(&self) -> Vec<[f32; 3]> {
        let color = |error: &f32| {
            let share = (error / BRIGHTEST).clamp(0.0, 1.0).sqrt();
            heat_color(share).map(|code| f32::from(code) / 255.0)
        };
        self.errors.iter().map(color).collect()
    }

    /// The index and squared error of each pixel in a window.
    pub fn squares(&self, window: CropBox) -> impl Iterator<Item = (usize, f64)> + '_ {
        let pixels = window.rows(self.size[0]).flatten();
        pixels.filter_map(|pixel| Some((pixel, f64::from(*self.errors.get(pixel)?).powi(2))))
    }

    /// The window with the largest sum of squared errors.
    pub fn worst_window(&self) -> CropBox {
        let [width, height] = self.size;
        let size = [WINDOW[0].min(width), WINDOW[1].min(height)];
        let mut worst = (f32::NEG_INFINITY, [0, 0]);
        for y in (0..=height - size[1]).step_by(STRIDE) {
            for x in (0..=width - size[0]).step_by(STRIDE) {
                let window = CropBox { low: [x, y], size };
                let sum: f32 = window
                    .rows(width)
                    .filter_map(|row| self.errors.get(row))
                    .flatten()
                    .map(|error| error * error)
                    .sum();
                if sum > worst.0 {
                    worst = (sum, [x, y]);
                }
            }
        }
        CropBox { low: worst.1, size }
    }
}

impl CropBox {
    /// Index ranges of the window's rows, in an image of this width.
    fn rows(self, width: usize) -> impl Iterator<Item = Range<usize>> {
        let [x, y] = self.low;
        (y..y + self.size[1]).map(move |y| y * width + x..y * width + x + self.size[0])
    }

    /// The window's part of an image, as a PNG.
    pub fn png(self, size: [u32; 2], colors: &[[f32; 3]]) -> anyhow::Result<String> {
        let pixels: Vec<_> = self
            .rows(size[0] as usize)
            .filter_map(|row| colors.get(row))
            .flatten()
            .map(|color| codes(*color))
            .collect();
        let bytes = output::encode_rgb(self.size.map(|side| side as u32), &pixels)?;
        Ok(data_uri("png", &bytes))
    }
}

/// A JPEG of an image, scaled down by a whole number.
pub fn small_jpeg([width, height]: [u32; 2], colors: &[[f32; 3]]) -> anyhow::Result<String> {
    let whole = RgbImage::from_raw(width, height, colors.iter().flat_map(|color| codes(*color)).collect());
    let whole = whole.context("a picture of the report has another size than its image")?;
    let step = width.div_ceil(SMALL).min(height).max(1);
    let mut file = Vec::new();
    imageops::thumbnail(&whole, width / step, height / step)
        .write_with_encoder(JpegEncoder::new_with_quality(&mut file, JPEG_QUALITY))
        .context("a picture of the report can't be encoded")?;
    Ok(data_uri("jpeg", &file))
}

fn codes(color: [f32; 3]) -> [u8; 3] {
    color.map(|value| (255.0 * value).round() as u8)
}

fn data_uri(format: &str, bytes: &[u8]) -> String {
    format!("data:image/{format};base64,{}", STANDARD.encode(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_window_holds_the_worst_pixels() {
        let size = [200, 100];
        let black = DecodedImage { size, pixels: vec![[0.0, 0.0, 0.0, 1.0]; 20_000] };
        let mut image = black.clone();
        for (x, y) in [(10, 10), (150, 70), (151, 71)] {
            image.pixels[y * 200 + x] = [0.5; 4];
        }
        let CropBox { low, size } = ErrorMap::new(&black, &image).worst_window();
        assert!((low[0]..low[0] + size[0]).contains(&150), "{low:?}");
        assert!((low[1]..low[1] + size[1]).contains(&71), "{low:?}");
    }

    #[test]
    fn a_window_is_no_larger_than_its_image() {
        let tiny = DecodedImage { size: [7, 1], pixels: vec![[0.0; 4]; 7] };
        let window = ErrorMap::new(&tiny, &tiny).worst_window();
        assert_eq!((window.low, window.size), ([0, 0], [7, 1]));
        assert!(small_jpeg([7, 1], &colors(&tiny)).is_ok());
    }
}

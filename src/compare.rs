//! Differences between two images.
//!
//! The images are compared as a display shows them (see [`DecodedImage`]): sRGB-encoded, over black. Alpha counts as a
//! fourth channel if either image has a pixel that is not opaque, and is left out otherwise, so that the numbers of
//! opaque images are those of RGB.

use crate::output::DecodedImage;
use nv_flip::{FlipImageRgb8, FlipPool};
use serde::Serialize;
use std::sync::LazyLock;

/// Differences between an image and a reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Root mean squared difference over all pixels and channels, 0 to 1.
    pub rmse: f64,
    /// Peak signal-to-noise ratio in decibels; `None` (infinite) for identical images.
    pub psnr: Option<f64>,
    /// Largest difference of any channel of any pixel, 0 to 1.
    pub max: f64,
    /// Number of pixels of which a channel differs by more than 2 codes of 8 bits.
    pub over_2: u64,
    /// Number of pixels of which a channel differs by more than 8 codes of 8 bits.
    pub over_8: u64,
    /// Mean of the FLIP error map (Andersson et al., HPG 2020) of the colours in 8 bits, 0 to 1.
    pub flip: f64,
}

/// Error: a pair of images that can't be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// Images of different sizes.
    #[error("the images differ in size: {} x {} and {} x {} pixels", .first[0], .first[1], .second[0], .second[1])]
    Size {
        /// Width and height of the first image.
        first: [u32; 2],
        /// Width and height of the second image.
        second: [u32; 2],
    },
}

/// Compares an image with a reference.
///
/// # Errors
/// [`CompareError::Size`] if their sizes differ.
pub fn compare(reference: &DecodedImage, image: &DecodedImage) -> Result<Comparison, CompareError> {
    check_size(reference, image)?;
    let opaque = |image: &DecodedImage| image.pixels.iter().all(|pixel| pixel[3] >= 1.0);
    let channels = if opaque(reference) && opaque(image) { 3 } else { 4 };
    let (mut sum, mut max) = (0.0_f64, 0.0_f64);
    let (mut over_2, mut over_8) = (0, 0);
    for (a, b) in reference.pixels.iter().zip(&image.pixels) {
        let mut most = 0.0_f64;
        for (a, b) in a.iter().zip(b).take(channels) {
            let difference = (f64::from(*a) - f64::from(*b)).abs();
            sum += difference * difference;
            most = most.max(difference);
        }
        max = max.max(most);
        over_2 += u64::from(most > codes(2.0));
        over_8 += u64::from(most > codes(8.0));
    }
    let rmse = (sum / (reference.pixels.len() * channels) as f64).sqrt();
    let flip = FlipPool::from_image(&error_map(reference, image)).mean();
    Ok(Comparison {
        rmse,
        psnr: (rmse > 0.0).then(|| -20.0 * rmse.log10()),
        max,
        over_2,
        over_8,
        flip: f64::from(flip),
    })
}

/// Colour of a value on a scale from black at 0 through purple and orange to light yellow at 1, as sRGB codes. Values
/// outside of the scale get the colour of the nearer end.
#[must_use]
pub fn heat_color(share: f32) -> [u8; 3] {
    static PALETTE: LazyLock<Vec<[u8; 3]>> =
        LazyLock::new(|| nv_flip::magma_lut().to_vec().as_chunks::<3>().0.to_vec());
    let top = PALETTE.len().saturating_sub(1);
    let index = (share.clamp(0.0, 1.0) * top as f32).round() as usize;
    PALETTE.get(index).copied().unwrap_or_default()
}

/// FLIP error map as an image: sRGB codes from black through purple and orange to light yellow, FLIP's own scale.
/// Pixels whose alpha differs by more than FLIP's error show the difference of alpha.
///
/// # Errors
/// [`CompareError::Size`] if the sizes differ.
pub fn heatmap(reference: &DecodedImage, image: &DecodedImage) -> Result<Vec<[u8; 3]>, CompareError> {
    check_size(reference, image)?;
    let errors = error_map(reference, image).to_vec();
    let alphas = reference.pixels.iter().zip(&image.pixels);
    Ok(errors.iter().zip(alphas).map(|(error, (a, b))| heat_color(error.max((a[3] - b[3]).abs()))).collect())
}

/// Difference of channels that is above `count` codes of 8 bits, apart from the rounding of decoded codes.
fn codes(count: f64) -> f64 {
    (count + 1e-3) / 255.0
}

fn check_size(first: &DecodedImage, second: &DecodedImage) -> Result<(), CompareError> {
    if first.size == second.size {
        return Ok(());
    }
    Err(CompareError::Size { first: first.size, second: second.size })
}

fn error_map(reference: &DecodedImage, image: &DecodedImage) -> nv_flip::FlipImageFloat {
    let bytes = |image: &DecodedImage| {
        let code = |v: f32| (v * 255.0).round() as u8;
        let colors: Vec<_> = image.pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b].map(code)).collect();
        FlipImageRgb8::with_data(image.size[0], image.size[1], &colors)
    };
    nv_flip::flip(bytes(reference), bytes(image), nv_flip::DEFAULT_PIXELS_PER_DEGREE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_is_lighter() {
        let light = |share| {
            let channels = heat_color(share).map(u32::from);
            channels.iter().sum::<u32>()
        };
        let lights: Vec<_> = (0..=8_u8).map(|eighth| light(f32::from(eighth) / 8.0)).collect();
        assert!(lights.is_sorted() && lights[0] < 30 && lights[8] > 500, "{lights:?}");
        assert_eq!((heat_color(-1.0), heat_color(7.0)), (heat_color(0.0), heat_color(1.0)));
    }
}

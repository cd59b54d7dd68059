//! Accuracy of images: their distance from the reference.

use gpc::compare::{CompareError, compare};
use gpc::output::{DecodedImage, Picture};
use serde::Serialize;

/// Distance of an image from the reference. Only colours are compared: the images are opaque.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Accuracy {
    /// Root mean squared difference of the linear values, 0 to 1.
    pub rmse_linear: f64,
    /// Peak signal-to-noise ratio of the linear values in decibels; `None` (infinite) for identical images.
    pub psnr_linear: Option<f64>,
    /// Root mean squared difference of the sRGB-encoded values, 0 to 1.
    pub rmse: f64,
    /// Peak signal-to-noise ratio of the sRGB-encoded values in decibels; `None` (infinite) for identical images.
    pub psnr: Option<f64>,
    /// Largest difference of any sRGB-encoded value, 0 to 1.
    pub max: f64,
    /// Mean of the FLIP error map, 0 to 1.
    pub flip: f64,
    /// Share of the aliasing error that is removed: 1 - MSE / MSE1, of sRGB-encoded values, where MSE1 is the error of
    /// one sample a pixel. The share is negative for an image worse than one sample a pixel, and 1 if one sample a
    /// pixel has no error.
    pub removed: f64,
    /// Share of the pixels that were changed needlessly: one sample differs from the reference by less than 1/255 in
    /// every channel, and the image differs by more in some channel.
    pub needless: f64,
}

/// Reference, and the image of one sample a pixel, with which all images are compared.
#[derive(Clone, Debug)]
pub struct Yardstick {
    linear: Vec<[f32; 4]>,
    shown: DecodedImage,
    one_sample: DecodedImage,
    one_sample_mse: f64,
}

impl Yardstick {
    /// Takes the reference and the image of one sample a pixel, both opaque.
    ///
    /// # Errors
    /// [`CompareError::Size`] if their sizes differ.
    pub fn new(reference: &Picture<'_>, one_sample: &Picture<'_>) -> Result<Self, CompareError> {
        let shown = DecodedImage::from(reference);
        let one_sample = DecodedImage::from(one_sample);
        let distance = compare(&shown, &one_sample)?;
        Ok(Self {
            linear: reference.pixels().to_vec(),
            shown,
            one_sample,
            one_sample_mse: distance.rmse * distance.rmse,
        })
    }

    /// Reference as a display shows it.
    pub fn reference(&self) -> &DecodedImage {
        &self.shown
    }

    /// Image of one sample a pixel as a display shows it.
    pub fn one_sample(&self) -> &DecodedImage {
        &self.one_sample
    }

    /// Measures the accuracy of an image.
    ///
    /// # Errors
    /// [`CompareError::Size`] if its size is not the reference's.
    pub fn measure(&self, picture: &Picture<'_>) -> Result<Accuracy, CompareError> {
        let image = DecodedImage::from(picture);
        let distance = compare(&self.shown, &image)?;
        let rmse_linear = rmse(&self.linear, picture.pixels());
        let mse = distance.rmse * distance.rmse;
        let removed = if self.one_sample_mse > 0.0 {
            1.0 - mse / self.one_sample_mse
        } else if mse > 0.0 {
            0.0
        } else {
            1.0
        };
        Ok(Accuracy {
            rmse_linear,
            psnr_linear: (rmse_linear > 0.0).then(|| -20.0 * rmse_linear.log10()),
            rmse: distance.rmse,
            psnr: distance.psnr,
            max: distance.max,
            flip: distance.flip,
            removed,
            needless: self.needless(&image),
        })
    }

    /// Squared error of each pixel, as a share of the squared error of one sample a pixel, of sRGB-encoded colours; all zero
    /// if that has no error.
    pub(super) fn shares(&self, picture: &Picture<'_>) -> Result<Vec<f64>, CompareError> {
        let whole: f64 = squares(&self.shown, &self.one_sample)?.iter().sum();
        let share = |square| if whole > 0.0 { square / whole } else { 0.0 };
        Ok(squares(&self.shown, &DecodedImage::from(picture))?.into_iter().map(share).collect())
    }

    fn needless(&self, image: &DecodedImage) -> f64 {
        const STEP: f32 = 1.0 / 255.0;
        let apart = |a: &[f32; 4], b: &[f32; 4]| {
            let differences = a.iter().zip(b).take(3).map(|(a, b)| (a - b).abs());
            differences.fold(0.0, f32::max)
        };
        let triples = self.shown.pixels.iter().zip(&self.one_sample.pixels).zip(&image.pixels);
        let count =
            triples.filter(|((wanted, one), found)| apart(wanted, one) < STEP && apart(found, one) > STEP).count();
        count as f64 / self.shown.pixels.len() as f64
    }
}

/// Squared error of each pixel, summed over its colours.
///
/// # Errors
/// [`CompareError::Size`] if the sizes differ.
pub(super) fn squares(reference: &DecodedImage, image: &DecodedImage) -> Result<Vec<f64>, CompareError> {
    let errors = differences(reference, image)?;
    let square = |errors: [f64; 3]| errors.iter().map(|error| error * error).sum();
    Ok(errors.into_iter().map(square).collect())
}

/// Difference of each pixel's colours from the reference's: image - reference.
///
/// # Errors
/// [`CompareError::Size`] if the sizes differ.
pub(super) fn differences(reference: &DecodedImage, image: &DecodedImage) -> Result<Vec<[f64; 3]>, CompareError> {
    if reference.size != image.size {
        return Err(CompareError::Size { first: reference.size, second: image.size });
    }
    let difference =
        |(a, b): (&[f32; 4], &[f32; 4])| [0, 1, 2].map(|channel| f64::from(b[channel]) - f64::from(a[channel]));
    let pairs = reference.pixels.iter().zip(&image.pixels);
    Ok(pairs.map(difference).collect())
}

fn rmse(a: &[[f32; 4]], b: &[[f32; 4]]) -> f64 {
    let sum: f64 = a
        .iter()
        .zip(b)
        .flat_map(|(a, b)| a.iter().zip(b).take(3))
        .map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2))
        .sum();
    (sum / (3 * a.len()) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::color::srgb;

    fn grey(codes: [f64; 4]) -> Vec<[f32; 4]> {
        codes
            .iter()
            .map(|code| {
                let value = srgb::decode(code / 255.0) as f32;
                [value, value, value, 1.0]
            })
            .collect()
    }

    fn measure(reference: [f64; 4], one: [f64; 4], image: [f64; 4]) -> Accuracy {
        let (reference, one, image) = (grey(reference), grey(one), grey(image));
        let picture = |pixels| Picture::new([2, 2], pixels).unwrap();
        Yardstick::new(&picture(&reference), &picture(&one)).unwrap().measure(&picture(&image)).unwrap()
    }

    #[test]
    fn half_of_the_error_is_three_quarters_of_its_square() {
        let found = measure([100.0; 4], [110.0; 4], [105.0; 4]);
        assert!((found.removed - 0.75).abs() < 1e-6, "{found:?}");
        assert!((found.rmse - 5.0 / 255.0).abs() < 1e-6, "{found:?}");
        assert!((found.max - 5.0 / 255.0).abs() < 1e-6, "{found:?}");
        let linear = srgb::decode(105.0 / 255.0) - srgb::decode(100.0 / 255.0);
        assert!((found.rmse_linear - linear).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn only_pixels_that_were_right_can_be_changed_needlessly() {
        // The pixels are: correct and unchanged, correct and changed, correct and changed by less than one code, wrong
        // and changed.
        let reference = [100.0, 100.0, 100.0, 150.0];
        let one = [100.5, 100.0, 100.0, 100.0];
        let image = [100.5, 104.0, 100.9, 150.0];
        assert_eq!(measure(reference, one, image).needless, 0.25);
    }

    #[test]
    fn the_reference_itself_has_no_error() {
        let found = measure([9.0; 4], [8.0; 4], [9.0; 4]);
        assert_eq!((found.rmse, found.psnr, found.removed), (0.0, None, 1.0));
        assert_eq!((found.rmse_linear, found.psnr_linear), (0.0, None));
    }
}

//! Resampling of photographs, in linear light.
//!
//! Only the photograph's pixels are known of its scene, so the values between them are reconstructed. Cubic
//! convolution by Catmull and Rom interpolates them (R. Keys, "Cubic convolution interpolation for digital image
//! processing", IEEE TASSP 29(6), 1981, with a = -1/2). Where the output is coarser than the photograph, the
//! reconstruction is averaged over the area of the output pixel (the prefilter), to prevent aliasing.

mod footprint;
mod wall;
mod zoomed;

pub use wall::light_on_wall;
pub use zoomed::{Zoomed, ZoomedError, zoomed_location};

use crate::color::srgb;
use crate::output::{DecodedImage, Picture};
use footprint::SampleGrid;
use glam::{DMat2, DVec2};
use rayon::prelude::*;

/// Photograph that can be sampled between its pixels: linear light, premultiplied alpha.
#[derive(Clone, Debug, PartialEq)]
pub struct Photograph {
    size: [u32; 2],
    pixels: Vec<[f32; 4]>,
}

impl From<&DecodedImage> for Photograph {
    fn from(image: &DecodedImage) -> Self {
        let linear = |v: f32| srgb::decode(f64::from(v)) as f32;
        let pixel = |[r, g, b, a]: &[f32; 4]| [linear(*r), linear(*g), linear(*b), *a];
        Self { size: image.size, pixels: image.pixels.par_iter().map(pixel).collect() }
    }
}

impl From<&Picture<'_>> for Photograph {
    fn from(picture: &Picture<'_>) -> Self {
        Self { size: picture.size(), pixels: picture.pixels().to_vec() }
    }
}

impl Photograph {
    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// RGBA in linear light with premultiplied alpha, rows from the top.
    #[must_use]
    pub fn pixels(&self) -> &[[f32; 4]] {
        &self.pixels
    }

    /// Colour at the location `uv`, filtered for an output pixel. `jacobian` = [change of the location per output
    /// column, per output row]. Locations are in pixels of the photograph, whose upper left corner is (0, 0). Beyond
    /// the photograph its border pixels are repeated.
    ///
    /// At the centre of a pixel, and at a scale of one pixel or less per output pixel, the result is the pixel itself.
    /// Footprints more than 64 pixels wide are averaged with gaps.
    #[must_use]
    pub fn sample(&self, uv: DVec2, jacobian: DMat2) -> [f32; 4] {
        let footprint = SampleGrid::new(jacobian);
        let mut sum = [0.0; 4];
        for offset in footprint.offsets() {
            for (sum, value) in sum.iter_mut().zip(self.interpolate(uv + offset)) {
                *sum += value;
            }
        }
        let [r, g, b, a] = sum.map(|sum| (sum / footprint.count()).max(0.0) as f32);
        [r, g, b, a.min(1.0)]
    }

    /// Resamples the photograph to an image of `size` = [width, height]. For the centre of each output pixel, in
    /// pixels of the output, `look` returns the location in the photograph and its Jacobian, both as [`Self::sample`]
    /// takes them.
    #[must_use]
    pub fn resample(&self, size: [u32; 2], look: impl Fn(DVec2) -> (DVec2, DMat2) + Sync) -> Vec<[f32; 4]> {
        pixels(size, |place| {
            let (uv, jacobian) = look(place);
            self.sample(uv, jacobian)
        })
    }

    /// Cubic convolution of the 4 x 4 pixels around a location.
    fn interpolate(&self, uv: DVec2) -> [f64; 4] {
        let from_first = uv - DVec2::splat(0.5);
        let base = from_first.floor();
        let [x, y] = (from_first - base).to_array().map(weights);
        let mut sum = [0.0; 4];
        for (row, down) in y.into_iter().enumerate() {
            for (col, along) in x.into_iter().enumerate() {
                let pixel = self.pixel(base.x + col as f64 - 1.0, base.y + row as f64 - 1.0);
                for (sum, value) in sum.iter_mut().zip(pixel) {
                    *sum += down * along * f64::from(value);
                }
            }
        }
        sum
    }

    /// Pixel nearest to a column and row; beyond the photograph, its border pixel.
    fn pixel(&self, column: f64, row: f64) -> [f32; 4] {
        let [width, height] = self.size;
        let column = column.clamp(0.0, f64::from(width - 1)) as usize;
        let row = row.clamp(0.0, f64::from(height - 1)) as usize;
        let index = row * width as usize + column;
        self.pixels.get(index).copied().unwrap_or_default()
    }
}

/// Colours of the pixels of an image of `size` = [width, height], rows from the top; `color` makes that of a pixel's centre.
fn pixels(size: [u32; 2], color: impl Fn(DVec2) -> [f32; 4] + Sync) -> Vec<[f32; 4]> {
    let row = |row: u32| {
        let color = &color;
        (0..size[0]).into_par_iter().map(move |col| color(DVec2::new(f64::from(col) + 0.5, f64::from(row) + 0.5)))
    };
    (0..size[1]).into_par_iter().flat_map(row).collect()
}

/// Weights of four values at -1, 0, 1 and 2 for a place `t` from 0 to 1.
fn weights(t: f64) -> [f64; 4] {
    [
        t * (t * (1.0 - 0.5 * t) - 0.5),
        1.0 + t * t * (1.5 * t - 2.5),
        t * (t * (2.0 - 1.5 * t) + 0.5),
        t * t * (0.5 * t - 0.5),
    ]
}

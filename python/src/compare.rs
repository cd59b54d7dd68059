//! Differences between two images.

use crate::error;
use crate::pixels::Shown;
use gpc::compare as images;
use pyo3::prelude::*;

/// Differences between an image and a reference, as a display shows them.
#[pyclass(frozen, get_all, module = "gpc")]
pub struct Comparison {
    /// Root mean squared difference over all pixels and channels, 0 to 1.
    rmse: f64,
    /// Peak signal-to-noise ratio in decibels; infinite for identical images.
    psnr: f64,
    /// Largest difference of any channel of any pixel, 0 to 1.
    max: f64,
    /// Mean of the FLIP error map, 0 to 1.
    flip: f64,
    /// Number of pixels of which a channel differs by more than 2 codes of 8 bits.
    over_2: u64,
    /// Number of pixels of which a channel differs by more than 8 codes of 8 bits.
    over_8: u64,
}

#[pymethods]
impl Comparison {
    fn __repr__(&self) -> String {
        format!("Comparison(rmse={:.6}, psnr={:.2}, max={:.4}, flip={:.6})", self.rmse, self.psnr, self.max, self.flip)
    }
}

/// Compares an image with a reference of the same size. Each is the path of a PNG, JPEG or EXR file, or an array (height, width, 3
/// or 4): uint8 has sRGB codes with straight alpha, float32 linear light with premultiplied alpha.
#[pyfunction]
pub fn compare(py: Python<'_>, reference: Shown, image: Shown) -> PyResult<Comparison> {
    let (reference, image) = (reference.decode()?, image.decode()?);
    let found = py.detach(|| images::compare(&reference, &image)).map_err(error::usage)?;
    Ok(Comparison {
        rmse: found.rmse,
        psnr: found.psnr.unwrap_or(f64::INFINITY),
        max: found.max,
        flip: found.flip,
        over_2: found.over_2,
        over_8: found.over_8,
    })
}

//! Images between Rust and NumPy.

use crate::error;
use gpc::output::{self, DecodedImage, Picture};
use gpc::render::PixelAttributes;
use numpy::{Element, IntoPyArray, PyArrayMethods, PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;
use std::path::PathBuf;

/// An image as Python gives it: a file, sRGB codes, or linear light.
#[derive(FromPyObject)]
pub enum Shown<'py> {
    Codes(PyReadonlyArray3<'py, u8>),
    Light(PyReadonlyArray3<'py, f32>),
    File(PathBuf),
}

impl Shown<'_> {
    /// The image as a display shows it.
    pub fn decode(&self) -> PyResult<DecodedImage> {
        match self {
            Self::File(path) => output::read(path).map_err(|error| error::GpcError::new_err(error.to_string())),
            Self::Codes(codes) => {
                let (size, pixels) = rgba(codes, 255)?;
                DecodedImage::from_codes(size, &pixels).map_err(error::usage)
            }
            Self::Light(light) => {
                let (size, pixels) = rgba(light, 1.0)?;
                Ok((&Picture::new(size, &pixels).map_err(error::usage)?).into())
            }
        }
    }
}

/// Size and pixels of an array (height, width, 3 or 4). `opaque` is the alpha of pixels without one.
pub fn rgba<T: Element + Copy>(array: &PyReadonlyArray3<'_, T>, opaque: T) -> PyResult<([u32; 2], Vec<[T; 4]>)> {
    let &[height, width, channels] = array.shape() else {
        return Err(error::usage("an image is an array of shape (height, width, 3 or 4)"));
    };
    if !(3..=4).contains(&channels) || width == 0 || height == 0 {
        return Err(error::usage(format!(
            "an image is an array of shape (height, width, 3 or 4), not ({height}, {width}, {channels})"
        )));
    }
    let values: Vec<T> = array.as_array().iter().copied().collect();
    let pixel = |pixel: &[T]| [pixel[0], pixel[1], pixel[2], pixel.get(3).copied().unwrap_or(opaque)];
    let pixels = values.chunks_exact(channels).map(pixel).collect();
    Ok(([width as u32, height as u32], pixels))
}

/// Array of shape `shape` + (N,) of values of N numbers.
pub fn array<'py, T: Element, const N: usize>(
    py: Python<'py>,
    shape: &[usize],
    values: Vec<[T; N]>,
) -> PyResult<Bound<'py, PyAny>> {
    let shape: Vec<usize> = shape.iter().copied().chain([N]).collect();
    Ok(values.into_flattened().into_pyarray(py).reshape(shape)?.into_any())
}

/// Array of shape `shape` of single numbers.
fn plane<'py, T: Element>(py: Python<'py>, shape: &[usize], values: Vec<T>) -> PyResult<Bound<'py, PyAny>> {
    Ok(values.into_pyarray(py).reshape(shape.to_vec())?.into_any())
}

/// What an image has besides its colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    Depth,
    Id,
    Normal,
    Samples,
    Superpixel,
}

impl Layer {
    const ALL: [(&'static str, Self); 5] = [
        ("depth", Self::Depth),
        ("id", Self::Id),
        ("normal", Self::Normal),
        ("samples", Self::Samples),
        ("superpixel", Self::Superpixel),
    ];

    /// The layer with this name.
    pub fn named(name: &str) -> PyResult<Self> {
        let found = Self::ALL.into_iter().find(|(known, _)| *known == name);
        found.map(|(_, layer)| layer).ok_or_else(|| {
            let known = Self::ALL.map(|(known, _)| known).join(", ");
            error::usage(format!(
                "there is no layer \"{name}\"; there are {known}. Coverage is the alpha of the colours"
            ))
        })
    }

    /// Name of the layer.
    pub fn name(self) -> &'static str {
        Self::ALL.into_iter().find(|(_, layer)| *layer == self).map_or("", |(name, _)| name)
    }

    /// The layer as an array of shape `shape`, and for normals (3,) more.
    pub fn array<'py>(
        self,
        py: Python<'py>,
        shape: &[usize],
        attributes: &[PixelAttributes],
    ) -> PyResult<Bound<'py, PyAny>> {
        match self {
            Self::Depth => plane(py, shape, attributes.iter().map(|a| a.depth).collect()),
            Self::Id => plane(py, shape, attributes.iter().map(|a| a.id).collect()),
            Self::Samples => plane(py, shape, attributes.iter().map(|a| a.samples).collect()),
            Self::Superpixel => plane(py, shape, attributes.iter().map(|a| a.superpixel != 0).collect::<Vec<bool>>()),
            Self::Normal => array(py, shape, attributes.iter().map(|a| a.normal).collect()),
        }
    }
}

//! Keyword arguments that all ways of making an image have in common.

use crate::error;
use crate::pixels::Layer;
use clap::ValueEnum;
use gpc::render::{MethodKind, PixelRect, SceneSettings, Settings, Shading, Shadows};
use gpc::sampling::{FilterShape, PixelFilter};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Type of the numbers of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Linear light with premultiplied alpha.
    Float32,
    /// sRGB codes with straight alpha.
    Uint8,
}

/// An image that is asked for.
pub struct Request {
    pub settings: Settings,
    pub kind: Kind,
    pub layers: Vec<Layer>,
}

const KNOWN: &str = "samples, method, filter, filter_radius, contrast, shading, background, exposure, region, line_width, point_size, dtype, layers";

impl Request {
    /// Reads the keyword arguments `options` for an image of `size` = (width, height).
    pub fn new(
        size: [u32; 2],
        options: Option<&Bound<'_, PyDict>>,
        shadows: bool,
        max_memory: Option<u64>,
    ) -> PyResult<Self> {
        let (mut method, mut samples) = (MethodKind::Superpixel, None);
        let (mut contrast, mut shading, mut region) = (None, None, None);
        let (mut filter, mut radius) = (FilterShape::Box, None);
        let (mut kind, mut layers) = (Kind::Float32, Vec::new());
        let mut scene = SceneSettings::default().max_memory(max_memory);
        if shadows {
            scene = scene.shadows(Shadows::Exact);
        }
        for (name, value) in options.into_iter().flatten() {
            let name: String = name.extract()?;
            match name.as_str() {
                "samples" => samples = Some(value.extract()?),
                "method" => method = choice(&name, &value)?,
                "filter" => filter = choice(&name, &value)?,
                "filter_radius" => radius = value.extract()?,
                "contrast" => contrast = value.extract()?,
                "shading" => shading = Some(choice::<Shading>(&name, &value)?),
                "background" => scene = scene.background(value.extract()?),
                "exposure" => scene = scene.exposure(value.extract()?),
                "region" => region = value.extract::<Option<[u32; 4]>>()?,
                "line_width" => scene = scene.line_width(value.extract()?),
                "point_size" => scene = scene.point_size(value.extract()?),
                "dtype" => kind = dtype(&value)?,
                "layers" => {
                    let names: Vec<String> = value.extract()?;
                    layers = names.iter().map(|name| Layer::named(name)).collect::<PyResult<_>>()?;
                }
                _ => {
                    return Err(PyTypeError::new_err(format!(
                        "unexpected keyword argument '{name}'; known are {KNOWN}"
                    )));
                }
            }
        }
        let default = if method == MethodKind::Msaa { 4 } else { 64 };
        let mut settings =
            Settings::new(size[0], size[1]).method(method.with_samples(samples.unwrap_or(default))).scene(scene);
        settings = settings.pixel_filter(PixelFilter::new(filter, radius));
        if contrast.is_some() {
            settings = settings.map_superpixels(|options| options.contrast(contrast));
        }
        if let Some(shading) = shading {
            settings = settings.map_superpixels(|options| options.shading(shading));
        }
        let region = region.map(|[x, y, width, height]| PixelRect { corner: [x, y], size: [width, height] });
        let settings = settings.region(region).attributes(!layers.is_empty());
        Ok(Self { settings, kind, layers })
    }
}

/// A value of an enumeration by its name in the command.
pub fn choice<T: ValueEnum>(name: &str, value: &Bound<'_, PyAny>) -> PyResult<T> {
    named(name, &value.extract::<String>()?)
}

/// A value of an enumeration by its name in the command.
pub fn named<T: ValueEnum>(argument: &str, name: &str) -> PyResult<T> {
    T::from_str(name, false).map_err(|_| {
        let known = T::value_variants().iter().filter_map(ValueEnum::to_possible_value);
        let known: Vec<_> = known.map(|value| value.get_name().to_owned()).collect();
        error::usage(format!("{argument}=\"{name}\": it must be one of {}", known.join(", ")))
    })
}

/// The kind of a NumPy type, or of its name.
fn dtype(value: &Bound<'_, PyAny>) -> PyResult<Kind> {
    let name = match value.getattr("__name__") {
        Ok(name) => name.extract::<String>()?,
        Err(_) => value.str()?.extract()?,
    };
    match name.as_str() {
        "float32" => Ok(Kind::Float32),
        "uint8" => Ok(Kind::Uint8),
        other => Err(error::usage(format!("dtype={other}: it must be float32 (linear light) or uint8 (sRGB codes)"))),
    }
}

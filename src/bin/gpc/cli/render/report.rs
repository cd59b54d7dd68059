//! Report on an image.

use super::view::NamedView;
use crate::cli::report::{Effort, Figures};
use gpc::camera::{Camera, Projection};
use gpc::render::{PixelRect, Settings};
use gpc::sampling::PixelFilter;
use serde::Serialize;
use std::collections::BTreeMap;

/// Figures of one image.
pub type ImageReport = Figures<ViewReport>;

/// Fields of `--json` for `gpc render`, besides those of every image.
#[derive(Serialize)]
pub struct ViewReport {
    #[serde(skip_serializing_if = "Option::is_none")]
    region: Option<RegionReport>,
    camera: CameraReport,
    #[serde(skip_serializing_if = "Option::is_none")]
    filter: Option<FilterReport>,
    /// Milliseconds of the steps of the start-up, reported with the first image only; `None` for repeated renderings.
    #[serde(skip_serializing_if = "Option::is_none")]
    startup_ms: Option<BTreeMap<&'static str, f64>>,
}

/// Part of an image that was rendered.
#[derive(Serialize)]
struct RegionReport {
    /// Column and row of its upper left pixel.
    corner: [u32; 2],
    /// Width and height of the whole image.
    image: [u32; 2],
}

/// Pixel filter of an image, unless it is the box.
#[derive(Serialize)]
struct FilterReport {
    name: String,
    /// Radius in pixels.
    radius: f64,
}

impl FilterReport {
    fn of(filter: PixelFilter) -> Option<Self> {
        (!filter.is_box()).then(|| Self { name: filter.shape.to_string(), radius: filter.radius })
    }
}

#[derive(Serialize)]
struct CameraReport {
    /// View matrix, column by column.
    view: [f64; 16],
    projection: [f64; 16],
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    /// Vertical field of view in degrees; `null` for an orthographic camera.
    fov: Option<f64>,
}

impl ViewReport {
    /// Fields of an image that `camera` made, which is `view` with the rotation of a turntable.
    pub fn new(
        settings: &Settings,
        view: &NamedView,
        camera: &Camera,
        startup_ms: Option<BTreeMap<&'static str, f64>>,
    ) -> Self {
        let [width, height] = settings.size.map(f64::from);
        let region = |region: PixelRect| RegionReport { corner: region.corner, image: settings.size };
        Self {
            region: settings.region.map(region),
            camera: describe(camera, view, width / height),
            filter: FilterReport::of(settings.pixel_filter),
            startup_ms,
        }
    }
}

impl ImageReport {
    /// A line of text for people.
    pub fn line(&self) -> String {
        let [width, height] = self.size;
        let Effort { samples, superpixels, triangles, .. } = &self.effort;
        format!(
            "{}: {width}x{height}, {} triangles, {} superpixels ({:.1} %) of {samples} samples, GPU {:.1} ms, {}",
            self.output,
            triangles.total,
            superpixels.count,
            100.0 * superpixels.fraction,
            self.effort.total_gpu_ms(),
            self.device.device
        )
    }
}

fn describe(camera: &Camera, view: &NamedView, aspect: f64) -> CameraReport {
    let distance = (view.target - view.camera.eye).length();
    CameraReport {
        view: camera.view().to_cols_array(),
        projection: camera.projection_matrix(aspect).to_cols_array(),
        eye: camera.eye.to_array(),
        target: (camera.eye + camera.direction() * distance).to_array(),
        up: camera.axes.y_axis.to_array(),
        fov: match camera.projection {
            Projection::Perspective { fov, .. } => Some(fov.to_degrees()),
            Projection::Orthographic { .. } => None,
        },
    }
}

//! Report on an image.

use super::session::RenderedImage;
use super::startup::StartUp;
use super::view::NamedView;
use crate::cli::report::{DeviceReport, Effort, RenderWork};
use gpc::camera::{Camera, Projection};
use gpc::render::Settings;
use gpc::sampling::PixelFilter;
use serde::Serialize;

/// Figures of one image.
#[derive(Serialize)]
pub struct ImageReport {
    /// The file, or `-`.
    output: String,
    #[serde(flatten)]
    device: DeviceReport,
    /// Width and height of the rendered image or part in pixels.
    size: [u32; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    region: Option<RegionReport>,
    camera: CameraReport,
    #[serde(skip_serializing_if = "Option::is_none")]
    filter: Option<FilterReport>,
    #[serde(flatten)]
    effort: Effort,
    /// Times of the start-up, reported with the first image only; `None` for repeated renderings.
    #[serde(skip_serializing_if = "Option::is_none")]
    startup_ms: Option<StartUp>,
    warnings: Vec<String>,
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

/// Where an image came from and where it is written.
pub struct Origin<'a> {
    pub output: String,
    pub device: &'a DeviceReport,
    pub settings: &'a Settings,
    pub view: &'a NamedView,
    /// The camera of the image, turntable rotation included.
    pub camera: &'a Camera,
    pub startup: Option<StartUp>,
    pub warnings: Vec<String>,
}

impl ImageReport {
    pub fn new<P>(origin: Origin<'_>, shot: &RenderedImage<P>) -> Self {
        let size = origin.settings.output_size();
        let [width, height] = origin.settings.size.map(f64::from);
        Self {
            output: origin.output,
            device: origin.device.clone(),
            size,
            region: origin
                .settings
                .region
                .map(|region| RegionReport { corner: region.corner, image: origin.settings.size }),
            camera: describe(origin.camera, origin.view, width / height),
            filter: FilterReport::of(origin.settings.pixel_filter),
            effort: Effort::new(
                origin.settings,
                &RenderWork {
                    statistics: &shot.rendered.statistics,
                    cells: u64::from(size[0]) * u64::from(size[1]),
                    passes: &shot.passes,
                    wall_ms: &shot.wall_ms,
                },
            ),
            startup_ms: origin.startup,
            warnings: origin.warnings,
        }
    }

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

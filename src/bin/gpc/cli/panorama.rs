//! `gpc panorama`.

use super::exit::Usage;
use super::render;
use super::render::args::FilterArgs;
use super::render::image::ImageArgs;
use super::report::ReportArgs;
use super::stage::RenderSetup;
use clap::Args;
use gpc::camera::panorama::{Panorama, PanoramaError, PanoramaProjection};
use gpc::render::{PixelAttributes, Rendered};
use serde::Serialize;
use std::path::PathBuf;
use std::process::ExitCode;

/// Options of `gpc panorama`.
#[derive(Args)]
#[command(
    mut_arg("size", |arg| arg.default_value("1280x640")),
    mut_arg("fov", |arg| arg
        .help("Field of view in degrees, at most 360: across the width of the image, or across the circle of a fisheye [default: 360; fisheye 180]")
        .value_parser(super::values::positive))
)]
pub struct PanoramaArgs {
    /// A glTF, OBJ, STL or PLY file, or - for standard input
    #[arg(id = "file", value_name = "SCENE")]
    scene: PathBuf,
    /// Image to write: .png, .16.png, .jpg or .exr, or - for a PNG on standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// How directions become places in the image
    #[arg(long)]
    projection: PanoramaProjection,

    #[command(flatten)]
    image: ImageArgs,
    #[command(flatten)]
    filter: FilterArgs,
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Fields of `--json` for a panorama, besides those of every image.
#[derive(Serialize)]
struct Around {
    /// Number of pinholes that were sampled.
    pinholes: usize,
}

pub fn run(args: &PanoramaArgs) -> anyhow::Result<ExitCode> {
    args.report.check(&args.output)?;
    let format = args.image.format(&args.output)?;
    let widest = match args.projection {
        PanoramaProjection::Fisheye => 180.0,
        _ => 360.0,
    };
    // `--fov` is that of the panorama; the camera, which could not see 180 degrees or more, keeps its own.
    let mut image = args.image.clone();
    let fov = image.camera.fov.take().unwrap_or(widest);
    let refuse = |error: PanoramaError| Usage(error.to_string());
    let panorama = Panorama::new(args.projection, fov, image.size).map_err(refuse)?;
    let settings = image.settings(format).pixel_filter(args.filter.filter()?);
    let mut stage = RenderSetup::open(&args.scene, &image, settings)?;
    let locations = panorama.locations(&stage.camera).map_err(refuse)?;
    let shot = stage.render(locations.size(), locations.rig())?;
    stage.finish()?;
    let effort = shot.effort(&stage.settings);
    let rendered = shot.rendered;
    let background = stage.settings.scene.background;
    let empty = background.map_or([0.0; 4], |[r, g, b]| [r, g, b, 1.0]);
    let rendered = Rendered {
        size: panorama.size(),
        colors: locations.crop(&rendered.colors, empty),
        attributes: locations.crop(&rendered.attributes, PixelAttributes::default()),
        statistics: rendered.statistics,
    };
    log::info!(
        "{}: {}x{}, pinholes in use: {}, {} superpixels",
        args.output.display(),
        rendered.size[0],
        rendered.size[1],
        locations.rig().len(),
        rendered.statistics.superpixels
    );
    render::save(&args.output, format, &rendered, &image.aovs())?;
    let around = Around { pinholes: locations.rig().len() };
    let figures = stage.figures(&args.output, rendered.size, effort, around);
    args.report.print(&figures)?;
    Ok(ExitCode::SUCCESS)
}

//! `gpc project`.

mod calibration;

use super::exit::{Usage, usage};
use super::render::image::ImageArgs;
use super::render::{self, RenderedImage, Template};
use super::report::{Figures, ReportArgs};
use super::stage::RenderSetup;
use super::{input, values};
use anyhow::Context;
use calibration::HomographyFit;
use clap::Args;
use gpc::camera::projector::{Projector, blend_weights};
use gpc::output::{self, Format, Picture};
use gpc::resample::{Photograph, light_on_wall};
use serde::Serialize;
use std::path::PathBuf;
use std::process::ExitCode;

/// Options of `gpc project`.
#[derive(Args)]
pub struct ProjectArgs {
    /// A glTF, OBJ, STL or PLY file, or - for standard input
    #[arg(id = "file", value_name = "SCENE")]
    scene: PathBuf,
    /// Frames to write: .png, .16.png, .jpg or .exr; {projector} stands for the projector's number, from 0
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// File that describes a projector (.csv or .exr); repeat the option for each projector
    #[arg(long, value_name = "FILE", required = true)]
    projector: Vec<PathBuf>,
    /// Width and height in pixels of the projectors that a .csv describes; once for all, or once for each
    #[arg(long, value_name = "WxH", default_value = "1920x1080", value_parser = values::size)]
    projector_size: Vec<[u32; 2]>,
    /// Largest distance of a correspondence from the place that the others predict for it, in pixels of the picture; correspondences
    /// farther away are ignored
    #[arg(long, value_name = "PX", default_value_t = 2.0, allow_negative_numbers = true, value_parser = values::positive)]
    tolerance: f64,
    /// Seed of the random choices while correspondences are fitted; the same seed gives the same frames
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,

    /// Also write how much each projector is dimmed, as a PNG named like its frame with .weights: 16-bit grey, 65535 where it
    /// shines alone
    #[arg(long)]
    weights: bool,
    /// Also write the picture as it appears on the wall: the sum of all frames
    #[arg(long, value_name = "OUT")]
    wall: Option<PathBuf>,

    #[command(flatten)]
    image: ImageArgs,
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Fields of `--json` for a projector's frame, besides those of every image.
#[derive(Serialize)]
struct ProjectorFrame {
    /// Quality of the correspondences; `null` for a dense map.
    calibration: Option<HomographyFit>,
    /// Mean of the projector's blend weights.
    mean_weight: f64,
    weights: Option<String>,
}

/// Output of `--json`.
#[derive(Serialize)]
struct ProjectReport {
    images: Vec<Figures<ProjectorFrame>>,
    wall: Option<String>,
}

pub fn run(args: &ProjectArgs) -> anyhow::Result<ExitCode> {
    args.report.check(&args.output)?;
    let format = args.image.format(&args.output)?;
    if !args.image.aov.is_empty() {
        usage!("--aov: frames are for projectors, which show nothing but colours");
    }
    if args.weights && input::is_standard(&args.output) {
        usage!("--weights writes files named after OUT, and -o - has no name");
    }
    let wall_format = match &args.wall {
        Some(path) => Some(Format::of(path).map_err(|error| Usage(format!("--wall {error}")))?),
        None => None,
    };
    let template = Template::new(&args.output, &["projector"])?;
    template.require("projector", "projectors", args.projector.len())?;
    let (projectors, fits): (Vec<_>, Vec<_>) =
        calibration::read(args)?.into_iter().map(|calibrated| (calibrated.projector, calibrated.fit)).unzip();
    let weights = blend_weights(&projectors);
    let mut stage = RenderSetup::open(&args.scene, &args.image, args.image.settings(format))?;
    let mut images = Vec::new();
    let mut frames = Vec::new();
    for (index, (projector, weights)) in projectors.iter().zip(&weights).enumerate() {
        let size = projector.size();
        let shot = shoot(&mut stage, projector).with_context(|| format!("projector {index}"))?;
        let colors = dim(&shot.rendered.colors, weights);
        let path = template.fill(&[("projector", &index.to_string())]);
        let picture = Picture::new(size, &colors)?;
        render::write(&path, &output::encode(format, &picture, &[])?)?;
        let weights_path = args.weights.then(|| render::beside(&path, format, "weights"));
        if let Some(path) = &weights_path {
            render::write(path, &output::encode_shares(size, weights)?)?;
        }
        if args.wall.is_some() {
            frames.push(Photograph::from(&picture));
        }
        let sum: f64 = weights.iter().copied().map(f64::from).sum();
        let frame = ProjectorFrame {
            calibration: fits.get(index).copied().flatten(),
            mean_weight: sum / weights.len().max(1) as f64,
            weights: weights_path.map(|path| path.display().to_string()),
        };
        let effort = shot.effort(&stage.settings);
        log::info!(
            "{}: {}x{}, {} superpixels, mean weight {:.3}",
            path.display(),
            size[0],
            size[1],
            effort.superpixels.count,
            frame.mean_weight
        );
        images.push(stage.figures(&path, size, effort, frame));
    }
    stage.finish()?;
    if let (Some(path), Some(format)) = (&args.wall, wall_format) {
        let lit: Vec<_> = projectors.iter().zip(&frames).collect();
        let light = light_on_wall(args.image.size, &lit);
        let picture = Picture::new(args.image.size, &light)?;
        render::write(path, &output::encode(format, &picture, &[])?)?;
    }
    args.report.print(&ProjectReport { images, wall: args.wall.as_ref().map(|path| path.display().to_string()) })?;
    Ok(ExitCode::SUCCESS)
}

/// Renders the picture at the locations of a projector's pixels.
fn shoot(stage: &mut RenderSetup, projector: &Projector) -> anyhow::Result<RenderedImage> {
    let pinhole = stage.pinhole()?;
    let locations = projector.set()?.locations();
    stage.render(projector.size(), &[(pinhole, locations)])
}

/// Colours dimmed by weights: opaque, and black where the projector lights nothing.
fn dim(colors: &[[f32; 4]], weights: &[f32]) -> Vec<[f32; 4]> {
    let dim = |([r, g, b, _], weight): (&[f32; 4], &f32)| {
        let [r, g, b] = [r, g, b].map(|light| light * weight);
        [r, g, b, 1.0]
    };
    colors.iter().zip(weights).map(dim).collect()
}

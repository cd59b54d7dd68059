//! `gpc project`.

mod calibration;

use super::exit::usage;
use super::render::{self, ImageArgs};
use super::stage::Stage;
use super::{input, values};
use clap::Args;
use gpc::camera::projector::{Projector, blend_weights};
use gpc::output::Picture;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Renders the frames of projectors that together show one picture of a scene on a wall.
///
/// A projector is given by a CSV of correspondences (header x,y,u,v: a place in its pixels and the location that it
/// lights) for a plane wall, or by an EXR with a pixel for each of its pixels: u in red, v in green, and NaN or an alpha
/// of 0 where it lights nothing. Locations are in pixels of the picture, which has --size; (0, 0) is the upper left
/// corner everywhere. The scene is sampled where each projector's pixels shine, and dimmed where projectors overlap, so
/// that their light adds up to the picture.
#[derive(Args)]
pub struct ProjectArgs {
    /// A .glb or .gltf file, or - for standard input
    #[arg(id = "file", value_name = "SCENE")]
    scene: PathBuf,
    /// Frames to write: .png, .16.png, .jpg or .exr; {projector} stands for the projector's number, from 0
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// A projector's correspondences (.csv) or dense map (.exr); repeat it for each
    #[arg(long, value_name = "FILE", required = true)]
    projector: Vec<PathBuf>,
    /// Width and height of projectors with correspondences, in pixels; once for all, or once for each
    #[arg(long, value_name = "WxH", default_value = "1920x1080", value_parser = values::size)]
    projector_size: Vec<[u32; 2]>,
    /// Correspondences that are further than this from the homography of the others, in pixels of the picture, do not
    /// count
    #[arg(long, value_name = "PX", default_value_t = 2.0, value_parser = values::positive)]
    tolerance: f64,
    /// Chooses the random fits to correspondences; the same seed gives the same frames
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,

    #[command(flatten)]
    image: ImageArgs,
}

const FIELD: &str = "{projector}";

pub fn run(args: &ProjectArgs) -> anyhow::Result<ExitCode> {
    let format = args.image.format(&args.output)?;
    if !args.image.aov.is_empty() {
        usage!("--aov: frames are for projectors, which show nothing but colours");
    }
    let count = args.projector.len();
    let Some(name) = args.output.to_str() else {
        usage!("-o {}: it is not UTF-8", args.output.display());
    };
    if count > 1 && (input::is_standard(&args.output) || !name.contains(FIELD)) {
        usage!("-o {name}: add {FIELD} to it, for there are {count} projectors");
    }
    let projectors = calibration::read(args)?;
    let weights = blend_weights(&projectors);
    let mut stage = Stage::open(&args.scene, &args.image, args.image.settings(format))?;
    for (index, (projector, weights)) in projectors.iter().zip(&weights).enumerate() {
        let colors = frame(&mut stage, projector, weights)?;
        let path = name.replace(FIELD, &index.to_string());
        let picture = Picture::new(projector.size(), &colors)?;
        let bytes = gpc::output::encode(format, &picture, &[])?;
        render::write(Path::new(&path), &bytes)?;
    }
    stage.finish()?;
    Ok(ExitCode::SUCCESS)
}

/// What a projector shows: opaque, for a projector knows no other, and black where it lights nothing.
fn frame(
    stage: &mut Stage,
    projector: &Projector,
    weights: &[f32],
) -> anyhow::Result<Vec<[f32; 4]>> {
    let pinhole = stage.pinhole()?;
    let sites = projector.set()?.sites();
    let rendered = stage.render(projector.size(), &[(pinhole, sites)])?;
    let dim = |([r, g, b, _], weight): (&[f32; 4], &f32)| {
        let [r, g, b] = [r, g, b].map(|light| light * weight);
        [r, g, b, 1.0]
    };
    Ok(rendered.colors.iter().zip(weights).map(dim).collect())
}

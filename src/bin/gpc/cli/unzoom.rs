//! `gpc unzoom`.

use super::exit::{Usage, usage};
use super::render::format_of;
use super::report::ReportArgs;
use super::zoom::check_window;
use super::{compare as text, input, print};
use clap::Args;
use gpc::camera::LocationMap;
use gpc::camera::zoom::{Window, ZoomRegion};
use gpc::compare::Comparison;
use gpc::output::{self, DecodedImage, Picture};
use gpc::resample::{Zoomed, zoomed_location};
use gpc::{compare, output::OutputError};
use serde::Serialize;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

/// Options of `gpc unzoom`.
#[derive(Args)]
pub struct UnzoomArgs {
    /// A PNG that gpc zoom wrote
    image: PathBuf,
    /// Image to write: .png, .16.png, .jpg or .exr, or - for a PNG on standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Index of the region, from 0, in the order in which the regions were given to gpc zoom
    #[arg(long, value_name = "N", default_value_t = 0, conflicts_with = "whole")]
    region: usize,
    /// Show the whole image instead of one region, with the resolution that it has outside of the regions
    #[arg(long)]
    whole: bool,
    /// Compare with this image of the same view, and print rmse, psnr, max and flip as gpc compare does
    #[arg(long, value_name = "IMAGE")]
    reference: Option<PathBuf>,

    #[command(flatten)]
    pub report: ReportArgs,
}

/// Output of `--json`.
#[derive(Serialize)]
struct Unzoomed {
    /// Path of the image.
    output: String,
    /// Width and height of the image.
    size: [u32; 2],
    /// The regions that the zoomed image holds.
    regions: Vec<ZoomRegion>,
    /// Index of the region that is shown; `null` for the whole image.
    region: Option<usize>,
    /// Wall-clock milliseconds of resampling.
    wall_ms: f64,
    /// Difference from the image of `--reference`.
    comparison: Option<Comparison>,
}

pub fn run(args: &UnzoomArgs) -> anyhow::Result<ExitCode> {
    args.report.check(&args.output)?;
    if input::is_standard(&args.output) && args.reference.is_some() {
        usage!("-o - and --reference both want standard output");
    }
    let format = format_of(&args.output)?;
    let name = args.image.display().to_string();
    let bytes = std::fs::read(&args.image).map_err(|source| OutputError::Read { path: args.image.clone(), source })?;
    let Zoomed { photograph, map } = Zoomed::decode(&bytes, &name)?;
    let regions = map.regions();
    let window = window(args, photograph.size(), regions)?;
    let start = Instant::now();
    let look = |place| zoomed_location(&map, window.location(place), window.jacobian(place));
    let pixels = photograph.resample(window.size, look);
    let wall_ms = 1e3 * start.elapsed().as_secs_f64();
    let picture = Picture::new(window.size, &pixels)?;
    let bytes = output::encode(format, &picture, &[])?;
    if input::is_standard(&args.output) {
        print::bytes(&bytes)?;
        return Ok(ExitCode::SUCCESS);
    }
    output::write_atomically(&args.output, &bytes)?;
    let comparison = match &args.reference {
        Some(reference) => {
            let reference = output::read(reference)?;
            Some(compare::compare(&reference, &DecodedImage::from(&picture))?)
        }
        None => None,
    };
    if let Some(comparison) = &comparison
        && !args.report.json
        && !args.report.quiet
    {
        text::print_lines(comparison)?;
    }
    args.report.print(&Unzoomed {
        output: args.output.display().to_string(),
        size: window.size,
        region: (!args.whole).then_some(args.region),
        regions: regions.to_vec(),
        wall_ms,
        comparison,
    })?;
    Ok(ExitCode::SUCCESS)
}

/// The part of the image plane that the options select.
fn window(args: &UnzoomArgs, size: [u32; 2], regions: &[ZoomRegion]) -> Result<Window, Usage> {
    if args.whole {
        return Ok(Window { size, corner: [0.0, 0.0], step: 1.0 });
    }
    let Some(region) = regions.get(args.region) else {
        return Err(Usage(format!(
            "--region {}: regions are counted from 0, and the image has {}",
            args.region,
            regions.len()
        )));
    };
    let window = region.window();
    check_window(args.region, &window)?;
    Ok(window)
}

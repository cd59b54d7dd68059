//! `gpc compare`.

use super::{exit, print, values};
use clap::Args;
use gpc::{compare, output};
use std::path::PathBuf;
use std::process::ExitCode;

/// Compares two images of the same size as a display shows them: sRGB-encoded, over black.
///
/// Numbers are over colour, and over alpha too where either image is not opaque. An EXR's values are brought into
/// 0 to 1 and encoded, not tone-mapped. FLIP is the mean of the error map of the colours in 8 bits.
#[derive(Args)]
pub struct CompareArgs {
    /// The reference: PNG, JPEG or EXR
    a: PathBuf,
    /// The image that is held against it
    b: PathBuf,
    /// Print one JSON object: rmse, psnr (null for identical images), max, flip
    #[arg(long)]
    json: bool,
    /// Write FLIP's error map as a PNG
    #[arg(long, value_name = "OUT")]
    heatmap: Option<PathBuf>,
    /// Exit with 5 if the rmse (0 to 1) is above this
    #[arg(long, value_name = "X", value_parser = values::not_negative)]
    max_rmse: Option<f64>,
}

pub fn run(args: &CompareArgs) -> anyhow::Result<ExitCode> {
    if let Some(path) = &args.heatmap
        && output::Format::of(path) != Ok(output::Format::Png8)
    {
        exit::usage!("--heatmap {}: the name must end in .png", path.display());
    }
    let a = output::read(&args.a)?;
    let b = output::read(&args.b)?;
    let comparison = compare::compare(&a, &b)?;
    if let Some(path) = &args.heatmap {
        let pixels = compare::heatmap(&a, &b)?;
        output::write_atomically(path, &output::encode_rgb(a.size, &pixels)?)?;
    }
    if args.json {
        print::json(&comparison)?;
    } else {
        print_lines(&comparison)?;
    }
    match args.max_rmse {
        Some(bound) if comparison.rmse > bound => {
            log::error!("rmse {} is above the bound {bound}", comparison.rmse);
            Ok(ExitCode::from(exit::OVER_BOUND))
        }
        _ => Ok(ExitCode::SUCCESS),
    }
}

/// Prints a comparison for people.
pub fn print_lines(comparison: &compare::Comparison) -> anyhow::Result<()> {
    let psnr = comparison
        .psnr
        .map_or_else(|| "identical".to_owned(), |psnr| format!("{psnr:.2} dB"));
    print::line(&format!(
        "rmse {:.6}\npsnr {psnr}\nmax  {:.6}\nflip {:.6}",
        comparison.rmse, comparison.max, comparison.flip
    ))
}

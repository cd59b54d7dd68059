//! `gpc compare`.

mod folders;
mod junit;

use super::{exit, print, values};
use clap::Args;
use gpc::{compare, output};
use std::path::PathBuf;
use std::process::ExitCode;

/// Options of `gpc compare`.
#[derive(Args)]
pub struct CompareArgs {
    /// The reference: PNG, JPEG or EXR, or a folder of such images
    a: PathBuf,
    /// The image, or the folder, that is compared with the reference
    b: PathBuf,
    /// Print one JSON object: rmse, psnr (null for identical images), max, over_2 and over_8 (numbers of pixels that differ by
    /// more than 2 and 8 codes of 8 bits), flip; of folders, these for each image
    #[arg(long)]
    json: bool,
    /// Write FLIP's error map as a PNG; of two folders, a folder with the error map of each image that differs
    #[arg(long, value_name = "OUT")]
    heatmap: Option<PathBuf>,
    /// Exit with 5 if the rmse (0 to 1) is above this
    #[arg(long, value_name = "X", value_parser = values::not_negative)]
    max_rmse: Option<f64>,
    /// Write a JUnit report of the images of two folders
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
}

pub fn run(args: &CompareArgs) -> anyhow::Result<ExitCode> {
    match (args.a.is_dir(), args.b.is_dir()) {
        (true, true) => return folders::run(args),
        (false, false) => {}
        (first, _) => {
            let (folder, image) = if first { (&args.a, &args.b) } else { (&args.b, &args.a) };
            exit::usage!(
                "{} is a folder and {} is not; compare two images or two folders",
                folder.display(),
                image.display()
            );
        }
    }
    if args.junit.is_some() {
        exit::usage!("--junit: a report is about the images of two folders");
    }
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
    let psnr = comparison.psnr.map_or_else(|| "identical".to_owned(), |psnr| format!("{psnr:.2} dB"));
    print::line(&format!(
        "rmse {:.6}\npsnr {psnr}\nmax  {:.6}\nflip {:.6}",
        comparison.rmse, comparison.max, comparison.flip
    ))
}

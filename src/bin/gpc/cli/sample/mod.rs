//! `gpc sample`.

mod csv;
mod npy;
mod table;

use super::exit::{Usage, usage};
use super::render::args::Tonemap;
use super::render::image::ImageArgs;
use super::report::{Effort, ReportArgs};
use super::stage::RenderSetup;
use super::{input, render};
use anyhow::Context;
use clap::Args;
use gpc::camera::Pinhole;
use gpc::camera::set::{Sample, SamplingSet, SetError};
use gpc::output::{self, Format, OutputError, Picture};
use gpc::render::{CellOptions, Footprint, Method, PointSample, Sampled, SceneSettings};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use table::Locations;

/// Options of `gpc sample`.
#[derive(Args)]
#[command(
    mut_arg("aa", |arg| arg.default_value("none")),
    mut_arg("samples", |arg| arg.long("supersamples"))
)]
pub struct SampleArgs {
    /// A glTF, OBJ, STL or PLY file, or - for standard input
    #[arg(id = "file", value_name = "SCENE")]
    scene: PathBuf,
    /// Where to sample: .csv or .npy
    #[arg(long = "samples", value_name = "FILE")]
    locations: PathBuf,
    /// File to write: .csv, .npy or an image, or - for a CSV on standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    #[command(flatten)]
    image: ImageArgs,
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Fields of `--json` for samples, besides those of every image.
#[derive(Serialize)]
struct SampleFields {
    /// Sampling locations.
    locations: usize,
    /// Number of samples that see a triangle.
    hits: usize,
}

/// Format of the output.
#[derive(Clone, Copy)]
enum Kind {
    Csv,
    Npy,
    /// An image whose pixels are the rows and columns of the samples.
    Image(Format),
}

pub fn run(args: &SampleArgs) -> anyhow::Result<ExitCode> {
    args.report.check(&args.output)?;
    let kind = kind(args)?;
    let locations = read(&args.locations)?;
    if matches!(kind, Kind::Image(_)) && !locations.has_cells {
        let name = args.locations.display();
        usage!("{name}: an image takes rows and columns; give u,v,row,col");
    }
    let set = set(locations.samples.clone()).with_context(|| args.locations.display().to_string())?;
    let format = match (kind, args.image.tonemap) {
        (Kind::Image(format), _) => format,
        // Without a tone map, colours are linear, like those of an EXR.
        (_, Some(Tonemap::Neutral)) => Format::Png8,
        _ => Format::Exr,
    };
    let mut stage = RenderSetup::open(&args.scene, &args.image, args.image.settings(format))?;
    let pinhole = stage.pinhole()?;
    let start = Instant::now();
    let Sampled { values: samples, statistics } = sample(&mut stage, &pinhole, &set)?;
    let wall_ms = 1e3 * start.elapsed().as_secs_f64();
    stage.finish()?;
    let rows = || {
        let pairs = locations.samples.iter().zip(&samples);
        pairs.map(|(location, sample)| table::row(location.uv, sample)).collect::<Vec<_>>()
    };
    let bytes = match kind {
        Kind::Csv => csv::write(&rows()),
        Kind::Npy => npy::write(&rows()),
        Kind::Image(format) => {
            let colors: Vec<_> = samples.iter().map(|sample| sample.color).collect();
            let pixels = set.image(&colors);
            output::encode(format, &Picture::new(set.size(), &pixels)?, &[])?
        }
    };
    render::write(&args.output, &bytes)?;
    let seen =
        SampleFields { locations: samples.len(), hits: samples.iter().filter(|sample| table::is_hit(sample)).count() };
    log::info!("{}: {} samples, {} of them see a triangle", args.output.display(), seen.locations, seen.hits);
    let size = match kind {
        Kind::Image(_) => set.size(),
        Kind::Csv | Kind::Npy => args.image.size,
    };
    let passes = std::slice::from_ref(&statistics.passes);
    let effort = Effort::new(&stage.settings, &statistics, samples.len(), passes, &[wall_ms]);
    args.report.print(&stage.figures(&args.output, size, effort, seen))?;
    Ok(ExitCode::SUCCESS)
}

/// Values at each location; with antialiasing, the colours are means around it.
fn sample(stage: &mut RenderSetup, pinhole: &Pinhole, set: &SamplingSet) -> anyhow::Result<Sampled<PointSample>> {
    let locations = set.locations();
    let RenderSetup { headless, scene, settings, .. } = stage;
    // Samples of supersampling read textures over the whole location.
    let (cells, settings) = match &settings.method {
        Method::None => (None, over_locations(&settings.scene)),
        Method::Superpixel(options) => (Some(options.cells.clone()), settings.scene.clone()),
        Method::Ssaa { samples } => {
            let cells = CellOptions::new(*samples);
            (Some(cells), over_locations(&settings.scene))
        }
        method => usage!("--aa {}: this method samples pixels only", method.kind()),
    };
    let mut samples = headless.sample_points(scene, pinhole, &locations, &settings)?;
    if let Some(cells) = cells {
        let means = headless.sample_superpixels(scene, pinhole, &locations, &cells, &settings)?;
        for (sample, color) in samples.values.iter_mut().zip(means.values) {
            sample.color = color;
        }
        samples.statistics.append(means.statistics);
    }
    Ok(samples)
}

/// Settings whose textures are read over whole locations, unless over squares of a size that was asked for.
fn over_locations(settings: &SceneSettings) -> SceneSettings {
    let settings = settings.clone();
    match settings.footprint {
        Footprint::Sample => settings.footprint(Footprint::Pixel),
        _ => settings,
    }
}

/// The sampling set of a file.
fn set(samples: Vec<Sample>) -> Result<SamplingSet, SetError> {
    const LEAF_SAMPLES: usize = 32;
    let size = samples.iter().fold([1, 1], |[columns, rows], sample| {
        [columns.max(sample.col.saturating_add(1)), rows.max(sample.row.saturating_add(1))]
    });
    SamplingSet::no_pattern(size, samples, None, LEAF_SAMPLES)
}

fn read(path: &Path) -> anyhow::Result<Locations> {
    let bytes = std::fs::read(path).map_err(|source| OutputError::Read { path: path.to_path_buf(), source })?;
    let read = if ends_with(path, "npy") { npy::read(&bytes) } else { csv::read(&bytes) };
    read.map_err(|reason| anyhow::anyhow!("{}: {reason}", path.display()))
}

fn kind(args: &SampleArgs) -> anyhow::Result<Kind> {
    args.image.sampling.check()?;
    if !args.image.aov.is_empty() {
        usage!("--aov: a CSV or NPY of samples has all that there is");
    }
    let path = &args.output;
    render::check_folder(path)?;
    if input::is_standard(path) || ends_with(path, "csv") {
        Ok(Kind::Csv)
    } else if ends_with(path, "npy") {
        Ok(Kind::Npy)
    } else {
        let known = |error| Usage(format!("-o {error}; for numbers in .csv or .npy"));
        Format::of(path).map_err(known)?;
        Ok(Kind::Image(args.image.format(path)?))
    }
}

fn ends_with(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

//! `gpc zoom`.

mod args;
mod steps;

pub use args::ZoomArgs;

use super::exit::{Usage, usage};
use super::stage::RenderSetup;
use super::{input, render};
use gpc::camera::LocationMap;
use gpc::camera::set::{MOST_CELLS, SamplingSet, SetStatistics, mapped_locations};
use gpc::camera::zoom::{Window, ZoomMap, ZoomRegion};
use gpc::output::{self, Format, Picture};
use gpc::render::{Rendered, Statistics};
use gpc::resample::{Photograph, Zoomed};
use serde::Serialize;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;
use steps::StepPicture;

/// Output of `--json` for a photograph.
#[derive(Serialize)]
struct PhotographReport {
    output: String,
    size: [u32; 2],
    regions: Vec<ZoomRegion>,
    /// Wall-clock milliseconds of resampling.
    wall_ms: f64,
}

/// Fields of `--json` for the zoom of a scene, besides those of every image.
#[derive(Serialize)]
struct About {
    regions: Vec<ZoomRegion>,
    /// Local sampling rates, and the number of folds of the map.
    locations: SetStatistics,
}

pub fn run(args: &ZoomArgs) -> anyhow::Result<ExitCode> {
    args.report.check(&args.output)?;
    let map = args.regions.map()?;
    let format = args.image.format(&args.output)?;
    if args.steps && input::is_standard(&args.output) {
        usage!("--steps writes files named after OUT, and -o - has no name");
    }
    if is_picture(&args.input) {
        photograph(args, format, &map)?;
    } else {
        scene(args, format, &map)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Writes a zoomed image and the pictures of its steps.
fn save(
    args: &ZoomArgs,
    format: Format,
    map: &ZoomMap,
    result: &Rendered,
    steps: &[StepPicture],
) -> anyhow::Result<()> {
    for step in steps {
        let picture = Picture::new(step.size, &step.pixels)?;
        let path = render::beside(&args.output, format, &step.name);
        render::write(&path, &output::encode(Format::Png8, &picture, &[])?)?;
    }
    let mut bytes = render::encode(&args.output, format, result, &args.image.aovs())?;
    if matches!(format, Format::Png8 | Format::Png16) {
        bytes = Zoomed::add_map(&bytes, result.size, map)?;
    }
    render::write(&args.output, &bytes)
}

/// Refuses a region whose ordinary image would be too large.
pub fn check_window(index: usize, window: &Window) -> Result<(), Usage> {
    let [width, height] = window.size;
    if u64::from(width) * u64::from(height) <= MOST_CELLS {
        return Ok(());
    }
    Err(Usage(format!(
        "region {index} would be an ordinary image of {width} x {height} pixels; at most {MOST_CELLS} are possible"
    )))
}

/// Refuses regions that lie outside of an image of `size` = [width, height].
fn check_places(map: &ZoomMap, size: [u32; 2]) -> Result<(), Usage> {
    for ZoomRegion { center, radius, .. } in map.regions() {
        let touches =
            (0..2).all(|axis| center[axis] + radius[axis] > 0.0 && center[axis] - radius[axis] < f64::from(size[axis]));
        if !touches {
            return Err(Usage(format!(
                "--center {},{}: the region lies outside of the image, which has {} x {} pixels",
                center[0], center[1], size[0], size[1]
            )));
        }
    }
    Ok(())
}

/// Whether a file starts like a PNG or a JPEG. An unreadable file counts as a scene, whose loader reports the error.
fn is_picture(path: &Path) -> bool {
    !input::is_standard(path) && output::is_image(path)
}

/// Zooms into a photograph.
fn photograph(args: &ZoomArgs, format: Format, map: &ZoomMap) -> anyhow::Result<()> {
    if !args.image.aov.is_empty() {
        usage!("--aov: a photograph holds nothing but colours");
    }
    if !args.filter.filter()?.is_box() {
        usage!("--filter: the pixels of a photograph are filtered already; only scenes take a filter");
    }
    let photograph = Photograph::from(&output::read(&args.input)?);
    let size = photograph.size();
    check_places(map, size)?;
    let start = Instant::now();
    let colors = photograph.resample(size, |place| (map.location(place), map.jacobian(place)));
    let wall_ms = 1e3 * start.elapsed().as_secs_f64();
    let steps = if args.steps { steps::common(size, photograph.pixels(), &colors, map) } else { Vec::new() };
    let result = Rendered { size, colors, attributes: Vec::new(), statistics: Statistics::default() };
    save(args, format, map, &result, &steps)?;
    args.report.print(&PhotographReport {
        output: args.output.display().to_string(),
        size,
        regions: map.regions().to_vec(),
        wall_ms,
    })
}

/// Samples a scene at the locations that the map gives the pixels.
fn scene(args: &ZoomArgs, format: Format, map: &ZoomMap) -> anyhow::Result<()> {
    let size = args.image.size;
    check_places(map, size)?;
    if args.steps {
        for (index, region) in map.regions().iter().enumerate() {
            check_window(index, &region.window())?;
        }
    }
    let settings = args.image.settings(format).pixel_filter(args.filter.filter()?);
    let mut stage = RenderSetup::open(&args.input, &args.image, settings)?;
    let pinhole = stage.pinhole()?;
    let set = SamplingSet::mapped(size, map)?;
    let statistics = set.statistics();
    let shot = stage.render(size, &[(pinhole, set.locations())])?;
    let about = About { regions: map.regions().to_vec(), locations: statistics };
    let figures = stage.figures(&args.output, size, shot.effort(&stage.settings), about);
    let result = shot.rendered;
    log::info!(
        "{}: {}x{}, {} to {} samples for a pixel of the plane, {} superpixels",
        args.output.display(),
        size[0],
        size[1],
        rate(statistics.lowest_rate),
        rate(statistics.highest_rate),
        result.statistics.superpixels
    );
    let mut steps = Vec::new();
    if args.steps {
        let original = stage.render(size, &[(pinhole, SamplingSet::planar(size)?.locations())])?.rendered;
        steps = steps::common(size, &original.colors, &result.colors, map);
        for (index, region) in map.regions().iter().enumerate() {
            let window = region.window();
            let direct = stage.render(window.size, &[(pinhole, mapped_locations(window.size, &window)?)])?;
            let name = match map.regions() {
                [_] => "direct".to_owned(),
                _ => format!("direct-{index}"),
            };
            steps.push(StepPicture::new(&name, window.size, direct.rendered.colors));
        }
    }
    stage.finish()?;
    save(args, format, map, &result, &steps)?;
    args.report.print(&figures)
}

/// A sampling rate as text. Images of a single row or column have no rate.
fn rate(rate: Option<f64>) -> String {
    match rate.unwrap_or(1.0) {
        rate if rate < 1e6 => format!("{rate:.2}"),
        rate => format!("{rate:.1e}"),
    }
}

//! `gpc zoom`.

mod args;
mod record;
mod steps;

pub use args::ZoomArgs;
pub use record::{KEYWORD, Record};

use super::exit::usage;
use super::render::beside;
use super::{input, print};
use gpc::camera::LocationMap;
use gpc::camera::zoom::ZoomMap;
use gpc::output::{self, Format, Picture};
use gpc::resample::Photograph;
use std::path::Path;
use std::process::ExitCode;

/// A zoomed image and the pictures on the way to it.
struct Zoomed {
    size: [u32; 2],
    result: steps::Pixels,
    steps: Vec<(String, [u32; 2], steps::Pixels)>,
}

pub fn run(args: &ZoomArgs) -> anyhow::Result<ExitCode> {
    let map = args.regions.map()?;
    let format = args.image.format(&args.output)?;
    if args.steps && input::is_standard(&args.output) {
        usage!("--steps writes files named after OUT, and -o - has no name");
    }
    let zoomed = photograph(args, &map)?;
    save(args, format, &map, &zoomed)?;
    Ok(ExitCode::SUCCESS)
}

/// Zooms into a photograph.
fn photograph(args: &ZoomArgs, map: &ZoomMap) -> anyhow::Result<Zoomed> {
    let photograph = Photograph::from(&output::read(&args.input)?);
    let size = photograph.size();
    let result = photograph.resample(size, |place| (map.location(place), map.jacobian(place)));
    let steps = if args.steps {
        common_steps(size, photograph.pixels(), &result, map)
    } else {
        Vec::new()
    };
    Ok(Zoomed {
        size,
        result,
        steps,
    })
}

/// The steps that scenes and photographs share.
fn common_steps(
    size: [u32; 2],
    original: &[[f32; 4]],
    result: &[[f32; 4]],
    map: &ZoomMap,
) -> Vec<(String, [u32; 2], steps::Pixels)> {
    [
        ("original", original.to_vec()),
        ("locations", steps::locations(size, original, map)),
        ("resampled", steps::resampled(size, result, map)),
        ("transition", steps::transition(size, result, map)),
    ]
    .map(|(name, pixels)| (name.to_owned(), size, pixels))
    .to_vec()
}

fn save(args: &ZoomArgs, format: Format, map: &ZoomMap, zoomed: &Zoomed) -> anyhow::Result<()> {
    for (name, size, pixels) in &zoomed.steps {
        let path = beside(&args.output, format, name);
        write(&path, &encode(Format::Png8, *size, pixels)?)?;
    }
    let mut bytes = encode(format, zoomed.size, &zoomed.result)?;
    if matches!(format, Format::Png8 | Format::Png16) {
        let record = serde_json::to_string(&Record::new(zoomed.size, map))?;
        bytes = output::add_text(&bytes, KEYWORD, &record)?;
    }
    write(&args.output, &bytes)
}

fn encode(format: Format, size: [u32; 2], pixels: &[[f32; 4]]) -> anyhow::Result<Vec<u8>> {
    Ok(output::encode(format, &Picture::new(size, pixels)?, &[])?)
}

fn write(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    if input::is_standard(path) {
        return print::bytes(bytes);
    }
    Ok(output::write_atomically(path, bytes)?)
}

//! `gpc view`.

use super::exit::usage;
use super::render::{Antialiasing, SamplingArgs};
use super::values;
use crate::view::{self, Look, Options, Source};
use clap::Args;
use gpc::reference::srgb;
use gpc::render::{HeadlessOptions, Settings};
use gpc::scene::PoseRequest;
use std::path::PathBuf;
use std::process::ExitCode;

/// Opens a window in which scenes are looked at; H lists the keys.
///
/// While anything moves few samples are taken, and at rest more and more, up to those asked for.
#[derive(Args)]
pub struct ViewArgs {
    /// Scene files; the arrow keys go from one to the next
    #[arg(id = "file", value_name = "SCENE", required = true)]
    scenes: Vec<PathBuf>,
    /// Width and height of the window in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = values::size)]
    size: [u32; 2],
    /// Linear factor on the light, in stops
    #[arg(long, value_name = "EV", default_value_t = 0.0, allow_negative_numbers = true, value_parser = values::finite)]
    exposure: f64,
    /// Colour behind the scene: none (black in the window, transparent in files), sRGB R,G,B of 0 to 1, or #rrggbb
    #[arg(long, value_name = "COLOUR", default_value = "#2b2f36")]
    background: String,
    /// Width of lines in pixels
    #[arg(long, value_name = "PX", default_value_t = 1.0, value_parser = values::stroke)]
    line_width: f64,
    /// Diameter of points in pixels
    #[arg(long, value_name = "PX", default_value_t = 3.0, value_parser = values::stroke)]
    point_size: f64,
    /// Camera of the scene by index to begin with [default: the first, or else one that shows everything]
    #[arg(long, value_name = "INDEX")]
    camera: Option<usize>,
    /// Scene of the file by index [default: the file's own]
    #[arg(long, value_name = "N")]
    scene: Option<usize>,
    /// Variant of the materials by name [default: none]
    #[arg(long, value_name = "NAME")]
    variant: Option<String>,
    /// Moment of the animation in seconds
    #[arg(long, value_name = "S", default_value_t = 0.0, value_parser = values::not_negative)]
    time: f64,
    /// Animation by name or index [default: the first, where a time is given]
    #[arg(long, value_name = "NAME")]
    animation: Option<String>,
    #[command(flatten)]
    sampling: SamplingArgs,
    /// Part of the device's name, in upper or lower case [default: the best device]
    #[arg(long, value_name = "NAME", help_heading = "Device")]
    device: Option<String>,
    /// Bound on device memory, such as 512M or 2G
    #[arg(long, value_name = "BYTES", value_parser = values::bytes, help_heading = "Device")]
    max_memory: Option<u64>,
}

pub fn run(args: ViewArgs) -> anyhow::Result<ExitCode> {
    let look = look(&args)?;
    let validation = std::env::var_os("GPC_VALIDATION").is_some_and(|value| !value.is_empty());
    let mut scenes = args.scenes.into_iter();
    let Some(path) = scenes.next() else {
        usage!("a scene is needed");
    };
    view::run(Options {
        source: Source {
            path,
            variant: args.variant,
            request: PoseRequest {
                scene: args.scene,
                animation: args.animation,
                time: args.time,
            },
        },
        others: scenes.collect(),
        camera: args.camera,
        look,
        background: args.background,
        device: HeadlessOptions {
            device: args.device,
            validation,
        },
    })?;
    Ok(ExitCode::SUCCESS)
}

/// How pictures are antialiased, and how large the window is.
fn look(args: &ViewArgs) -> anyhow::Result<Look> {
    let background = match values::background(&args.background) {
        Ok(values::Background::Transparent) => None,
        Ok(values::Background::Environment) => {
            usage!("--background environment: the window shows none; `gpc render` does")
        }
        Ok(values::Background::Color(color)) => Some(color.map(|v| srgb::decode(v) as f32)),
        Err(expected) => usage!("--background {}: {expected}", args.background),
    };
    let [width, height] = args.size;
    let sampling = &args.sampling;
    let method = sampling.aa.method();
    let settings = Settings {
        method,
        samples: sampling
            .asked_samples()
            .unwrap_or_else(|| view::default_samples(method)),
        pattern: sampling.pattern.clone(),
        coverage: sampling.coverage.coverage(),
        shading: sampling.shading.shading(),
        detection: sampling.detect.detection(),
        footprint: sampling.footprint.footprint(),
        background,
        exposure: args.exposure as f32,
        line_width: args.line_width as f32,
        point_size: args.point_size as f32,
        max_memory: args.max_memory,
        ..Settings::new(width, height)
    };
    if sampling.aa == Antialiasing::None && settings.samples != 1 {
        usage!(
            "none can't have {} samples a pixel; it can have 1",
            settings.samples
        );
    }
    Ok(Look::new(settings, sampling.asked_contrast()))
}

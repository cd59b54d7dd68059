//! `gpc view`.

use super::exit::{Usage, usage};
use super::render::args::{CameraArgs, SamplingArgs};
use super::render::image::{AppearanceArgs, DeviceArgs};
use super::values::{self, Background};
use crate::view::{self, Appearance, Look, Options, SceneSource};
use clap::Args;
use gpc::render::{MethodKind, Settings, Shadows};
use std::fmt::Display;
use std::path::PathBuf;
use std::process::ExitCode;

/// Options of `gpc view`.
#[derive(Args)]
pub struct ViewArgs {
    /// Scenes, folders of scenes, photographs (PNG or JPEG) and images of gpc zoom; arrow keys go from one to the next
    #[arg(id = "file", value_name = "SCENE|FOLDER|IMAGE", required = true)]
    scenes: Vec<PathBuf>,
    /// Width and height of the window in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = values::size)]
    size: [u32; 2],
    /// Colour behind the scene: #rrggbb, sRGB R,G,B of 0 to 1, none or environment
    ///
    /// none is black in the window and transparent in files. environment shows the light around the scene at rest; it is black while
    /// something moves, and with lenses.
    #[arg(long, value_name = "COLOUR", default_value = "#2b2f36")]
    background: String,
    #[command(flatten)]
    appearance: AppearanceArgs,
    #[command(flatten)]
    sampling: SamplingArgs,
    #[command(flatten)]
    camera: CameraArgs,
    #[command(flatten)]
    device: DeviceArgs,
}

pub fn run(args: ViewArgs) -> anyhow::Result<ExitCode> {
    let background = match values::background(&args.background) {
        Ok(background) => background,
        Err(expected) => usage!("--background {}: {expected}", args.background),
    };
    let look = look(&args, background)?;
    check(&args.camera)?;
    let (environment, warnings) = args.appearance.environment()?;
    let appearance = Appearance { environment, warnings, edges: args.appearance.edges() };
    let appearance_options = appearance_options(&args, &look);
    let mut scenes = args.scenes.into_iter();
    let Some(path) = scenes.next() else {
        usage!("a scene is needed");
    };
    view::run(Options {
        source: SceneSource {
            path,
            variant: args.camera.variant.clone(),
            request: args.camera.request(args.camera.time),
        },
        others: scenes.collect(),
        start: args.camera,
        appearance,
        appearance_options,
        look,
        shows_environment: background == Background::Environment,
        device: args.device.options(),
    })?;
    Ok(ExitCode::SUCCESS)
}

/// Refuses options of the first viewpoint that the window does not take.
fn check(args: &CameraArgs) -> Result<(), Usage> {
    let stands = args.eye.is_some() || args.azimuth.is_some() || args.elevation.is_some() || args.zoom.is_some();
    let refuse = |text: &str| Err(Usage(text.to_owned()));
    if args.up.is_some() {
        return refuse("--up: the window keeps the y axis upright; `gpc render` takes it");
    }
    if args.fov.is_some() && !stands {
        return refuse("--fov: the window shows cameras of the scene as they are; give --eye or --azimuth too");
    }
    if args.camera.as_deref() == Some("all") {
        return refuse("--camera all: the window begins with one; the key C goes on to the next");
    }
    Ok(())
}

/// Antialiasing of the pictures, and the size of the window.
fn look(args: &ViewArgs, background: Background) -> anyhow::Result<Look> {
    let [width, height] = args.size;
    let sampling = &args.sampling;
    let samples = sampling.samples_or(view::default_samples(sampling.aa));
    let settings = Settings::new(width, height)
        .footprint(sampling.footprint)
        .background(background.color())
        .max_memory(args.device.max_memory)
        .method(sampling.method(samples));
    if matches!(sampling.aa, MethodKind::Accumulate | MethodKind::Rotated) {
        usage!("--aa {}: the window shows each frame by itself; render the image instead", sampling.aa);
    }
    sampling.check()?;
    Ok(Look::new(args.appearance.settings(settings), sampling.superpixels(samples)))
}

/// The options for the appearance of scenes, as words of a command line. Numbers that the settings hold are left out.
fn appearance_options(args: &ViewArgs, look: &Look) -> Vec<String> {
    let appearance = &args.appearance;
    let mut options = Vec::new();
    // Name and value form one word, so that a value with a minus sign is not taken for an option.
    let mut add = |option: &str, value: &dyn Display| options.push(format!("{option}={value}"));
    if look.settings.scene.background.is_some() {
        add("--background", &args.background);
    }
    if let Some(file) = &appearance.environment {
        add("--environment", &file.display());
        if appearance.environment_rotation != 0.0 {
            add("--environment-rotation", &appearance.environment_rotation);
        }
    }
    if let Some(edges) = appearance.edges {
        let [r, g, b] = edges.color;
        add("--edges", &format_args!("{},{r},{g},{b}", edges.width));
    }
    if look.settings.scene.shadows == Shadows::Exact {
        add("--shadows", &"exact");
    }
    options
}

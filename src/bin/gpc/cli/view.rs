//! `gpc view`.

use super::exit::{self, Usage, usage};
use super::render::args::{CameraArgs, SamplingArgs};
use super::render::image::{AppearanceArgs, DeviceArgs};
use super::values::{self, Background};
use crate::view::{self, Appearance, Look, Options, SceneSource, Start};
use clap::{Args, Subcommand};
use gpc::camera::Orbit;
use gpc::render::{HeadlessOptions, MethodKind, Settings, Shadows};
use gpc::scene::PoseRequest;
use std::error::Error;
use std::fmt::Display;
use std::path::PathBuf;
use std::process::ExitCode;

/// The subcommand of the window.
#[derive(Subcommand)]
pub enum Command {
    /// Show scenes and photographs in a window; H lists its keys
    ///
    /// The picture has few samples a pixel while anything moves, and more and more at rest, up to --samples.
    View(Box<ViewArgs>),
}

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

/// Whether an error says that there is no display for the window.
pub fn is_no_display(error: &(dyn Error + 'static)) -> bool {
    error.is::<view::NoDisplay>()
}

/// Advice on an unknown subcommand that the window would have.
pub fn tip(_: &str) -> Option<&'static str> {
    None
}

pub fn run(command: Command) -> anyhow::Result<ExitCode> {
    let Command::View(args) = command;
    let args = *args;
    let background = match values::background(&args.background) {
        Ok(background) => background,
        Err(expected) => usage!("--background {}: {expected}", args.background),
    };
    let look = look(&args, background)?;
    let start = start(&args.camera)?;
    let (environment, warnings) = args.appearance.environment()?;
    let appearance = Appearance { environment, warnings, edges: args.appearance.edges() };
    let appearance_options = appearance_options(&args, &look);
    let validation = std::env::var_os("GPC_VALIDATION").is_some_and(|value| !value.is_empty());
    let mut scenes = args.scenes.into_iter();
    let Some(path) = scenes.next() else {
        usage!("a scene is needed");
    };
    view::run(Options {
        source: SceneSource {
            path,
            variant: args.camera.variant,
            request: PoseRequest { scene: args.camera.scene, animation: args.camera.animation, time: args.camera.time },
        },
        others: scenes.collect(),
        start,
        appearance,
        appearance_options,
        look,
        shows_environment: background == Background::Environment,
        device: HeadlessOptions::default().device(args.device.name).validation(validation),
        describe: exit::message,
    })?;
    Ok(ExitCode::SUCCESS)
}

/// Viewpoint at the start, from which the first scene is seen.
fn start(args: &CameraArgs) -> Result<Start, Usage> {
    let default = Orbit::default();
    let fov = args.fov.unwrap_or(default.fov);
    if args.up.is_some() {
        return Err(Usage("--up: the window keeps the y axis upright; `gpc render` takes it".to_owned()));
    }
    if let Some(eye) = args.eye {
        let target = args.target;
        return Ok(Start::Place { eye, target, fov });
    }
    if args.azimuth.is_some() || args.elevation.is_some() || args.zoom.is_some() {
        return Ok(Start::Around(Orbit {
            azimuth: args.azimuth.unwrap_or(default.azimuth),
            elevation: args.elevation.unwrap_or(default.elevation),
            zoom: args.zoom.unwrap_or(default.zoom),
            fov,
        }));
    }
    if args.fov.is_some() {
        return Err(Usage(
            "--fov: the window shows cameras of the scene as they are; give --eye or --azimuth too".to_owned(),
        ));
    }
    match args.camera.as_deref() {
        None => Ok(Start::First),
        Some("all") => Err(Usage("--camera all: the window begins with one; the key C goes on to the next".to_owned())),
        Some(camera) => Ok(Start::Camera(camera.to_owned())),
    }
}

/// Antialiasing of the pictures, and the size of the window.
fn look(args: &ViewArgs, background: Background) -> anyhow::Result<Look> {
    let background = match background {
        Background::Transparent | Background::Environment => None,
        Background::Color(color) => Some(values::linear(color)),
    };
    let [width, height] = args.size;
    let sampling = &args.sampling;
    let samples = sampling.samples_or(view::default_samples(sampling.aa));
    let settings = Settings::new(width, height)
        .footprint(sampling.footprint)
        .background(background)
        .max_memory(args.device.max_memory)
        .method(sampling.method(samples));
    if matches!(sampling.aa, MethodKind::Accumulate | MethodKind::Rotated) {
        usage!("--aa {}: the window shows each frame by itself; render the image instead", sampling.aa);
    }
    if sampling.aa == MethodKind::None && samples != 1 {
        usage!("none can't have {samples} samples a pixel; it can have 1");
    }
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

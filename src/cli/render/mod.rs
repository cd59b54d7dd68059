//! `gpc render`.

mod args;
mod report;
mod save;
mod sequence;
mod session;
mod template;
mod view;

pub use args::{Antialiasing, CameraArgs, RenderArgs};
pub use view::choose as choose_views;

use super::exit::{Usage, usage};
use super::values::Background;
use super::{input, print};
use args::Tonemap;
use gpc::output::{AovKind, Format};
use gpc::reference::srgb;
use gpc::render::{Reference, Settings};
use gpc::scene::{Loaded, Pose, PoseRequest};
use indicatif::{ProgressBar, ProgressStyle};
use report::{Origin, Report};
use serde::Serialize;
use session::Session;
use std::process::ExitCode;
use template::{Fields, Template};

/// What `--json` prints for several images.
#[derive(Serialize)]
struct Sequence {
    images: Vec<Report>,
}

pub fn run(args: &RenderArgs) -> anyhow::Result<ExitCode> {
    let template = Template::new(&args.output)?;
    let format = check(args)?;
    let steps = sequence::steps(args)?;
    template.require("frame", "frames", steps.len())?;

    let loaded = input::load(&args.scene)?;
    let mut warnings = Warnings::default();
    warnings.add(&loaded.warnings);
    let settings = settings(args, format);
    let aspect = f64::from(settings.size[0]) / f64::from(settings.size[1]);
    let aovs = kinds(args);
    let stem = input::stem(&args.scene);

    let mut time = steps.first().map_or(0.0, |step| step.time);
    let mut pose = pose(&loaded, args, time)?;
    warnings.add(&pose.warnings);
    let cameras = view::choose(&args.camera, &pose, aspect)?.len();
    template.require("camera", "cameras", cameras)?;

    let mut session = Session::new(args.device.clone(), settings.clone())?;
    let device = session.device();
    session.show(&loaded.scene, &pose)?;
    let progress = progress(steps.len() * cameras, args.quiet);
    let mut images = Vec::new();
    for step in &steps {
        if step.time != time {
            time = step.time;
            pose = self::pose(&loaded, args, time)?;
            warnings.add(&pose.warnings);
            session.show(&loaded.scene, &pose)?;
        }
        for view in view::choose(&args.camera, &pose, aspect)? {
            let camera = view.turned(step.turn);
            let shot = session.shoot(&camera, args.repeat)?;
            let path = template.fill(&Fields {
                stem: &stem,
                camera: &view.label,
                frame: step.frame,
            });
            save::save(&path, format, &shot.rendered, &aovs)?;
            let origin = Origin {
                output: path.display().to_string(),
                device: &device,
                settings: &settings,
                view: &view,
                camera: &camera,
                warnings: warnings.0.clone(),
            };
            let report = Report::new(origin, &shot);
            progress.suspend(|| log::info!("{}", report.line()));
            progress.inc(1);
            images.push(report);
        }
    }
    progress.finish_and_clear();
    if let Some(message) = session.validation_messages().first() {
        anyhow::bail!("the validation layer says: {message}");
    }
    if args.json {
        match images.as_slice() {
            [image] => print::json(image)?,
            _ => print::json(&Sequence { images })?,
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Refuses what can't go together, and says what is written.
fn check(args: &RenderArgs) -> anyhow::Result<Format> {
    let samples = args.sampling.samples();
    if args.sampling.aa == Antialiasing::None && samples != 1 {
        usage!("none can't have {samples} samples a pixel; it can have 1");
    }
    if input::is_standard(&args.output) {
        if args.json {
            usage!("-o - and --json both want standard output");
        }
        if !args.aov.is_empty() {
            usage!("--aov writes files named after OUT, and -o - has no name");
        }
        return Ok(Format::Png8);
    }
    let format = Format::of(&args.output).map_err(|error| Usage(format!("-o {error}")))?;
    if format.is_scene_linear() && args.tonemap == Some(Tonemap::Neutral) {
        usage!("--tonemap neutral: an EXR holds light that is not tone-mapped");
    }
    Ok(format)
}

fn settings(args: &RenderArgs, format: Format) -> Settings {
    let [width, height] = args.size;
    let tonemaps = args.tonemap != Some(Tonemap::None);
    Settings {
        method: args.sampling.aa.method(),
        samples: args.sampling.samples(),
        pattern: args.sampling.pattern.clone(),
        coverage: args.sampling.coverage.coverage(),
        shading: args.sampling.shading.shading(),
        detection: args.sampling.detect.detection(),
        contrast: args.sampling.contrast(),
        background: match args.background {
            Background::Transparent => None,
            Background::Color(color) => Some(color.map(|v| srgb::decode(v) as f32)),
        },
        exposure: args.exposure as f32,
        reference: if tonemaps && !format.is_scene_linear() {
            Reference::Display
        } else {
            Reference::Scene
        },
        tonemapped_detection: tonemaps,
        attributes: !args.aov.is_empty(),
        max_memory: args.max_memory,
        ..Settings::new(width, height)
    }
}

/// The AOVs asked for, each once.
fn kinds(args: &RenderArgs) -> Vec<AovKind> {
    let asked = |kind: &AovKind| args.aov.contains(kind);
    AovKind::ALL.into_iter().filter(asked).collect()
}

fn pose(loaded: &Loaded, args: &RenderArgs, time: f64) -> anyhow::Result<Pose> {
    Ok(loaded.scene.pose(&PoseRequest {
        scene: args.camera.scene,
        animation: args.camera.animation.clone(),
        time,
    })?)
}

/// Counts images on standard error where that is a terminal.
fn progress(count: usize, quiet: bool) -> ProgressBar {
    if quiet || count < 2 {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} images, {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(count as u64).with_style(style)
}

/// Every warning once.
#[derive(Default)]
struct Warnings(Vec<String>);

impl Warnings {
    fn add(&mut self, found: &[String]) {
        for warning in found {
            if !self.0.contains(warning) {
                log::warn!("{warning}");
                self.0.push(warning.clone());
            }
        }
    }
}

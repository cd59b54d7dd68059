//! `gpc render`.

mod args;
mod image;
mod report;
mod save;
mod sequence;
mod session;
mod template;
mod view;

pub use args::{Antialiasing, CameraArgs, RenderArgs, Tonemap};
pub use image::ImageArgs;
pub use save::{beside, encode, save, write};
pub use session::{Shot, open, upload};
pub use view::{View, choose as choose_views};

use super::exit::usage;
use super::input;
use gpc::output::{Picture, VideoWriter};
use gpc::render::{Settings, Shadows};
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
    args.report.check(&args.output)?;
    let image = &args.image;
    let format = image.format(&args.output)?;
    let settings = Settings {
        region: args.region,
        ..image.settings(format)
    };
    if let Some(region) = args.region {
        region.end(settings.size)?;
        if settings.shadows == Shadows::Exact {
            usage!(
                "--region: exact shadows are those of a whole image; leave out one of --region and --shadows"
            );
        }
    }
    sequence::check(args)?;
    let steps = sequence::steps(args)?;
    if args.format.is_none() {
        template.require("frame", "frames", steps.len())?;
    }
    let steps = sequence::share(steps, args.sequence.shard);
    if steps.is_empty() {
        log::info!("there are fewer images than shares: none are left for this one");
        let images = Vec::new();
        args.report.print(&Sequence { images })?;
        return Ok(ExitCode::SUCCESS);
    }

    let loaded = input::load_variant(&args.scene, image.camera.variant.as_deref())?;
    let mut warnings = Warnings::default();
    warnings.add(&loaded.warnings);
    let aspect = f64::from(settings.size[0]) / f64::from(settings.size[1]);
    let aovs = image.aovs();
    let stem = input::stem(&args.scene);

    let mut time = steps.first().map_or(0.0, |step| step.time);
    let mut pose = image.pose(&loaded, time)?;
    warnings.add(&pose.warnings);
    let cameras = view::choose(&image.camera, &pose, aspect)?.len();
    template.require("camera", "cameras", cameras)?;

    let mut session = Session::new(image.device.clone(), settings.clone())?;
    let device = session.device();
    session.show(&loaded.scene, &pose)?;
    let mut video = args
        .format
        .map(|stream| {
            let (format, size) = (stream.format(), settings.output_size());
            VideoWriter::new(std::io::stdout(), format, size, args.sequence.fps())
        })
        .transpose()?;
    let progress = progress(steps.len() * cameras, args.report.quiet);
    let mut images = Vec::new();
    for step in &steps {
        if step.time != time {
            time = step.time;
            pose = image.pose(&loaded, time)?;
            warnings.add(&pose.warnings);
            session.show(&loaded.scene, &pose)?;
        }
        for view in view::choose(&image.camera, &pose, aspect)? {
            let camera = view.turned(step.turn);
            let shot = session.shoot(&camera, args.repeat)?;
            let path = template.fill(&Fields {
                stem: &stem,
                camera: &view.label,
                frame: step.frame,
            });
            match &mut video {
                Some(video) => {
                    video.write(&Picture::new(shot.rendered.size, &shot.rendered.colors)?)?;
                }
                None => save::save(&path, format, &shot.rendered, &aovs)?,
            }
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
    match images.as_slice() {
        [image] if args.sequence.shard.is_none() => args.report.print(image)?,
        _ => args.report.print(&Sequence { images })?,
    }
    Ok(ExitCode::SUCCESS)
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

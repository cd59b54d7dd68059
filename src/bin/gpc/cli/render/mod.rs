//! `gpc render`.

pub mod args;
mod film;
pub mod image;
mod report;
mod save;
mod sequence;
mod session;
mod startup;
mod template;
mod unseen;
pub mod view;

pub use save::{beside, check_folder, encode, format_of, save, write};
pub use session::{RenderedImage, check_validation, open_beside, upload};
pub use template::Template;
pub use view::{NamedView, choose as choose_views};

use super::exit::{Usage, usage};
use super::input;
use super::values::Background;
use args::RenderArgs;
use film::Film;
use gpc::output::{Format, Picture, VideoWriter};
use gpc::render::{Method, Settings};
use indicatif::{ProgressBar, ProgressStyle};
use report::{ImageReport, ViewReport};
use sequence::SequenceFrame;
use serde::Serialize;
use session::{Session, Shot};
use startup::Clock;
use std::process::ExitCode;
use template::frame_number;

/// Output of `--json` for several images.
#[derive(Serialize)]
struct SequenceReport {
    images: Vec<ImageReport>,
}

pub fn run(args: &RenderArgs) -> anyhow::Result<ExitCode> {
    let mut clock = Clock::start();
    let template = Template::new(&args.output, &["stem", "camera", "frame"])?;
    let (format, settings) = settings(args)?;
    let (first, steps) = steps(args, &template)?;
    let image = &args.image;
    if steps.is_empty() {
        log::info!("there are fewer images than shares: none are left for this one");
        let images = Vec::new();
        args.report.print(&SequenceReport { images })?;
        return Ok(ExitCode::SUCCESS);
    };
    let aspect = f64::from(settings.size[0]) / f64::from(settings.size[1]);
    let aovs = image.aovs();
    let stem = input::stem(&args.scene);

    let mut warnings = Warnings::default();
    let (headless, (mut film, cameras)) = session::open_beside(&image.device.options(), || {
        let loaded = image.load(&args.scene)?;
        clock.lap("load");
        warnings.add(&loaded.warnings);
        if args.sequence.frames.is_some() && loaded.scene.info().animations.is_empty() {
            let still = "the scene has no animation, so all frames show the same";
            warnings.add(&[still.to_owned()]);
        }
        let film = Film::new(image, loaded, first, &steps)?;
        warnings.add(&film.pose.warnings);
        if image.background == Background::Environment && film.environment().is_none() {
            usage!("--background environment: there is none; name one by --environment FILE");
        }
        let cameras = film.views(aspect)?.len();
        template.require("camera", "cameras", cameras)?;
        clock.lap("pose");
        Ok((film, cameras))
    })?;
    clock.lap("device");
    // Everything else reads light.
    let reads_codes = format == Format::Png8
        && args.format.is_none()
        && image.background != Background::Environment
        && !matches!(settings.method, Method::Accumulate { .. });
    let mut session = Session::new(headless, settings.clone(), reads_codes);
    let mut video = args
        .format
        .map(|stream| {
            let (format, size) = (stream, settings.output_size());
            VideoWriter::new(std::io::stdout(), format, size, args.sequence.fps())
        })
        .transpose()?;
    let progress = progress(steps.len() * cameras, args.report.quiet);
    let mut images = Vec::new();
    for step in &steps {
        warnings.add(&film.show(step.time, &mut session, &mut clock)?);
        for view in film.views(aspect)? {
            let camera = view.turned(step.turn);
            let mut shot = session.shoot(&camera, args.repeat)?;
            // A part of an image may rightly be empty.
            if args.region.is_none() && shot.is_uniform() {
                warnings.add(&[unseen::warning(&view, &film.pose, film.cameras(), aspect)]);
            }
            if let (Shot::Light(shot), Background::Environment, Some(environment)) =
                (&mut shot, image.background, film.environment())
            {
                shot.rendered.show_behind(environment, &camera, &settings)?;
            }
            clock.lap("frame");
            let frame = frame_number(step.frame);
            let path = template.fill(&[("stem", &stem), ("camera", &view.label), ("frame", &frame)]);
            match (&shot, &mut video) {
                (Shot::Light(shot), Some(video)) => {
                    video.write(&Picture::new(shot.rendered.size, &shot.rendered.colors)?)?;
                }
                (Shot::Light(shot), None) => save::save(&path, format, &shot.rendered, &aovs)?,
                (Shot::Codes(shot), _) => save::save_codes(&path, &shot.rendered, &aovs)?,
            }
            clock.lap("write");
            let startup_ms = clock.finish().filter(|_| args.repeat.is_none());
            let report = ImageReport {
                output: path.display().to_string(),
                device: session.device(),
                size: settings.output_size(),
                effort: shot.effort(&settings),
                more: ViewReport::new(&settings, &view, &camera, startup_ms),
                warnings: warnings.0.clone(),
            };
            progress.suspend(|| log::info!("{}", report.line()));
            progress.inc(1);
            images.push(report);
        }
    }
    progress.finish_and_clear();
    session.finish()?;
    match images.as_slice() {
        [image] if args.sequence.shard.is_none() => args.report.print(image)?,
        _ => args.report.print(&SequenceReport { images })?,
    }
    Ok(ExitCode::SUCCESS)
}

/// Settings and format of the images, checked against each other.
fn settings(args: &RenderArgs) -> anyhow::Result<(Format, Settings)> {
    args.report.check(&args.output)?;
    let format = args.image.format(&args.output)?;
    let filter = args.filter.filter()?;
    let settings = args.image.settings(format).region(args.region).pixel_filter(filter).time_rounds(args.time_rounds);
    if let Some(region) = args.region {
        region.end(settings.size)?;
    }
    Ok((format, settings))
}

/// The images of the sequence, or of one share of it, and the time of the sequence's first image.
fn steps(args: &RenderArgs, template: &Template) -> Result<(f64, Vec<SequenceFrame>), Usage> {
    sequence::check(args)?;
    let steps = sequence::steps(args)?;
    if args.format.is_none() {
        template.require("frame", "frames", steps.len())?;
    }
    // All shares start from the first pose of the whole sequence, so that the images do not depend on the number of
    // shares.
    let first = steps.first().map_or(0.0, |step| step.time);
    Ok((first, sequence::share(steps, args.sequence.shard)))
}

/// Progress bar on standard error, if that is a terminal.
fn progress(count: usize, quiet: bool) -> ProgressBar {
    if quiet || count < 2 {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} images, {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(count as u64).with_style(style)
}

/// Warnings that were printed already; each is printed once.
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

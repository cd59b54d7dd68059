//! The command line: one module for each subcommand.

mod bench;
mod compare;
mod csv;
mod devices;
mod exit;
mod info;
mod input;
mod panorama;
mod print;
mod project;
mod render;
mod report;
mod sample;
mod stage;
mod unzoom;
mod values;
#[cfg(feature = "view")]
mod view;
mod zoom;

use clap::{Parser, Subcommand};
use std::io::Write;
use std::process::ExitCode;

/// Renders glTF scenes and antialiases only where an image aliases, with up to 1,024 samples in a pixel.
#[derive(Parser)]
#[command(name = "gpc", version, arg_required_else_help = true, after_help = AFTER_HELP)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const AFTER_HELP: &str = "\
Examples:
  gpc render scene.glb -o image.png --background '#a8c0d8'     an image of 1280 x 720 pixels
  gpc render scene.glb -o '{frame}.png' --turntable 36         36 images from all around
  gpc compare expected.png image.png --max-rmse 0.001          fails if they differ by more

Exit codes:
  0  done
  1  scene, render or file error
  2  usage
  3  no suitable device, or no display for a window
  4  device lost or out of memory
  5  comparison over its bound

Environment:
  RUST_LOG=debug    say more on standard error
  GPC_VALIDATION=1  render under the Vulkan validation layer; any message of it is an error";

#[derive(Subcommand)]
enum Command {
    /// Render a scene to image files
    Render(Box<render::RenderArgs>),
    /// Enlarge regions of a scene or photograph continuously, in the context of the rest
    Zoom(Box<zoom::ZoomArgs>),
    /// Turn a zoomed image back into an ordinary view
    Unzoom(unzoom::UnzoomArgs),
    /// Sample a scene at given locations
    Sample(Box<sample::SampleArgs>),
    /// Render what is around the camera
    Panorama(Box<panorama::PanoramaArgs>),
    /// Render the frames of projectors that together show one picture
    Project(Box<project::ProjectArgs>),
    /// Compare two images, or two folders of images
    Compare(compare::CompareArgs),
    /// Describe the contents of a scene
    Info(info::InfoArgs),
    /// Measure the cost and the accuracy of the methods
    Bench(bench::BenchArgs),
    /// List the Vulkan devices, and what they lack
    Devices(devices::DevicesArgs),
    /// Look at scenes in a window
    #[cfg(feature = "view")]
    View(Box<view::ViewArgs>),
}

impl Command {
    /// Whether only errors are printed.
    fn is_quiet(&self) -> bool {
        let report = match self {
            Self::Render(args) => &args.report,
            Self::Zoom(args) => &args.report,
            Self::Unzoom(args) => &args.report,
            Self::Sample(args) => &args.report,
            Self::Panorama(args) => &args.report,
            Self::Project(args) => &args.report,
            Self::Compare(_) | Self::Info(_) | Self::Bench(_) | Self::Devices(_) => return false,
            #[cfg(feature = "view")]
            Self::View(_) => return false,
        };
        report.quiet
    }
}

/// The command with its options, from which manual pages and completions are made.
#[allow(dead_code, reason = "the example `manual` uses it")]
pub fn command() -> clap::Command {
    <Cli as clap::CommandFactory>::command()
}

/// Runs the command that the process was started with.
pub fn run() -> ExitCode {
    // Wrong usage ends the process here, with exit code 2.
    let command = Cli::parse().command;
    start_log(command.is_quiet());
    let done = match command {
        Command::Render(args) => render::run(&args),
        Command::Zoom(args) => zoom::run(&args),
        Command::Unzoom(args) => unzoom::run(&args),
        Command::Sample(args) => sample::run(&args),
        Command::Panorama(args) => panorama::run(&args),
        Command::Project(args) => project::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Info(args) => info::run(&args),
        Command::Bench(args) => bench::run(&args),
        Command::Devices(args) => devices::run(&args),
        #[cfg(feature = "view")]
        Command::View(args) => view::run(*args),
    };
    match done {
        Ok(code) => code,
        Err(error) if exit::is_closed_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", exit::message(&error));
            ExitCode::from(exit::code(&error))
        }
    }
}

fn start_log(quiet: bool) {
    let level = if quiet { "error" } else { "info" };
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or(level))
        .format(|out, record| {
            let text = record.args();
            match record.level() {
                log::Level::Info => writeln!(out, "{text}"),
                log::Level::Warn => writeln!(out, "warning: {text}"),
                level => writeln!(out, "{}: {text}", level.as_str().to_lowercase()),
            }
        })
        .init();
}

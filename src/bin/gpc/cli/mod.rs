//! The command line: one module for each subcommand.

mod bench;
mod compare;
mod csv;
mod devices;
pub mod exit;
mod info;
pub mod input;
mod mistake;
mod panorama;
mod print;
mod project;
pub mod render;
mod report;
mod sample;
mod stage;
mod unzoom;
mod values;
#[cfg(feature = "view")]
mod view;
mod zoom;

use clap::builder::styling::AnsiColor;
use clap::{Parser, Subcommand};
use std::io::Write;
use std::process::ExitCode;

/// Renders 3D scenes and antialiases only the pixels that alias, at 512 to 4,096 places each.
///
/// Scenes are glTF 2.0, OBJ, STL or PLY files. Images are PNG, JPEG or EXR files.
#[derive(Parser)]
#[command(name = "gpc", version, arg_required_else_help = true, max_term_width = 120, after_help = AFTER_HELP)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

const AFTER_HELP: &str = "\
Examples:
  An image of 1280 x 720 pixels, before a light blue background:
  gpc render scene.glb -o image.png --background '#a8c0d8'

  36 images from all around:
  gpc render scene.glb -o '{frame}.png' --turntable 36

  A test that fails if two images differ:
  gpc compare expected.png image.png --max-rmse 0.001

'gpc render -h' lists the options that are used most, 'gpc render --help' explains all of them.

Exit codes:
  0  done
  1  the scene, the image or a file is wrong
  2  wrong usage
  3  no suitable device, or no display for a window
  4  the device was lost, or memory ran out
  5  gpc compare found a difference above its bound

Environment variables:
  RUST_LOG=debug    print more on standard error
  GPC_VALIDATION=1  render under the Vulkan validation layer; each of its messages is an error";

#[derive(Subcommand)]
enum Command {
    /// Render a scene to image files
    ///
    /// The ending of OUT decides the format: .png (8 bits a channel), .16.png (16 bits a channel), .jpg or .jpeg (quality 95; black
    /// where there is no background) or .exr (floats of 32 bits: linear light, premultiplied, not tone-mapped).
    ///
    /// OUT may contain placeholders: {stem} is the name of the scene's file, {camera} the name of the camera or its index, and {frame}
    /// the number of an image in a sequence, with at least four digits. A file appears under its name once it is complete.
    Render(Box<render::args::RenderArgs>),
    /// Enlarge regions of a scene or photograph within the rest of the image
    ///
    /// A transition joins each enlarged region to the rest without a gap (focus plus context). In a scene, each pixel is sampled at its
    /// own location and antialiased. In a photograph, colours are interpolated between its pixels, and the options of size, light, view
    /// and antialiasing have no effect.
    ///
    /// Positions are in pixels of the output image, and (0, 0) is its upper left corner. For several regions, repeat --center, --radius
    /// and --multiplicity; each region enlarges a part of what the regions before it made. A PNG also stores the regions, so that gpc
    /// unzoom can undo the zoom.
    Zoom(Box<zoom::ZoomArgs>),
    /// Turn an image of gpc zoom back into an ordinary view, without the scene
    ///
    /// The PNG that gpc zoom wrote stores its regions. The result is an ordinary view of the rectangle around one of them, with as many
    /// pixels as this rectangle has in the zoomed image.
    Unzoom(unzoom::UnzoomArgs),
    /// Sample a scene at the locations in a table
    ///
    /// The table is a CSV with the header u,v or u,v,row,col, or an NPY array of N x 2 or N x 4 numbers (float32 or float64). u and v are
    /// in pixels of an image of --size, and (0, 0) is its upper left corner. Locations may lie outside of the image. row and col say
    /// which locations are neighbours, so that textures are filtered over the area between them; without row and col, a sample
    /// stands for a pixel.
    ///
    /// The result is a table with a row for each location, in the same order: u, v; the colour r, g, b, a (linear light, premultiplied,
    /// tone-mapped only with --tonemap neutral); depth (along the direction of view; 0 if no triangle is hit); id (index of the triangle
    /// plus 1); hit (1 or 0); the normal x, y, z. A CSV has a header, an NPY array has N x 12 float64. If OUT is an image (.png, .16.png,
    /// .jpg, .exr), each pixel is the mean colour of the samples with its row and col, tone-mapped as by gpc render.
    ///
    /// Samples are points by default. With --aa superpixel or --aa ssaa, the colour of a location is the mean of --supersamples points
    /// around it.
    Sample(Box<sample::SampleArgs>),
    /// Render what is around the camera, up to 360 x 180 degrees
    ///
    /// Each pixel is sampled in its own direction and antialiased; no image is resampled. The camera looks at the middle of the image.
    Panorama(Box<panorama::PanoramaArgs>),
    /// Render the frames of projectors that together show one picture on a wall
    ///
    /// Each projector is described by a file. For a plane wall, this is a CSV of correspondences (header x,y,u,v): x and y are a place in
    /// the projector's frame, u and v the location in the picture that this place lights. For any other wall, it is an EXR of the
    /// projector's size: each pixel holds the location that it lights, u in red and v in green, or NaN or an alpha of 0 if it lights
    /// nothing. All numbers are in pixels, and (0, 0) is the upper left corner. The picture has --size.
    ///
    /// Each pixel of a projector samples the scene at the location that it lights. Where projectors overlap they are dimmed, so that their
    /// light adds up to the picture.
    Project(Box<project::ProjectArgs>),
    /// Compare two images, or two folders of images
    ///
    /// Images are compared as a display shows them: sRGB codes over black. Alpha is compared too if one of the images is not opaque. Values of
    /// an EXR are clamped to 0 to 1 and encoded, not tone-mapped. FLIP is the mean of the error map of the colours in 8 bits.
    ///
    /// In two folders, images of the same name are compared, in subfolders too. An image is equal, different (its rmse is above --max-rmse,
    /// or above 0 without it, or the two can't be compared), missing (in A only) or new (in B only). The command exits with 5 unless all
    /// are equal.
    Compare(compare::CompareArgs),
    /// Describe the contents of a scene
    Info(info::InfoArgs),
    /// Measure the time and the error of the antialiasing methods
    ///
    /// Each scene is rendered as by gpc render, before a light grey background, with each method and each number of samples that the
    /// method allows: once to warm up and then R times, the methods taking turns. Each image is compared with a reference:
    /// supersampling with thousands of samples a pixel, each of which reads textures over 1/64 of a pixel's width. References are
    /// kept on disk for the next run.
    ///
    /// --geometry, --growth, --variants, --choices, --motion and --stress measure more, as their descriptions say. DIR then holds
    /// results.json, report.html and a CSV for each table, such as results.csv. All files are written again after each scene. The lines at
    /// the head of a CSV begin with # and say where its figures come from.
    Bench(Box<bench::BenchArgs>),
    /// List the Vulkan devices and what they lack
    ///
    /// Exits with 3 if no device is suitable.
    Devices(devices::DevicesArgs),
    /// Show scenes and photographs in a window; H lists its keys
    ///
    /// The picture has few samples a pixel while anything moves, and more and more at rest, up to --samples.
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

/// Runs the command that the process was started with.
pub fn run() -> ExitCode {
    // Wrong usage ends the process here, with exit code 2.
    let command = Cli::try_parse().unwrap_or_else(|error| mistake::explained(error).exit()).command;
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
            let label = print::label("error", AnsiColor::Red);
            eprintln!("{label} {}", exit::message(&error));
            ExitCode::from(exit::code(&error))
        }
    }
}

fn start_log(quiet: bool) {
    let level = if quiet { "error" } else { "info" };
    let warning = print::label("warning", AnsiColor::Yellow);
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or(level))
        .format(move |out, record| {
            let text = record.args();
            match record.level() {
                log::Level::Info => writeln!(out, "{text}"),
                log::Level::Warn => writeln!(out, "{warning} {text}"),
                level => writeln!(out, "{}: {text}", level.as_str().to_lowercase()),
            }
        })
        .init();
}

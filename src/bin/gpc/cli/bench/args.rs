//! The options of `gpc bench`.

use super::METHODS;
use super::measurement::{GRID_SAMPLES, MAX_REFERENCE_SAMPLES};
use crate::cli::render::args::CameraArgs;
use crate::cli::values;
use clap::Args;
use gpc::render::MethodKind;
use gpc::sampling::MAX_SAMPLES;
use std::path::PathBuf;
use std::time::Duration;

/// Options of `gpc bench`.
#[derive(Args)]
pub struct BenchArgs {
    /// glTF, OBJ, STL or PLY files
    #[arg(value_name = "SCENE", required_unless_present_any = ["motion", "growth", "stress"])]
    pub scenes: Vec<PathBuf>,
    /// Folder for the results
    #[arg(short, long, value_name = "DIR")]
    pub out: PathBuf,

    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = values::size)]
    pub size: [u32; 2],
    /// Methods to measure
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_value = "none,msaa,ssaa,superpixel")]
    methods: Vec<MethodKind>,
    /// Samples a pixel; a method leaves out the numbers that it doesn't allow
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "4,16,64,256,1024",
        value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    samples: Vec<u32>,
    /// Further numbers of samples for superpixels alone
    #[arg(long, value_name = "LIST", value_delimiter = ',',
        value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    superpixel_samples: Vec<u32>,
    /// Samples a pixel of the reference, a multiple of 256
    #[arg(long, value_name = "N", default_value_t = 4096, value_parser = reference_samples)]
    pub reference: u32,
    /// Also measure geometry alone: the methods and the reference read textures over a whole pixel
    #[arg(long)]
    pub geometry: bool,
    /// Also time the methods in made-up scenes whose number of triangles, pixels, superpixels or layers grows
    #[arg(long)]
    pub growth: bool,
    /// Also time the variants of the camera in each scene: planar, offset, superpixel and random sets of locations, and a panorama
    #[arg(long)]
    pub variants: bool,
    /// Also measure superpixels of 64 samples in each scene with other values of --contrast and --shading
    #[arg(long)]
    pub choices: bool,
    /// Measure the error and the flicker of these scenes in motion
    ///
    /// Each scene pans by fractions of a pixel for 16 frames, and turns slowly for 16 frames. Each frame has a reference of its own.
    #[arg(long, value_name = "SCENE", num_args = 1..)]
    pub motion: Vec<PathBuf>,
    /// Width and height of images in motion
    #[arg(long, value_name = "WxH", default_value = "320x180", value_parser = values::size)]
    pub motion_size: [u32; 2],
    /// Also run the stress suite: render geometry that is hard to rasterize, and check properties of the images
    #[arg(long)]
    pub stress: bool,
    /// Largest number of frames to time
    #[arg(long, value_name = "R", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    pub repeat: u32,
    /// Seconds for timing one method with one number of samples; at least one frame is timed
    #[arg(long, value_name = "SECONDS", default_value_t = 20.0, value_parser = budget)]
    pub budget: f64,
    /// Folder where references are kept [default: gpc in the user's cache folder]
    #[arg(long, value_name = "DIR")]
    pub cache: Option<PathBuf>,
    /// Part of the device's name, in upper or lower case [default: the best device]
    #[arg(long, value_name = "NAME")]
    pub device: Option<String>,
    #[command(flatten)]
    pub camera: CameraArgs,
}

impl BenchArgs {
    /// The methods and numbers of samples to measure, without duplicates, starting with one sample a pixel.
    pub fn cells(&self) -> Vec<(MethodKind, u32)> {
        let mut cells = Vec::new();
        for method in METHODS {
            if !self.methods.contains(&method) {
                continue;
            }
            if method == MethodKind::None {
                cells.push((method, 1));
                continue;
            }
            let mut counts = self.samples.clone();
            if method == MethodKind::Superpixel {
                counts.extend(&self.superpixel_samples);
            }
            counts.sort_unstable();
            counts.dedup();
            cells.extend(counts.into_iter().map(|count| (method, count)));
        }
        cells
    }

    /// Time limit for all frames of one method at one number of samples.
    pub fn budget(&self) -> Duration {
        Duration::from_secs_f64(self.budget)
    }
}

fn reference_samples(text: &str) -> Result<u32, String> {
    text.parse()
        .ok()
        .filter(|count: &u32| {
            (GRID_SAMPLES..=MAX_REFERENCE_SAMPLES).contains(count) && count.is_multiple_of(GRID_SAMPLES)
        })
        .ok_or_else(|| format!("expected a multiple of {GRID_SAMPLES} up to {MAX_REFERENCE_SAMPLES}"))
}

/// Parses a number of seconds that a [`Duration`] can hold.
fn budget(text: &str) -> Result<f64, String> {
    const MOST: f64 = 1e6;
    values::not_negative(text)
        .and_then(|seconds| if seconds <= MOST { Ok(seconds) } else { Err(format!("expected at most {MOST} seconds")) })
}

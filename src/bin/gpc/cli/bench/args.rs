//! The options of `gpc bench`.

use super::METHODS;
use crate::cli::values;
use clap::Args;
use gpc::bench::{GRID_SAMPLES, MAX_REFERENCE_SAMPLES};
use gpc::render::MethodKind;
use gpc::sampling::MAX_SAMPLES;
use std::path::PathBuf;
use std::time::Duration;

/// Measures the cost and the accuracy of the antialiasing methods.
///
/// Every scene is rendered as by `gpc render`, before a light grey background, by every method at every number of
/// samples that the method allows: once to warm up and then R times, the methods taking turns. Each image is compared
/// with a reference: supersampling at thousands of samples a pixel, each of which reads textures over 1/64 of a
/// pixel's width. References are kept on disk for the next run.
///
/// With --geometry, the methods are also measured with textures read over a whole pixel, against a reference that
/// reads them so too; the differences then come from geometry alone. With --motion, the flicker of moving images is
/// measured. With --variants, the sampling sets of the camera's variants are timed. With --growth, times are measured
/// while the size of a scene or image grows. With --stress, geometry that is hard to rasterize is rendered, and the
/// images are checked.
///
/// DIR then holds results.json, results.csv and report.html, and, with these options, motion.csv, variants.csv and
/// growth.csv. All are rewritten after each scene. Lines at the head of a CSV begin with # and say where its figures
/// come from.
#[derive(Args)]
pub struct BenchArgs {
    /// .glb or .gltf files
    #[arg(value_name = "SCENE", required_unless_present_any = ["motion", "growth", "stress"])]
    pub scenes: Vec<PathBuf>,
    /// Folder for the results
    #[arg(short, long, value_name = "DIR")]
    pub out: PathBuf,

    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = values::size)]
    pub size: [u32; 2],
    /// Methods to measure
    #[arg(
        long,
        value_name = "NAMES",
        value_delimiter = ',',
        default_value = "none,msaa,ssaa,superpixel"
    )]
    methods: Vec<MethodKind>,
    /// Samples a pixel; a method leaves out the numbers that it doesn't allow
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "4,16,64,256,1024",
        value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    samples: Vec<u32>,
    /// Samples a pixel of the reference, a multiple of 256
    #[arg(long, value_name = "N", default_value_t = 4096, value_parser = reference_samples)]
    pub reference: u32,
    /// Also measure every method with textures read over a whole pixel, against a reference that reads them so too
    #[arg(long)]
    pub geometry: bool,
    /// Also time the methods while the number of triangles, pixels, superpixels or layers grows, in scenes made for
    /// this
    #[arg(long)]
    pub growth: bool,
    /// Also time the camera's variants: planar, offset, superpixel and random sets and a panorama of each scene,
    /// beside the raster pass, in total and per sample
    #[arg(long)]
    pub variants: bool,
    /// Measure these files in motion: pan by fractions of a pixel and turn slowly, 16 frames each; report each frame's
    /// error against its own reference, and the flicker
    #[arg(long, value_name = "SCENE", num_args = 1..)]
    pub motion: Vec<PathBuf>,
    /// Width and height of images in motion
    #[arg(long, value_name = "WxH", default_value = "320x180", value_parser = values::size)]
    pub motion_size: [u32; 2],
    /// Also run the stress suite: geometry that is hard to rasterize, and properties that its images must have
    #[arg(long)]
    pub stress: bool,
    /// Most frames to time
    #[arg(long, value_name = "R", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    pub repeat: u32,
    /// Seconds for the frames of one method at one number of samples; at least one frame is timed
    #[arg(long, value_name = "SECONDS", default_value_t = 20.0, value_parser = budget)]
    pub budget: f64,
    /// Folder where references are kept [default: gpc in the user's cache folder]
    #[arg(long, value_name = "DIR")]
    pub cache: Option<PathBuf>,
    /// Part of the device's name, in upper or lower case [default: the best device]
    #[arg(long, value_name = "NAME")]
    pub device: Option<String>,
}

impl BenchArgs {
    /// The methods and numbers of samples to measure, without duplicates, starting with one sample a pixel.
    pub fn cells(&self) -> Vec<(MethodKind, u32)> {
        let mut counts = self.samples.clone();
        counts.sort_unstable();
        counts.dedup();
        let mut cells = Vec::new();
        for method in METHODS {
            if !self.methods.contains(&method) {
                continue;
            }
            if method == MethodKind::None {
                cells.push((method, 1));
            } else {
                cells.extend(counts.iter().map(|count| (method, *count)));
            }
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
            (GRID_SAMPLES..=MAX_REFERENCE_SAMPLES).contains(count)
                && count.is_multiple_of(GRID_SAMPLES)
        })
        .ok_or_else(|| {
            format!("expected a multiple of {GRID_SAMPLES} up to {MAX_REFERENCE_SAMPLES}")
        })
}

/// Parses a number of seconds that a [`Duration`] can hold.
fn budget(text: &str) -> Result<f64, String> {
    const MOST: f64 = 1e6;
    values::not_negative(text).and_then(|seconds| {
        if seconds <= MOST {
            Ok(seconds)
        } else {
            Err(format!("expected at most {MOST} seconds"))
        }
    })
}

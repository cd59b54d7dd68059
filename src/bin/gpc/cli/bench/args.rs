//! The options of `gpc bench`.

use super::METHODS;
use crate::cli::values;
use clap::Args;
use gpc::bench::{GRID_SAMPLES, MAX_REFERENCE_SAMPLES};
use gpc::render::Method;
use gpc::sampling::MAX_SAMPLES;
use std::path::PathBuf;
use std::time::Duration;

/// Measures what methods cost and how exact they are.
///
/// Every scene is rendered as by `gpc render`, before a light grey background, by every method at every number of
/// samples that it can have: once to warm up and then R times, the methods taking turns. Each image is held against
/// the truth: brute force at thousands of samples a pixel that read textures at a 64th of its side, which is kept on disk
/// for the next run.
///
/// With --geometry, the methods are also measured with textures read for a whole pixel, against a reference that does so
/// too, so that they differ by geometry alone. With --motion, sequences show what flickers. With --variants, other sampling
/// sets than the pixels of an image are timed too; with --growth, scenes made for it show what grows with what; with
/// --stress, geometry that is hard on a rasterizer shows what holds.
///
/// DIR then holds results.json, results.csv and report.html, and motion.csv, variants.csv and growth.csv with these options,
/// written anew after each scene. Lines at the head of a CSV begin with # and say where its figures come from.
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
    methods: Vec<Method>,
    /// Samples a pixel; methods that can't have a number are left out there
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "4,16,64,256,1024",
        value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    samples: Vec<u32>,
    /// Samples a pixel of the truth, a multiple of 256
    #[arg(long, value_name = "N", default_value_t = 4096, value_parser = reference_samples)]
    pub reference: u32,
    /// Measure geometry alone too: every method, and a reference of its own, reading textures for a whole pixel
    #[arg(long)]
    pub geometry: bool,
    /// Time also against the number of triangles, of pixels, of superpixels and of layers, in scenes made for it
    #[arg(long)]
    pub growth: bool,
    /// Time the variants of the camera too: of each scene planar, offset, superpixel and random sets and a panorama,
    /// beside the raster pass, a sample and in all
    #[arg(long)]
    pub variants: bool,
    /// Measure these files in motion: panned by fractions of a pixel and turned slowly, 16 frames each, the error of each
    /// frame against its own truth and how much it flickers
    #[arg(long, value_name = "SCENE", num_args = 1..)]
    pub motion: Vec<PathBuf>,
    /// Width and height of images in motion
    #[arg(long, value_name = "WxH", default_value = "320x180", value_parser = values::size)]
    pub motion_size: [u32; 2],
    /// Run the stress suite too: what must hold of images whatever the geometry
    #[arg(long)]
    pub stress: bool,
    /// Frames to time, at most
    #[arg(long, value_name = "R", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    pub repeat: u32,
    /// Seconds for the frames of one method at one number of samples, of which at least one frame is timed
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
    /// The methods and numbers of samples asked for, each once, one sample a pixel first.
    pub fn cells(&self) -> Vec<(Method, u32)> {
        let mut counts = self.samples.clone();
        counts.sort_unstable();
        counts.dedup();
        let mut cells = Vec::new();
        for method in METHODS {
            if !self.methods.contains(&method) {
                continue;
            }
            if method == Method::None {
                cells.push((method, 1));
            } else {
                cells.extend(counts.iter().map(|count| (method, *count)));
            }
        }
        cells
    }

    /// Time for the frames of a cell.
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

/// Seconds that a [`Duration`] can hold.
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

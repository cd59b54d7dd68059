//! The options of `gpc render`, in groups. Other commands share groups.

use super::image::ImageArgs;
use crate::cli::exit::Usage;
use crate::cli::report::ReportArgs;
use crate::cli::values::{self, Shard};
use clap::{Args, ValueEnum};
use glam::DVec3;
use gpc::output::VideoFormat;
use gpc::render::{CellOptions, Detection, Footprint, Method, MethodKind, PixelRect, Shading, SuperpixelOptions};
use gpc::sampling::{FilterShape, Pattern, PixelFilter};
use gpc::scene::PoseRequest;
use std::ops::RangeInclusive;
use std::path::PathBuf;

/// Options of `gpc render`.
#[derive(Args)]
pub struct RenderArgs {
    /// A glTF, OBJ, STL or PLY file, or - for standard input
    #[arg(id = "file", value_name = "SCENE")]
    pub scene: PathBuf,
    /// Image to write, or - for a PNG on standard output
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// With -o -, write frames one after the other in this format, for an encoder
    ///
    /// y4m is YUV4MPEG2: BT.709, limited range, 4:4:4, over black where there is no background. raw is RGBA: 8 bits a channel, sRGB,
    /// straight alpha.
    #[arg(long, value_name = "F", hide_short_help = true)]
    pub format: Option<VideoFormat>,
    /// Render only this part of the image, from column X and row Y on; its pixels equal those of the whole image
    #[arg(long, value_name = "X,Y,WxH", value_parser = values::region, help_heading = "Image", hide_short_help = true)]
    pub region: Option<PixelRect>,

    #[command(flatten)]
    pub filter: FilterArgs,
    #[command(flatten)]
    pub image: ImageArgs,
    #[command(flatten)]
    pub sequence: SequenceArgs,

    /// Render each image once to warm up and then R times, and report the medians of the times
    #[arg(long, value_name = "R", value_parser = clap::value_parser!(u32).range(1..), help_heading = "Report", hide_short_help = true)]
    pub repeat: Option<u32>,
    /// Report the time of each pass in every round
    ///
    /// A frame samples its superpixels in rounds. By default, one time named rounds covers all rounds after the first.
    #[arg(long, help_heading = "Report", hide_short_help = true)]
    pub time_rounds: bool,
    #[command(flatten)]
    pub report: ReportArgs,
}

/// How pixels are averaged.
#[derive(Args, Clone)]
#[command(next_help_heading = "Antialiasing")]
pub struct FilterArgs {
    /// Pixel filter: how much each place around a pixel's centre counts in its colour
    ///
    /// All filters except box reach into the pixels around, so that wires and edges show no beads.
    #[arg(long, value_name = "FILTER", default_value = "box", hide_short_help = true)]
    filter: FilterShape,
    /// Distance in pixels from a pixel's centre at which its filter ends, from 0.5 to 2.5; always 0.5 for box [default: 1 for tent, 1.5
    /// for blackman-harris, 2 for gaussian and mitchell]
    #[arg(long, value_name = "PX", allow_negative_numbers = true, value_parser = values::finite, hide_short_help = true)]
    filter_radius: Option<f64>,
}

impl FilterArgs {
    /// The pixel filter that is asked for.
    pub fn filter(&self) -> Result<PixelFilter, Usage> {
        let filter = PixelFilter::new(self.filter, self.filter_radius);
        filter.check().map_err(|error| Usage(format!("--filter-radius: {error}")))?;
        Ok(filter)
    }
}

/// How edges are antialiased.
#[derive(Args, Clone)]
#[command(next_help_heading = "Antialiasing")]
pub struct SamplingArgs {
    /// Method
    #[arg(long, value_name = "METHOD", default_value = "superpixel")]
    pub aa: MethodKind,
    /// Samples a pixel; for superpixel, the effort in each pixel that aliases [default: 64; 4 for msaa]
    ///
    /// superpixel takes 1 to 1024. With 64, it looks for triangles at 512 places of a pixel that aliases. Where colours vary, it computes
    /// light at 8 to 32 places. With 256, these are 2048 places and 32 to 128; with 1024, 4096 places and 64 to 256. ssaa takes square
    /// numbers up to 1024. accumulate and rotated take any number up to 1024. These three look for triangles and compute light at N places
    /// of every pixel. msaa takes what the device supports.
    #[arg(long, value_name = "N")]
    samples: Option<u32>,
    /// A pixel contrasts with a neighbour if they differ by more than this, in 8-bit sRGB codes [default: 6; 1 from 128
    /// samples on]
    #[arg(long, value_name = "T", hide_short_help = true)]
    pub contrast: Option<u8>,
    /// Which pixels become superpixels, and so get many samples
    #[arg(long, default_value = "contrast", hide_short_help = true)]
    pub detect: Detection,
    /// Where the samples of a superpixel lie: on straight lines (lines), or at points (sobol, lattice, korobov, grid or
    /// rotated)
    #[arg(long, value_name = "P", default_value = "lines", hide_short_help = true)]
    pub pattern: Pattern,
    /// Area over which textures are filtered
    #[arg(long, default_value = "sample", hide_short_help = true)]
    pub footprint: Footprint,
    /// How often a superpixel is shaded
    #[arg(long, default_value = "part", hide_short_help = true)]
    pub shading: Shading,
}

impl SamplingArgs {
    /// The method with so many samples and the options of superpixels asked for.
    pub fn method(&self, samples: u32) -> Method {
        match self.aa {
            MethodKind::Superpixel => self.superpixels(samples).into(),
            method => method.with_samples(samples),
        }
    }

    /// The options of superpixels asked for, with so many samples.
    pub fn superpixels(&self, samples: u32) -> SuperpixelOptions {
        SuperpixelOptions::new(samples)
            .pattern(self.pattern.clone())
            .shading(self.shading)
            .detection(self.detect)
            .contrast(self.contrast)
    }

    /// Checks the number of samples against the method, as far as that is independent of the device.
    pub fn check(&self) -> Result<(), Usage> {
        match (self.aa, self.samples()) {
            (MethodKind::None, samples) if samples != 1 => {
                Err(Usage(format!("none can't have {samples} samples a pixel; it can have 1")))
            }
            _ => Ok(()),
        }
    }

    /// The number of samples asked for, or otherwise the method's default.
    pub fn samples(&self) -> u32 {
        self.samples_or(match self.aa {
            MethodKind::None => 1,
            MethodKind::Msaa => 4,
            _ => CellOptions::DEFAULT_SAMPLES,
        })
    }

    /// The number of samples asked for, or otherwise `default`.
    pub fn samples_or(&self, default: u32) -> u32 {
        self.samples.unwrap_or(default)
    }
}

/// Camera and time of the scene.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "View")]
pub struct CameraArgs {
    /// Camera of the scene, or all [default: the first, if there is one]
    ///
    /// all renders an image for each camera. Without cameras, the default is a view of the whole scene.
    #[arg(long, value_name = "INDEX|NAME", conflicts_with_all = ["eye", "azimuth", "elevation", "zoom"])]
    pub camera: Option<String>,
    /// Position of a camera of your own
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector, hide_short_help = true,
        conflicts_with_all = ["azimuth", "elevation", "zoom"])]
    pub eye: Option<DVec3>,
    /// Point that the camera looks at [default: the scene's centre]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector, requires = "eye", hide_short_help = true)]
    pub target: Option<DVec3>,
    /// Direction that is up in the image [default: 0,1,0]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector, requires = "eye", hide_short_help = true)]
    pub up: Option<DVec3>,
    /// Vertical field of view in degrees [default: the camera's, or else 40]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = values::field_of_view, hide_short_help = true)]
    pub fov: Option<f64>,
    /// Show the whole scene from this angle around it [default: 35]
    ///
    /// At 0 the camera looks along -z, at 90 along -x.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = values::finite)]
    pub azimuth: Option<f64>,
    /// Show the whole scene from this angle above the horizon [default: 20]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = values::finite)]
    pub elevation: Option<f64>,
    /// Show the whole scene, enlarged by this factor [default: 1]
    #[arg(long, value_name = "F", value_parser = values::positive)]
    pub zoom: Option<f64>,
    /// Index of the scene, if the file has several [default: the file's default scene]
    #[arg(long, value_name = "N", hide_short_help = true)]
    pub scene: Option<usize>,
    /// Name of a variant of the materials [default: none]
    #[arg(long, value_name = "NAME", hide_short_help = true)]
    pub variant: Option<String>,
    /// Time of the animation in seconds
    #[arg(long, value_name = "S", default_value_t = 0.0, value_parser = values::not_negative)]
    pub time: f64,
    /// Name or index of the animation [default: the first, if a time is given]
    #[arg(long, value_name = "NAME", hide_short_help = true)]
    pub animation: Option<String>,
}

impl CameraArgs {
    /// Request for the pose at a time in seconds.
    pub fn request(&self, time: f64) -> PoseRequest {
        PoseRequest { scene: self.scene, animation: self.animation.clone(), time }
    }
}

/// Options for several images at once.
#[derive(Args)]
#[command(next_help_heading = "Sequences")]
pub struct SequenceArgs {
    /// Render the frames A to B of the animation, both included
    #[arg(long, value_name = "A..B", value_parser = values::frames, conflicts_with_all = ["turntable", "time"])]
    pub frames: Option<RangeInclusive<u32>>,
    /// Frames a second [default: 24]
    #[arg(long, value_name = "F", value_parser = values::rate, hide_short_help = true)]
    pub fps: Option<f64>,
    /// Render N images from all around
    ///
    /// The camera turns about the vertical axis through the point that it looks at.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub turntable: Option<u32>,
    /// Render only the I-th of N equal shares of the sequence: every N-th image, beginning with the I-th
    #[arg(long, value_name = "I/N", value_parser = values::shard, hide_short_help = true)]
    pub shard: Option<Shard>,
}

impl SequenceArgs {
    const DEFAULT_FPS: f64 = 24.0;

    /// Frames a second.
    pub fn fps(&self) -> f64 {
        self.fps.unwrap_or(Self::DEFAULT_FPS)
    }
}

/// Values of `--tonemap`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Tonemap {
    Neutral,
    None,
}

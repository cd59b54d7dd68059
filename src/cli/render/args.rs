//! The options of `gpc render`.

use super::image::ImageArgs;
use crate::cli::report::ReportArgs;
use crate::cli::values::{self, Shard};
use clap::{Args, ValueEnum};
use glam::DVec3;
use gpc::output::VideoFormat;
use gpc::render::{Coverage, Detection, Footprint, Method, PixelRect, Settings, Shading, Shadows};
use gpc::sampling::Pattern;
use serde::Serialize;
use std::fmt;
use std::ops::RangeInclusive;
use std::path::PathBuf;

/// Renders a scene to image files.
///
/// OUT's ending decides the format: .png (8 bits a channel), .16.png (16 bits), .jpg or .jpeg (over black where
/// there is no background, quality 95) and .exr (scene-linear, premultiplied, not tone-mapped, 32-bit floats). It may
/// hold {stem} (the scene's name), {camera} (the camera's name, or its index) and {frame} (four digits or more).
/// Files are written under a temporary name and renamed.
#[derive(Args)]
pub struct RenderArgs {
    /// A .glb or .gltf file, or - for standard input
    #[arg(id = "file", value_name = "SCENE")]
    pub scene: PathBuf,
    /// Image to write, or - for a PNG on standard output
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// What -o - writes instead of a PNG: frames one after the other, for an encoder. y4m is YUV4MPEG2, BT.709 in limited
    /// range, 4:4:4, over black where there is no background; raw is RGBA of 8 bits, sRGB with straight alpha
    #[arg(long, value_name = "F")]
    pub format: Option<Stream>,

    #[command(flatten)]
    pub image: ImageArgs,
    /// Render this part of the image alone, from column X and row Y on, to the same numbers as in the whole image
    #[arg(long, value_name = "X,Y,WxH", value_parser = values::region)]
    pub region: Option<PixelRect>,
    #[command(flatten)]
    pub sequence: SequenceArgs,

    /// Render once to warm up and then R times, and report medians
    #[arg(long, value_name = "R", value_parser = clap::value_parser!(u32).range(1..), help_heading = "Report")]
    pub repeat: Option<u32>,
    #[command(flatten)]
    pub report: ReportArgs,
}

/// How edges are antialiased.
#[derive(Args, Clone)]
#[command(next_help_heading = "Antialiasing")]
pub struct SamplingArgs {
    /// Method
    #[arg(long, default_value = "superpixel")]
    pub aa: Antialiasing,
    /// Samples a pixel: 1 to 1024 for superpixel, a square for ssaa, what the device has for msaa
    /// [default: 64; 4 for msaa]
    #[arg(long, value_name = "N")]
    samples: Option<u32>,
    /// Differences of neighbours above this are a contrast, in 8-bit sRGB code values
    /// [default: 6; 1 from 128 samples on]
    #[arg(long, value_name = "T")]
    contrast: Option<u8>,
    /// What makes a pixel a superpixel: a neighbour in a contrasting colour; one that also shows another triangle; or
    /// any neighbour that shows another triangle
    #[arg(long, default_value = "contrast")]
    pub detect: Detect,
    /// Where a superpixel's samples lie: lines, or as points: sobol, lattice, korobov, grid or rotated
    #[arg(long, value_name = "P", default_value = "lines")]
    pub pattern: Pattern,
    /// How samples become coverage: the exact area of triangles that are seen whole, or counts of samples alone
    #[arg(long, default_value = "area")]
    pub coverage: CoverageRule,
    /// What texture levels are chosen for: the part of a pixel that a shading place stands for, or the whole pixel. none
    /// and msaa have the pixel's at either
    #[arg(long, default_value = "sample")]
    pub footprint: TextureFootprint,
    /// Shade a superpixel once for each visible triangle, in up to 16 to 128 parts where colours vary, or once a sample
    #[arg(long, default_value = "part")]
    pub shading: ShadingRate,
}

impl SamplingArgs {
    /// The threshold asked for, if any.
    #[cfg(feature = "view")]
    pub fn asked_contrast(&self) -> Option<u8> {
        self.contrast
    }

    /// The number of samples asked for, if any.
    #[cfg(feature = "view")]
    pub fn asked_samples(&self) -> Option<u32> {
        self.samples
    }

    /// The threshold asked for, or the default for the number of samples.
    pub fn contrast(&self) -> u8 {
        self.contrast
            .unwrap_or_else(|| Settings::default_contrast(self.samples()))
    }

    /// The number of samples asked for, or the method's default.
    pub fn samples(&self) -> u32 {
        self.samples.unwrap_or(match self.aa {
            Antialiasing::None => 1,
            Antialiasing::Msaa => 4,
            Antialiasing::Superpixel | Antialiasing::Ssaa => Settings::DEFAULT_SAMPLES,
        })
    }
}

/// Where the scene is seen from, and when.
#[derive(Args, Clone, Default)]
#[command(next_help_heading = "View")]
pub struct CameraArgs {
    /// A camera of the scene by index or name, or all [default: the first, or else one that shows everything]
    #[arg(long, value_name = "INDEX|NAME", conflicts_with_all = ["eye", "azimuth", "elevation", "zoom"])]
    pub camera: Option<String>,
    /// Stand here
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector,
        conflicts_with_all = ["azimuth", "elevation", "zoom"])]
    pub eye: Option<DVec3>,
    /// Look there [default: the scene's centre]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector, requires = "eye")]
    pub target: Option<DVec3>,
    /// This direction is up [default: 0,1,0]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector, requires = "eye")]
    pub up: Option<DVec3>,
    /// Vertical field of view in degrees [default: the camera's, or else 40]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = values::field_of_view)]
    pub fov: Option<f64>,
    /// See the whole scene from this angle around it; 0 looks along -z, 90 along -x [default: 35]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = values::finite)]
    pub azimuth: Option<f64>,
    /// See the whole scene from this angle above the horizon [default: 20]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = values::finite)]
    pub elevation: Option<f64>,
    /// See the whole scene this much larger than fits [default: 1]
    #[arg(long, value_name = "F", value_parser = values::positive)]
    pub zoom: Option<f64>,
    /// Scene of the file by index [default: the file's own]
    #[arg(long, value_name = "N")]
    pub scene: Option<usize>,
    /// Variant of the materials by name [default: none]
    #[arg(long, value_name = "NAME")]
    pub variant: Option<String>,
    /// Moment of the animation in seconds
    #[arg(long, value_name = "S", default_value_t = 0.0, value_parser = values::not_negative)]
    pub time: f64,
    /// Animation by name or index [default: the first, where a time is given]
    #[arg(long, value_name = "NAME")]
    pub animation: Option<String>,
}

/// Several images in one go.
#[derive(Args)]
#[command(next_help_heading = "Sequences")]
pub struct SequenceArgs {
    /// Frames of the animation, both ends included
    #[arg(long, value_name = "A..B", value_parser = values::frames, conflicts_with_all = ["turntable", "time"])]
    pub frames: Option<RangeInclusive<u32>>,
    /// Frames a second [default: 24]
    #[arg(long, value_name = "F", value_parser = values::rate)]
    pub fps: Option<f64>,
    /// N images from all around, turning about the vertical axis through what the camera looks at
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub turntable: Option<u32>,
    /// Render the I-th of N equal shares of the sequence alone: every N-th image from the I-th on, I from 1 to N
    #[arg(long, value_name = "I/N", value_parser = values::shard)]
    pub shard: Option<Shard>,
}

impl SequenceArgs {
    const DEFAULT_FPS: f64 = 24.0;

    /// Frames a second.
    pub fn fps(&self) -> f64 {
        self.fps.unwrap_or(Self::DEFAULT_FPS)
    }
}

/// Values of `--format`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Stream {
    Y4m,
    Raw,
}

impl Stream {
    pub fn format(self) -> VideoFormat {
        match self {
            Self::Y4m => VideoFormat::Y4m,
            Self::Raw => VideoFormat::Raw,
        }
    }
}

/// Values of `--aa`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Antialiasing {
    /// One sample a pixel
    None,
    /// Many samples where the image aliases, one elsewhere
    Superpixel,
    /// Brute force: everything at k x k times the resolution
    Ssaa,
    /// The device's own multisampling
    Msaa,
}

impl Antialiasing {
    /// Every method.
    pub const ALL: [Self; 4] = [Self::None, Self::Msaa, Self::Ssaa, Self::Superpixel];

    pub fn method(self) -> Method {
        match self {
            Self::None => Method::None,
            Self::Superpixel => Method::Superpixel,
            Self::Ssaa => Method::Ssaa,
            Self::Msaa => Method::Msaa,
        }
    }
}

impl fmt::Display for Antialiasing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::None => "none",
            Self::Superpixel => "superpixel",
            Self::Ssaa => "ssaa",
            Self::Msaa => "msaa",
        })
    }
}

/// Values of `--footprint`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum TextureFootprint {
    Sample,
    Pixel,
}

impl TextureFootprint {
    pub fn footprint(self) -> Footprint {
        match self {
            Self::Sample => Footprint::Sample,
            Self::Pixel => Footprint::Pixel,
        }
    }
}

/// Values of `--detect`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Detect {
    Contrast,
    Edges,
    Exact,
}

impl Detect {
    pub fn detection(self) -> Detection {
        match self {
            Self::Contrast => Detection::Contrast,
            Self::Edges => Detection::Edges,
            Self::Exact => Detection::Exact,
        }
    }
}

/// Values of `--coverage`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum CoverageRule {
    Area,
    Samples,
}

impl CoverageRule {
    pub fn coverage(self) -> Coverage {
        match self {
            Self::Area => Coverage::Area,
            Self::Samples => Coverage::Samples,
        }
    }
}

/// Values of `--shading`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ShadingRate {
    Triangle,
    Part,
    Sample,
}

impl ShadingRate {
    pub fn shading(self) -> Shading {
        match self {
            Self::Triangle => Shading::Triangle,
            Self::Part => Shading::Part,
            Self::Sample => Shading::Sample,
        }
    }
}

/// Values of `--shadows`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Shadow {
    None,
    Exact,
}

impl Shadow {
    pub fn shadows(self) -> Shadows {
        match self {
            Self::None => Shadows::None,
            Self::Exact => Shadows::Exact,
        }
    }
}

/// Values of `--tonemap`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Tonemap {
    Neutral,
    None,
}

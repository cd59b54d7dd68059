//! The options that are common to all commands which make an image of a scene.

use super::args::{CameraArgs, SamplingArgs, Tonemap};
use super::save::format_of;
use crate::cli::exit::usage;
use crate::cli::input;
use crate::cli::values::{self, Background, EdgeLines};
use clap::{Args, ValueEnum};
use gpc::output::{AovKind, Format};
use gpc::render::{HeadlessOptions, Reference, Settings, Shadows};
use gpc::scene::{Edges, Environment, Loaded, Motion, Pose, SceneError};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Size, colour, sampling, view and device.
#[derive(Args, Clone)]
#[command(next_help_heading = "Image")]
pub struct ImageArgs {
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = values::size)]
    pub size: [u32; 2],
    /// How radiance becomes a display colour: by Khronos PBR Neutral, or clamped (none) [default: neutral; none for .exr]
    #[arg(long, hide_short_help = true)]
    pub tonemap: Option<Tonemap>,
    /// none (transparent), environment, #rrggbb or R,G,B
    ///
    /// R,G,B are sRGB values from 0 to 1.
    #[arg(long, value_name = "COLOUR", default_value = "none", value_parser = values::background)]
    pub background: Background,
    /// More values to write: depth, id, normal, superpixels, samples
    ///
    /// In an EXR they are layers besides the colours. Otherwise each is a PNG beside OUT, named like OUT with .depth (and so on) before
    /// .png.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', hide_possible_values = true)]
    pub aov: Vec<AovKind>,

    #[command(flatten)]
    pub appearance: AppearanceArgs,
    #[command(flatten)]
    pub sampling: SamplingArgs,
    #[command(flatten)]
    pub camera: CameraArgs,
    #[command(flatten)]
    pub device: DeviceArgs,
}

/// Light of a scene, and the drawing of its lines, points and edges.
#[derive(Args, Clone)]
#[command(next_help_heading = "Light and lines")]
pub struct AppearanceArgs {
    /// Brightness in stops: 1 is twice as bright
    #[arg(long, value_name = "EV", default_value_t = 0.0, allow_negative_numbers = true, value_parser = values::finite)]
    pub exposure: f64,
    /// Light from all around: an .hdr or .exr [default: a neutral studio]
    ///
    /// The image is equirectangular: its columns are longitudes, its rows latitudes.
    #[arg(long, value_name = "FILE")]
    pub environment: Option<PathBuf>,
    /// Degrees by which the environment is turned about the vertical axis, counter-clockwise seen from above
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true, value_parser = values::finite,
        requires = "environment", hide_short_help = true)]
    pub environment_rotation: f64,
    /// Shadows of the scene's own lights: none or exact
    ///
    /// They are tested exactly at every sample. An image takes several times as long.
    #[arg(long, value_name = "S", default_value = "none", hide_possible_values = true)]
    pub shadows: Shadows,
    /// Width of lines in pixels
    #[arg(long, value_name = "PX", default_value_t = 1.0, allow_negative_numbers = true, value_parser = values::stroke, hide_short_help = true)]
    pub line_width: f64,
    /// Diameter of points in pixels
    #[arg(long, value_name = "PX", default_value_t = 3.0, allow_negative_numbers = true, value_parser = values::stroke, hide_short_help = true)]
    pub point_size: f64,
    /// Draw edges of meshes as lines of this width in pixels
    ///
    /// Edges are silhouettes, boundaries and creases; an edge is a crease if its faces meet at more than 30 degrees. Lines are black
    /// unless a colour follows: R,G,B of 0 to 1, or #rrggbb.
    #[arg(long, value_name = "WIDTH[,COLOUR]", allow_negative_numbers = true, value_parser = values::edges)]
    pub edges: Option<EdgeLines>,
}

impl AppearanceArgs {
    /// The environment that is asked for, if any, and warnings about it.
    pub fn environment(&self) -> anyhow::Result<(Option<Arc<Environment>>, Vec<String>)> {
        let Some(file) = &self.environment else {
            return Ok((None, Vec::new()));
        };
        let (environment, warnings) = input::environment(file)?;
        let turned = environment.turned(self.environment_rotation.to_radians());
        Ok((Some(Arc::new(turned)), warnings))
    }

    /// The edges to draw, if any.
    pub fn edges(&self) -> Option<Edges> {
        self.edges.map(|edges| Edges { color: values::linear(edges.color), ..Edges::default() })
    }

    /// `settings` with this appearance.
    pub fn settings(&self, settings: Settings) -> Settings {
        settings
            .exposure(self.exposure as f32)
            .shadows(self.shadows)
            .line_width(self.line_width as f32)
            .point_size(self.point_size as f32)
            .edge_width(self.edges.map_or(1.0, |edges| edges.width) as f32)
    }
}

/// Device that renders.
#[derive(Args, Clone)]
#[command(next_help_heading = "Device")]
pub struct DeviceArgs {
    /// Part of the device's name, in upper or lower case [default: the best device]
    #[arg(long = "device", value_name = "NAME")]
    pub name: Option<String>,
    /// Bound on device memory, such as 512M or 2G
    #[arg(long, value_name = "BYTES", value_parser = values::bytes, hide_short_help = true)]
    pub max_memory: Option<u64>,
}

impl DeviceArgs {
    /// Options for opening the device. `GPC_VALIDATION` turns the validation layer on.
    pub fn options(&self) -> HeadlessOptions {
        let validation = std::env::var_os("GPC_VALIDATION").is_some_and(|value| !value.is_empty());
        HeadlessOptions::default().device(self.name.clone()).validation(validation)
    }
}

impl ImageArgs {
    /// Checks the options against each other, and returns the format of OUT.
    pub fn format(&self, output: &Path) -> anyhow::Result<Format> {
        self.sampling.check()?;
        if input::is_standard(output) && !self.aov.is_empty() {
            usage!("--aov writes files named after OUT, and -o - has no name");
        }
        let format = format_of(output)?;
        if format.is_scene_linear() && self.tonemap == Some(Tonemap::Neutral) {
            usage!("--tonemap neutral: an EXR holds light that is not tone-mapped");
        }
        Ok(format)
    }

    /// Loads a scene with the variant, the environment and the edges that the options name.
    pub fn load(&self, path: &Path) -> anyhow::Result<Loaded> {
        let (loaded, environment) =
            rayon::join(|| input::load(path, self.camera.variant.as_deref()), || self.appearance.environment());
        let mut loaded = loaded?;
        let (environment, warnings) = environment?;
        loaded.scene.environment = environment;
        loaded.warnings.extend(warnings);
        if let Some(edges) = self.appearance.edges() {
            loaded.scene.add_edges(&edges);
        }
        Ok(loaded)
    }

    /// Settings for images in this format.
    pub fn settings(&self, format: Format) -> Settings {
        let [width, height] = self.size;
        let tonemaps = self.tonemap != Some(Tonemap::None);
        let settings = Settings::new(width, height)
            .method(self.sampling.method(self.sampling.samples()))
            .footprint(self.sampling.footprint)
            .background(self.background.color())
            .reference(if tonemaps && !format.is_scene_linear() {
                Reference::Display
            } else {
                Reference::Scene { tonemapped_detection: tonemaps }
            })
            .attributes(!self.aov.is_empty())
            .max_memory(self.device.max_memory);
        self.appearance.settings(settings)
    }

    /// The AOVs to write, without duplicates.
    pub fn aovs(&self) -> Vec<AovKind> {
        AovKind::value_variants().iter().copied().filter(|kind| self.aov.contains(kind)).collect()
    }

    /// The scene's pose at a time in seconds.
    pub fn pose(&self, loaded: &Loaded, time: f64) -> Result<Pose, SceneError> {
        loaded.scene.pose(&self.camera.request(time))
    }

    /// The scene's pose at a time in seconds, and how it moves from then on.
    pub fn pose_in_motion(&self, loaded: &Loaded, time: f64) -> Result<(Pose, Motion), SceneError> {
        loaded.scene.pose_in_motion(&self.camera.request(time))
    }
}

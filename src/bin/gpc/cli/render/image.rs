//! The options that all commands share which make an image of a scene.

use super::args::{CameraArgs, SamplingArgs, Tonemap};
use crate::cli::exit::{Usage, usage};
use crate::cli::input;
use crate::cli::values::{self, Background, EdgeLines};
use clap::Args;
use gpc::output::{AovKind, Format};
use gpc::render::{Method, Reference, Settings, Shadows};
use gpc::scene::{Edges, Environment, Loaded, Motion, Pose, PoseRequest, SceneError};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Size, colour, sampling, view and device.
#[derive(Args, Clone)]
pub struct ImageArgs {
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = values::size)]
    pub size: [u32; 2],
    /// How radiance becomes display colour: Khronos PBR Neutral, or clamped [default: neutral; none for .exr]
    #[arg(long, hide_short_help = true)]
    pub tonemap: Option<Tonemap>,
    /// Behind the scene: none (transparent), #rrggbb, environment, or sRGB R,G,B of 0 to 1
    #[arg(long, value_name = "COLOUR", default_value = "none", value_parser = values::background)]
    pub background: Background,
    /// More of each pixel: depth, id, normal, superpixels, samples
    ///
    /// Layers of an EXR; otherwise PNG files beside OUT, named like it with .depth and so on before .png.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
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

/// How a scene is lit, and how its strokes are drawn.
#[derive(Args, Clone)]
#[command(next_help_heading = "Light and lines")]
pub struct AppearanceArgs {
    /// Brightness in stops: 1 is twice as bright
    #[arg(long, value_name = "EV", default_value_t = 0.0, allow_negative_numbers = true, value_parser = values::finite)]
    pub exposure: f64,
    /// Light from all around: an equirectangular .hdr or .exr [default: a neutral studio]
    #[arg(long, value_name = "FILE")]
    pub environment: Option<PathBuf>,
    /// Turn it about the vertical axis, counter-clockwise seen from above
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true, value_parser = values::finite,
        requires = "environment", hide_short_help = true)]
    pub environment_rotation: f64,
    /// Shadows of the scene's own lights
    ///
    /// They are exact at every sample, whatever the number and distance of the lights.
    #[arg(long, value_name = "S", default_value = "none")]
    pub shadows: Shadows,
    /// Width of lines in pixels of the image
    #[arg(long, value_name = "PX", default_value_t = 1.0, allow_negative_numbers = true, value_parser = values::stroke, hide_short_help = true)]
    pub line_width: f64,
    /// Diameter of points in pixels of the image
    #[arg(long, value_name = "PX", default_value_t = 3.0, allow_negative_numbers = true, value_parser = values::stroke, hide_short_help = true)]
    pub point_size: f64,
    /// Draw silhouettes, boundaries and creases as lines of this width in pixels
    ///
    /// Creases are of more than 30 degrees. Lines are black, or R,G,B of 0 to 1, or #rrggbb.
    #[arg(long, value_name = "WIDTH[,COLOUR]", allow_negative_numbers = true, value_parser = values::edges)]
    pub edges: Option<EdgeLines>,
}

impl AppearanceArgs {
    /// The environment asked for, if one is.
    pub fn environment(&self) -> anyhow::Result<Option<Arc<Environment>>> {
        let Some(file) = &self.environment else {
            return Ok(None);
        };
        let turned = input::environment(file)?.turned(self.environment_rotation.to_radians());
        Ok(Some(Arc::new(turned)))
    }

    /// The edges asked for, if any are.
    pub fn edges(&self) -> Option<Edges> {
        self.edges.map(|edges| Edges {
            color: values::linear(edges.color),
            ..Edges::default()
        })
    }

    /// The settings with this appearance.
    pub fn settings(&self, settings: Settings) -> Settings {
        Settings {
            exposure: self.exposure as f32,
            shadows: self.shadows,
            line_width: self.line_width as f32,
            point_size: self.point_size as f32,
            edge_width: self.edges.map_or(1.0, |edges| edges.width) as f32,
            ..settings
        }
    }
}

/// What renders.
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

impl ImageArgs {
    /// Refuses numbers of samples that the method can't have whatever the device.
    pub fn check_samples(&self) -> Result<(), Usage> {
        match (self.sampling.aa, self.sampling.samples()) {
            (Method::None, samples) if samples != 1 => Err(Usage(format!(
                "none can't have {samples} samples a pixel; it can have 1"
            ))),
            _ => Ok(()),
        }
    }

    /// Refuses what can't go together, and says in what format OUT is written.
    pub fn format(&self, output: &Path) -> anyhow::Result<Format> {
        self.check_samples()?;
        if input::is_standard(output) {
            if !self.aov.is_empty() {
                usage!("--aov writes files named after OUT, and -o - has no name");
            }
            return Ok(Format::Png8);
        }
        let format = Format::of(output).map_err(|error| Usage(format!("-o {error}")))?;
        if format.is_scene_linear() && self.tonemap == Some(Tonemap::Neutral) {
            usage!("--tonemap neutral: an EXR holds light that is not tone-mapped");
        }
        Ok(format)
    }

    /// Loads a scene with the variant, the environment and the edges asked for.
    pub fn load(&self, path: &Path) -> anyhow::Result<Loaded> {
        let (loaded, environment) = rayon::join(
            || input::load_variant(path, self.camera.variant.as_deref()),
            || self.appearance.environment(),
        );
        let mut loaded = loaded?;
        if let Some(environment) = environment? {
            loaded.scene.environment = Some(environment);
        }
        if let Some(edges) = self.appearance.edges() {
            loaded.scene.add_edges(&edges);
        }
        Ok(loaded)
    }

    /// Settings for images of a format.
    pub fn settings(&self, format: Format) -> Settings {
        let [width, height] = self.size;
        let tonemaps = self.tonemap != Some(Tonemap::None);
        self.appearance.settings(Settings {
            method: self.sampling.aa,
            samples: self.sampling.samples(),
            pattern: self.sampling.pattern.clone(),
            coverage: self.sampling.coverage,
            shading: self.sampling.shading,
            detection: self.sampling.detect,
            footprint: self.sampling.footprint,
            contrast: self.sampling.contrast,
            background: match self.background {
                Background::Transparent | Background::Environment => None,
                Background::Color(color) => Some(values::linear(color)),
            },
            reference: if tonemaps && !format.is_scene_linear() {
                Reference::Display
            } else {
                Reference::Scene
            },
            tonemapped_detection: tonemaps,
            attributes: !self.aov.is_empty(),
            max_memory: self.device.max_memory,
            ..Settings::new(width, height)
        })
    }

    /// The AOVs asked for, each once.
    pub fn aovs(&self) -> Vec<AovKind> {
        let asked = |kind: &AovKind| self.aov.contains(kind);
        AovKind::ALL.into_iter().filter(asked).collect()
    }

    /// The scene at a moment.
    pub fn pose(&self, loaded: &Loaded, time: f64) -> Result<Pose, SceneError> {
        loaded.scene.pose(&self.request(time))
    }

    /// The scene at a moment, and what moves from there on.
    pub fn pose_in_motion(&self, loaded: &Loaded, time: f64) -> Result<(Pose, Motion), SceneError> {
        loaded.scene.pose_in_motion(&self.request(time))
    }

    fn request(&self, time: f64) -> PoseRequest {
        PoseRequest {
            scene: self.camera.scene,
            animation: self.camera.animation.clone(),
            time,
        }
    }
}

//! Contents of `results.json`.

use super::BenchArgs;
use super::machine::{self, Machine};
use super::motion::MotionRatio;
use super::summary::Summary;
use gpc::bench::stress::Finding;
use gpc::bench::{Accuracy, Cost, Motion, Split, Spread, Steadiness, VariantCost, Within};
use gpc::render::Method;
use gpc::vulkan::Limits;
use serde::Serialize;

/// Results of one run.
#[derive(Serialize)]
pub struct Results {
    pub version: &'static str,
    /// Date on which the run began, universal time: `YYYY-MM-DD`.
    pub date: String,
    pub machine: Machine,
    pub device: String,
    pub driver: String,
    pub size: [u32; 2],
    /// Samples a pixel of the truth, and of the reference for geometry alone.
    pub reference_samples: u32,
    pub repeat: u32,
    pub budget_seconds: f64,
    /// Medians, of textured and of untextured scenes apart.
    pub summary: Vec<Summary>,
    pub scenes: Vec<SceneResults>,
    /// Superpixels in motion over supersampling.
    pub motion_summary: Vec<MotionRatio>,
    /// Errors in motion, scene by scene.
    pub motion: Vec<SceneMotion>,
    /// Time of the camera's variants, scene by scene.
    pub variants: Vec<SceneVariants>,
    /// Time against the size of things.
    pub growth: Vec<Curve>,
    /// Findings of the stress suite.
    pub stress: Vec<Stress>,
}

/// Accuracy and steadiness of methods in motion, of one scene.
#[derive(Serialize)]
pub struct SceneMotion {
    pub name: String,
    /// Whether a material of something drawn has a texture.
    pub textured: bool,
    pub size: [u32; 2],
    pub rows: Vec<MotionRow>,
    /// Notes of what was left out, and why.
    pub notes: Vec<String>,
}

/// Measurements of one method in one motion.
#[derive(Serialize)]
pub struct MotionRow {
    pub motion: Motion,
    pub method: Method,
    pub samples: u32,
    #[serde(flatten)]
    pub steadiness: Steadiness,
}

/// Costs of the camera's variants, of one scene.
#[derive(Serialize)]
pub struct SceneVariants {
    pub name: String,
    pub triangles: u64,
    /// The raster pass first.
    pub rows: Vec<VariantRow>,
    /// Notes of what was left out, and why.
    pub notes: Vec<String>,
}

/// Cost of a variant: in all, per sample and relative to the raster pass.
#[derive(Serialize)]
pub struct VariantRow {
    #[serde(flatten)]
    pub cost: VariantCost,
    /// Nanoseconds a sample on the device.
    pub gpu_ns: f64,
    /// Nanoseconds a sample by the clock.
    pub wall_ns: f64,
    /// Ratio of the device's time for a sample to that of the raster pass.
    pub gpu_ratio: f64,
    /// Time by the clock a sample over that of the raster pass.
    pub wall_ratio: f64,
}

/// A part of the stress suite.
#[derive(Serialize)]
pub struct Stress {
    pub about: &'static str,
    pub seconds: f64,
    pub findings: Vec<Finding>,
}

/// Costs while one quantity grows.
#[derive(Serialize)]
pub struct Curve {
    pub quantity: String,
    pub points: Vec<Point>,
    /// Notes of what was left out, and why.
    pub notes: Vec<String>,
}

/// Measurements of one scene of a curve.
#[derive(Serialize)]
pub struct Point {
    /// The quantity that grows.
    pub value: f64,
    pub size: [u32; 2],
    pub triangles: u64,
    /// Share of the pixels that are superpixels, where these were rendered.
    pub superpixel_fraction: Option<f64>,
    pub times: Vec<Time>,
}

/// Time of a method.
#[derive(Serialize)]
pub struct Time {
    pub method: Method,
    pub samples: u32,
    /// Milliseconds on the device.
    pub gpu_ms: Spread,
    /// Milliseconds by the clock.
    pub wall_ms: Spread,
}

/// Measurements of one scene.
#[derive(Serialize)]
pub struct SceneResults {
    pub name: String,
    pub file: String,
    pub triangles: u64,
    /// Whether a material of something drawn has a texture.
    pub textured: bool,
    /// Seconds that the truth took to render; `None` if it came from the cache.
    pub reference_seconds: Option<f64>,
    /// Notes of what was left out, and why.
    pub notes: Vec<String>,
    pub rows: Vec<Row>,
}

/// Measurements of one method at one number of samples.
#[derive(Serialize)]
pub struct Row {
    pub method: Method,
    pub samples: u32,
    #[serde(flatten)]
    pub cost: Cost,
    /// Device memory of scene and frame.
    pub memory_bytes: u64,
    /// Share of the pixels that are superpixels.
    pub superpixel_fraction: f64,
    /// Triangles in the lists of tiles.
    pub candidates: u64,
    /// Against the truth.
    pub accuracy: Accuracy,
    /// Accuracy with textures read for a whole pixel, against a reference that also reads them so; only if wanted.
    pub geometry: Option<Accuracy>,
    /// The error that is left by cause, where superpixels were measured.
    pub left: Option<Split>,
    /// Split of the remaining error by edges, texture and light, for superpixels.
    pub left_within: Option<Within>,
}

impl Results {
    pub fn new(args: &BenchArgs, limits: &Limits) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION"),
            date: machine::today(),
            machine: Machine::this(),
            device: limits.device_name.clone(),
            driver: limits.driver.clone(),
            size: args.size,
            reference_samples: args.reference,
            repeat: args.repeat,
            budget_seconds: args.budget,
            summary: Vec::new(),
            scenes: Vec::new(),
            motion_summary: Vec::new(),
            motion: Vec::new(),
            variants: Vec::new(),
            growth: Vec::new(),
            stress: Vec::new(),
        }
    }

    /// Where the figures of a CSV come from, as lines `# key: value` before it.
    pub fn head(&self, [width, height]: [u32; 2]) -> String {
        let Machine { cpu, threads, os } = &self.machine;
        let lines = [
            ("driver", self.driver.clone()),
            ("machine", format!("{cpu}, {threads} threads, {os}")),
            ("date", self.date.clone()),
            ("size", format!("{width}x{height}")),
            ("reference", self.reference_samples.to_string()),
            ("repeat", self.repeat.to_string()),
        ];
        let lines = lines.map(|(key, value)| format!("# {key}: {value}\n"));
        lines.concat()
    }
}

impl VariantRow {
    /// A row held against the raster pass.
    pub fn new(cost: VariantCost, raster: &VariantCost) -> Self {
        Self {
            cost,
            gpu_ns: cost.gpu_ns(),
            wall_ns: cost.wall_ns(),
            gpu_ratio: cost.gpu_ns() / raster.gpu_ns(),
            wall_ratio: cost.wall_ns() / raster.wall_ns(),
        }
    }
}

impl Point {
    /// The median of what a method took on the device, in milliseconds.
    pub fn ms(&self, method: Method) -> Option<f64> {
        let time = self.times.iter().find(|time| time.method == method)?;
        Some(time.gpu_ms.median)
    }
}

impl SceneMotion {
    /// The row of a motion under a method at a number of samples.
    pub fn row(&self, motion: Motion, method: Method, samples: u32) -> Option<&MotionRow> {
        let wanted = |row: &&MotionRow| {
            row.motion == motion && row.method == method && row.samples == samples
        };
        self.rows.iter().find(wanted)
    }
}

impl SceneResults {
    /// The row of a method at a number of samples.
    pub fn row(&self, method: Method, samples: u32) -> Option<&Row> {
        let wanted = |row: &&Row| row.method == method && row.samples == samples;
        self.rows.iter().find(wanted)
    }
}

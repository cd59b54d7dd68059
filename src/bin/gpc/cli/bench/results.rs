//! Contents of `results.json`.

use super::BenchArgs;
use super::gallery::Gallery;
use super::machine::{self, Machine};
use super::measurement::stress::Finding;
use super::measurement::{Accuracy, Cost, Motion, Split, Spread, Steadiness, Variant, Within};
use super::motion::{self, MotionSummary};
use super::summary::{self, Summary};
use gpc::render::MethodKind;
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
    /// Samples a pixel of the references.
    pub reference_samples: u32,
    pub repeat: u32,
    pub budget_seconds: f64,
    /// Medians over the scenes, those with and those without textures separately.
    pub summary: Vec<Summary>,
    pub scenes: Vec<SceneResults>,
    /// Superpixel / supersampling ratios in motion.
    pub motion_summary: Option<MotionSummary>,
    /// Errors in motion, scene by scene.
    pub motion: Vec<SceneMotion>,
    /// Time of the camera's variants, scene by scene.
    pub variants: Vec<SceneVariants>,
    /// Superpixels with other options, scene by scene.
    pub choices: Vec<SceneChoices>,
    /// Curves of time against the size of the scene or image.
    pub growth: Vec<ScalingCurve>,
    /// Findings of the stress suite.
    pub stress: Vec<Stress>,
}

/// Accuracy and steadiness of methods in motion, of one scene.
#[derive(Serialize)]
pub struct SceneMotion {
    pub name: String,
    /// Whether a visible material has a texture.
    pub textured: bool,
    pub size: [u32; 2],
    pub rows: Vec<MotionRow>,
    /// Notes on measurements that were left out, and why.
    pub notes: Vec<String>,
}

/// Measurements of one method in one motion.
#[derive(Serialize)]
pub struct MotionRow {
    pub motion: Motion,
    pub method: MethodKind,
    pub samples: u32,
    #[serde(flatten)]
    pub steadiness: Steadiness,
}

/// Costs of the camera's variants for one scene.
#[derive(Serialize)]
pub struct SceneVariants {
    pub name: String,
    pub triangles: u64,
    /// Costs, starting with the raster pass.
    pub rows: Vec<VariantRow>,
    /// Notes on measurements that were left out, and why.
    pub notes: Vec<String>,
}

/// Cost of a variant: of a run, per sample, and relative to the raster pass.
#[derive(Serialize)]
pub struct VariantRow {
    pub variant: Variant,
    /// Samples of one run.
    pub samples: u64,
    /// Milliseconds of a run on the device.
    pub gpu_ms: Spread,
    /// Wall-clock milliseconds of a run, from locations to values in host memory.
    pub wall_ms: Spread,
    /// Median device time per sample, in nanoseconds.
    pub gpu_ns: f64,
    /// Median wall-clock time per sample, in nanoseconds.
    pub wall_ns: f64,
    /// Variant / raster pass ratio of device time per sample.
    pub gpu_ratio: f64,
    /// Variant / raster pass ratio of wall-clock time per sample.
    pub wall_ratio: f64,
}

/// Measurements of superpixels with other options, of one scene.
#[derive(Serialize)]
pub struct SceneChoices {
    pub name: String,
    /// Whether a visible material has a texture.
    pub textured: bool,
    pub rows: Vec<ChoiceRow>,
}

/// Measurements of superpixels with one option changed.
#[derive(Serialize)]
pub struct ChoiceRow {
    /// Name of the option, as of the command's without dashes.
    pub option: &'static str,
    pub value: String,
    pub superpixel_fraction: f64,
    pub accuracy: Accuracy,
    pub cost: Cost,
}

/// A part of the stress suite.
#[derive(Serialize)]
pub struct Stress {
    pub about: &'static str,
    pub seconds: f64,
    pub findings: Vec<Finding>,
}

/// Times while one quantity grows.
#[derive(Serialize)]
pub struct ScalingCurve {
    pub quantity: String,
    pub rows: Vec<GrowthRow>,
    /// Notes on measurements that were left out, and why.
    pub notes: Vec<String>,
}

/// Cost of one method in one scene of a curve.
#[derive(Serialize)]
pub struct GrowthRow {
    /// Value of the quantity that grows.
    pub value: f64,
    pub size: [u32; 2],
    pub triangles: u64,
    /// Share of the pixels that are superpixels; `None` if superpixels were not rendered.
    pub superpixel_fraction: Option<f64>,
    pub method: MethodKind,
    pub samples: u32,
    #[serde(flatten)]
    pub cost: Cost,
}

/// Measurements of one scene.
#[derive(Serialize)]
pub struct SceneResults {
    pub name: String,
    pub file: String,
    pub triangles: u64,
    /// Whether a visible material has a texture.
    pub textured: bool,
    /// Share of the pixels whose centre sees an opaque or alpha-tested surface.
    pub surface_fraction: f64,
    /// Seconds that the reference took to render; `None` if it came from the cache.
    pub reference_seconds: Option<f64>,
    /// Notes on measurements that were left out, and why.
    pub notes: Vec<String>,
    pub rows: Vec<Row>,
    /// Pictures for the report.
    #[serde(skip)]
    pub gallery: Gallery,
}

/// Measurements of one method at one number of samples.
#[derive(Serialize)]
pub struct Row {
    pub method: MethodKind,
    pub samples: u32,
    #[serde(flatten)]
    pub cost: Cost,
    /// Bytes of device memory for scene and frame.
    pub memory_bytes: u64,
    /// Share of the pixels that are superpixels.
    pub superpixel_fraction: f64,
    /// Number of entries in the candidate lists of all tiles.
    pub candidates: u64,
    /// Accuracy against the reference.
    pub accuracy: Accuracy,
    /// Accuracy with textures read over a whole pixel, against a reference that reads them so too; `None` unless asked
    /// for.
    pub geometry: Option<Accuracy>,
    /// Share of the error that is left, by cause; `None` if superpixels were not measured.
    pub left: Option<Split>,
    /// Share of the error that is left, by fault (edges, texture or light); superpixels only.
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
            motion_summary: None,
            motion: Vec::new(),
            variants: Vec::new(),
            choices: Vec::new(),
            growth: Vec::new(),
            stress: Vec::new(),
        }
    }

    /// Summarises the scenes, and those in motion.
    pub fn summarize(&mut self) {
        self.summary = summary::summarize(&self.scenes);
        self.motion_summary = (!self.motion.is_empty()).then(|| motion::summarize(&self.motion));
    }

    /// Lines `# key: value` for the head of a CSV, which say where its figures come from. The images have the size
    /// `width` x `height`.
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
    /// A row relative to that of the raster pass; `None` for the raster pass itself.
    pub fn new(variant: Variant, samples: u64, cost: &Cost, raster: Option<&Self>) -> Self {
        let ns = |spread: &Spread| 1e6 * spread.median / samples as f64;
        let (gpu_ns, wall_ns) = (ns(&cost.gpu_ms), ns(&cost.wall_ms));
        Self {
            variant,
            samples,
            gpu_ms: cost.gpu_ms,
            wall_ms: cost.wall_ms,
            gpu_ns,
            wall_ns,
            gpu_ratio: raster.map_or(1.0, |raster| gpu_ns / raster.gpu_ns),
            wall_ratio: raster.map_or(1.0, |raster| wall_ns / raster.wall_ns),
        }
    }
}

impl SceneMotion {
    /// The row of a motion, a method and a number of samples.
    pub fn row(&self, motion: Motion, method: MethodKind, samples: u32) -> Option<&MotionRow> {
        let wanted = |row: &&MotionRow| row.motion == motion && row.method == method && row.samples == samples;
        self.rows.iter().find(wanted)
    }
}

impl SceneResults {
    /// The row of a method and a number of samples.
    pub fn row(&self, method: MethodKind, samples: u32) -> Option<&Row> {
        let wanted = |row: &&Row| row.method == method && row.samples == samples;
        self.rows.iter().find(wanted)
    }
}

//! Reports of commands on the images that they make.

mod effort;

pub use effort::Effort;

use super::exit::Usage;
use super::{input, print};
use clap::Args;
use gpc::render::Headless;
use serde::Serialize;
use std::path::Path;

/// Options for the amount of output.
#[derive(Args, Clone, Copy)]
pub struct ReportArgs {
    /// Print figures as one JSON object
    ///
    /// It has the file, size, samples, superpixels, times and memory of the image, or a list of these for several images.
    #[arg(long, help_heading = "Report")]
    pub json: bool,
    /// Print nothing but errors
    #[arg(long, help_heading = "Report")]
    pub quiet: bool,
}

impl ReportArgs {
    /// Refuses `--json` if the image itself goes to standard output.
    pub fn check(&self, output: &Path) -> Result<(), Usage> {
        if self.json && input::is_standard(output) {
            return Err(Usage("-o - and --json both want standard output".to_owned()));
        }
        Ok(())
    }

    /// Prints figures if `--json` is given.
    pub fn print(&self, figures: &impl Serialize) -> anyhow::Result<()> {
        if self.json {
            print::json(figures)?;
        }
        Ok(())
    }
}

/// The device that rendered.
#[derive(Clone, Serialize)]
pub struct DeviceReport {
    pub device: String,
    pub driver: String,
}

impl DeviceReport {
    pub fn of(headless: &Headless) -> Self {
        let limits = headless.gpu().limits();
        Self { device: limits.device_name.clone(), driver: limits.driver.clone() }
    }
}

/// Figures of an image. `T` holds the figures that only one command has.
#[derive(Serialize)]
pub struct Figures<T> {
    /// The file, or `-`.
    pub output: String,
    #[serde(flatten)]
    pub device: DeviceReport,
    /// Width and height of the image or part; of the image plane if the samples make no image.
    pub size: [u32; 2],
    #[serde(flatten)]
    pub effort: Effort,
    #[serde(flatten)]
    pub more: T,
    pub warnings: Vec<String>,
}

//! Reports of commands on the images that they make.

mod effort;

pub use effort::{Effort, RenderWork};

use super::exit::Usage;
use super::{input, print};
use clap::Args;
use gpc::render::Headless;
use serde::Serialize;
use std::path::Path;

/// Amount of reporting.
#[derive(Args, Clone, Copy)]
pub struct ReportArgs {
    /// Print figures as one JSON object
    ///
    /// They are files, sizes, samples, superpixels, times and memory; several images are a list.
    #[arg(long, help_heading = "Report")]
    pub json: bool,
    /// Say nothing but errors
    #[arg(long, help_heading = "Report")]
    pub quiet: bool,
}

impl ReportArgs {
    /// Refuses to print figures to the standard output that the image goes to.
    pub fn check(&self, output: &Path) -> Result<(), Usage> {
        if self.json && input::is_standard(output) {
            return Err(Usage(
                "-o - and --json both want standard output".to_owned(),
            ));
        }
        Ok(())
    }

    /// Prints figures, if they are wanted.
    pub fn print(&self, figures: &impl Serialize) -> anyhow::Result<()> {
        if self.json {
            print::json(figures)?;
        }
        Ok(())
    }
}

/// The device that rendered.
#[derive(Clone, Serialize)]
pub struct Device {
    pub device: String,
    pub driver: String,
}

impl Device {
    pub fn of(headless: &Headless) -> Self {
        let limits = headless.gpu().limits();
        Self {
            device: limits.device_name.clone(),
            driver: limits.driver.clone(),
        }
    }
}

/// Figures of a scene that was sampled at locations of the command's own choice; `T` holds what only that command can
/// say.
#[derive(Serialize)]
pub struct Figures<T> {
    /// The file, or `-`.
    pub output: String,
    #[serde(flatten)]
    pub device: Device,
    /// Width and height of the image, or of the image plane if samples make no image.
    pub size: [u32; 2],
    #[serde(flatten)]
    pub effort: Effort,
    #[serde(flatten)]
    pub more: T,
    pub warnings: Vec<String>,
}

//! Benchmark of camera variants: time per sample, compared with that of the raster pass.
//!
//! All variants of a scene are warmed up once and then run in turns. Only sampling is timed; locations are made once,
//! beforehand.

mod error;
mod work;

pub use error::VariantError;

use super::Spread;
use gpc::camera::Camera;
use gpc::render::{Headless, PreparedScene, RenderError, Settings};
use serde::Serialize;
use std::fmt;
use std::time::{Duration, Instant};
use work::VariantWork;

/// Camera variant: its locations, and the way in which they are sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Variant {
    /// Pixels' centres by the raster pass, which the other variants are compared with.
    Raster,
    /// Pixels' centres as a list of locations.
    Planar,
    /// Zoom into the middle of the image.
    Offset,
    /// Pixels' centres, and more samples in pixels that alias.
    Superpixel,
    /// Random locations.
    NoPattern,
    /// Panorama.
    Rig,
}

impl Variant {
    /// All variants, the raster pass first.
    pub const ALL: [Self; 6] = [Self::Raster, Self::Planar, Self::Offset, Self::Superpixel, Self::NoPattern, Self::Rig];

    /// Description of the variant for readers of a table.
    #[must_use]
    pub fn about(self) -> &'static str {
        match self {
            Self::Raster => {
                "the centre of each pixel by the raster pass: the planar render that the others are held against"
            }
            Self::Planar => "the same centres as locations of the engine that samples any location",
            Self::Offset => "one location a pixel, where a smooth zoom by 1 / 0.3 of the middle of the image sends it",
            Self::Superpixel => "two rates: the centres of pixels, and 64 samples in place of each that aliases",
            Self::NoPattern => "as many random locations as the image has pixels, in random order",
            Self::Rig => {
                "an equirectangular panorama of 360 x 180 degrees, as wide as the image, on the planes of six pinholes"
            }
        }
    }
}

impl fmt::Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Raster => "raster",
            Self::Planar => "planar",
            Self::Offset => "offset",
            Self::Superpixel => "superpixel",
            Self::NoPattern => "no-pattern",
            Self::Rig => "rig",
        })
    }
}

/// Cost of a variant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct VariantCost {
    /// Variant that was measured.
    pub variant: Variant,
    /// Samples of one run.
    pub samples: u64,
    /// Milliseconds of a run on the device.
    pub gpu_ms: Spread,
    /// Wall-clock milliseconds of a run, from locations to values in host memory.
    pub wall_ms: Spread,
}

impl VariantCost {
    /// Median device time per sample, in nanoseconds.
    #[must_use]
    pub fn gpu_ns(&self) -> f64 {
        1e6 * self.gpu_ms.median / self.samples as f64
    }

    /// Median wall-clock time per sample, in nanoseconds.
    #[must_use]
    pub fn wall_ns(&self) -> f64 {
        1e6 * self.wall_ms.median / self.samples as f64
    }
}

/// Camera variant that takes part in a measurement, warmed up; collects the times of its runs.
pub struct VariantContender {
    variant: Variant,
    work: VariantWork,
    samples: u64,
    gpu_ms: Vec<f64>,
    wall_ms: Vec<f64>,
}

impl VariantContender {
    /// Makes the locations of a variant for images of the settings' size, and runs it once without timing. The
    /// settings' method is ignored: the variant decides.
    ///
    /// # Errors
    /// [`VariantError`] if the camera has no such locations (an orthographic one has no panorama), or if they can't be
    /// sampled.
    pub fn warm_up(
        variant: Variant,
        headless: &mut Headless,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<Self, VariantError> {
        let mut work = VariantWork::new(variant, headless, scene, camera, settings)?;
        let done = work.run(headless, scene, camera)?;
        Ok(Self { variant, work, samples: done.samples, gpu_ms: Vec::new(), wall_ms: Vec::new() })
    }

    /// Runs every contender `repeat` times, in turns. A contender that would need more than `budget` drops out of
    /// later rounds, after at least one run.
    ///
    /// # Errors
    /// As [`Headless::render`].
    pub fn take_turns(
        contenders: &mut [Self],
        headless: &mut Headless,
        scene: &PreparedScene,
        camera: &Camera,
        repeat: u32,
        budget: Duration,
    ) -> Result<(), RenderError> {
        for _ in 0..repeat.max(1) {
            for contender in contenders.iter_mut() {
                if contender.goes_on(budget) {
                    contender.time_a_run(headless, scene, camera)?;
                }
            }
        }
        Ok(())
    }

    fn goes_on(&self, budget: Duration) -> bool {
        let spent: f64 = self.wall_ms.iter().sum();
        let fits = |last: &f64| spent + last <= 1e3 * budget.as_secs_f64();
        self.wall_ms.last().is_none_or(fits)
    }

    fn time_a_run(
        &mut self,
        headless: &mut Headless,
        scene: &PreparedScene,
        camera: &Camera,
    ) -> Result<(), RenderError> {
        let start = Instant::now();
        let done = self.work.run(headless, scene, camera)?;
        self.wall_ms.push(1e3 * start.elapsed().as_secs_f64());
        self.gpu_ms.push(done.gpu_ms);
        Ok(())
    }

    /// Cost of the runs so far.
    #[must_use]
    pub fn cost(&self) -> VariantCost {
        VariantCost {
            variant: self.variant,
            samples: self.samples,
            gpu_ms: Spread::of(self.gpu_ms.iter().copied()),
            wall_ms: Spread::of(self.wall_ms.iter().copied()),
        }
    }
}

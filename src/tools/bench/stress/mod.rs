//! The stress suite: geometry that is hard on a rasterizer, and what must hold of its images.
//!
//! Every check is made from seeds and says what it found as [`Finding`]s, in numbers. Tests run them short, `gpc bench
//! --stress` long.

mod coincident;
mod counting;
mod difference;
mod hostile;
mod invariance;
pub mod meshes;
mod motion;
mod near;
mod partition;
mod scale;
mod slivers;
mod soup;
pub mod stage;

pub use meshes::Mesh;
pub use soup::soup;

use super::Random;
use crate::render::{Headless, RenderError};
use serde::Serialize;

/// How much a check looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    /// Seconds on a CPU device.
    Short,
    /// Minutes: more than 10^8 samples in all.
    Long,
}

impl Length {
    /// One of two values.
    fn choose<T>(self, short: T, long: T) -> T {
        match self {
            Self::Short => short,
            Self::Long => long,
        }
    }
}

/// What a check found of one case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// What was rendered, and what was asked of it.
    pub case: String,
    /// How many samples, pixels or frames were looked at, see `unit`.
    pub checked: u64,
    /// What was counted or measured, and in what.
    pub unit: &'static str,
    /// The count or measure.
    pub measured: f64,
    /// The most that may be; `None` where a method is only measured for comparison.
    pub allowed: Option<f64>,
}

impl Finding {
    /// Whether it is within what may be.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.allowed.is_none_or(|allowed| self.measured <= allowed)
    }
}

/// A part of the suite.
#[derive(Clone, Copy, Debug)]
pub struct Check {
    /// What it is about.
    pub name: &'static str,
    run: fn(&mut Headless, Length) -> Result<Vec<Finding>, RenderError>,
}

impl Check {
    /// All parts.
    pub const ALL: [Self; 8] = [
        Self {
            name: "partition of unity",
            run: partition::check,
        },
        Self {
            name: "near plane and fields of view",
            run: near::check,
        },
        Self {
            name: "scale, origin and depth",
            run: scale::check,
        },
        Self {
            name: "coincident surfaces",
            run: coincident::check,
        },
        Self {
            name: "hostile vertices",
            run: hostile::check,
        },
        Self {
            name: "attributes of slivers",
            run: slivers::check,
        },
        Self {
            name: "invariance",
            run: invariance::check,
        },
        Self {
            name: "motion",
            run: motion::check,
        },
    ];

    /// Runs it.
    ///
    /// # Errors
    /// As [`Headless::render`].
    pub fn run(
        &self,
        headless: &mut Headless,
        length: Length,
    ) -> Result<Vec<Finding>, RenderError> {
        (self.run)(headless, length)
    }
}

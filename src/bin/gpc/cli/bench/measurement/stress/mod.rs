//! Stress suite: geometry that is hard to rasterize, and properties that its images must have.
//!
//! Every check is made from seeds and reports numbers as [`Finding`]s. Tests run the short suite, `gpc bench --stress`
//! the long one.

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

use gpc::render::{Headless, RenderError};
use serde::Serialize;

/// Length of a check: seconds on a CPU device, or minutes, in which more than 10^8 samples are checked.
#[derive(Clone, Copy, Debug)]
pub struct Length {
    pub is_long: bool,
}

impl Length {
    /// Picks one of two values.
    fn choose<T>(self, short: T, long: T) -> T {
        if self.is_long { long } else { short }
    }
}

/// Result of a check in one case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Scene, and the property that was checked.
    pub case: String,
    /// Number of samples, pixels or frames that were checked.
    pub checked: u64,
    /// Unit of `checked` and `measured`, such as samples.
    pub unit: &'static str,
    /// Measured count or error.
    pub measured: f64,
    /// Largest value of `measured` that is allowed; `None` if it is only measured for comparison.
    pub allowed: Option<f64>,
}

impl Finding {
    /// Whether `measured` is allowed.
    pub fn holds(&self) -> bool {
        self.allowed.is_none_or(|allowed| self.measured <= allowed)
    }
}

/// Check of the stress suite.
#[derive(Clone, Copy, Debug)]
pub struct Check {
    /// Name of the check.
    pub name: &'static str,
    run: fn(&mut Headless, Length) -> Result<Vec<Finding>, RenderError>,
}

impl Check {
    /// All checks.
    pub const ALL: [Self; 8] = [
        Self { name: "partition of unity", run: partition::check },
        Self { name: "near plane and fields of view", run: near::check },
        Self { name: "scale, origin and depth", run: scale::check },
        Self { name: "coincident surfaces", run: coincident::check },
        Self { name: "hostile vertices", run: hostile::check },
        Self { name: "attributes of slivers", run: slivers::check },
        Self { name: "invariance", run: invariance::check },
        Self { name: "motion", run: motion::check },
    ];

    /// Runs the check.
    ///
    /// # Errors
    /// As [`Headless::render`].
    pub fn run(&self, headless: &mut Headless, length: Length) -> Result<Vec<Finding>, RenderError> {
        (self.run)(headless, length)
    }
}

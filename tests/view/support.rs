//! A window on a display of its own, with real input.

mod density;
mod display;
mod loss;
mod monitors;
mod program;
mod viewer;
mod xdnd;

pub use density::Density;
pub use display::Display;
pub use loss::Loss;
pub use monitors::{Monitor, Monitors};
pub use program::Program;
pub use viewer::Viewer;
pub use xdnd::drop_file;

use std::time::Duration;

/// Generous: a software driver under validation, on a machine that may be busy.
pub const PATIENCE: Duration = Duration::from_secs(180);

//! The viewer in a window on a separate display, with real input.

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

/// Time limit for waiting. It is generous: a software driver under validation may run on a busy machine.
pub const PATIENCE: Duration = Duration::from_secs(180);

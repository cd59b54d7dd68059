//! Layouts of descriptor sets and pipelines, the pipelines made so far, and declarations of passes.

mod cache;
mod kernel;
mod layout;
mod pass;

pub(crate) use kernel::{Dispatch, Kernel, Size};
pub use layout::FrameLayout;
pub use pass::Pass;

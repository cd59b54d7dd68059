//! Layouts of descriptor sets and pipelines, and the pipelines made so far.

mod cache;
mod layout;

pub use layout::FrameLayout;

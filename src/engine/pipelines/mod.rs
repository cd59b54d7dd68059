//! Layouts of descriptor sets and pipelines, and the pipelines made so far.

mod cache;
pub(crate) mod layout;
pub(crate) mod lent_kernel;
pub(crate) mod own_layout;
pub(crate) mod pool;

pub use layout::FrameLayout;
pub(crate) use own_layout::{OwnSet, SetLayout};

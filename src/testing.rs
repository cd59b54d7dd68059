//! What the tests of single passes (`tests/gpu`) use of the engine's inside. It is no part of the library's interface, and
//! changes without notice.
//!
//! Passes, and the memory that they share, trust what they are given. They can be made with a [`Memory`] or [`FrameLayout`]
//! alone, and recorded with a [`Recorder`] alone: making one of these three is unsafe here, with the duties of all that
//! follows, so that safe code outside of the crate can't reach anything unsound.

pub use crate::engine::data::{
    Argument, CellSizes, Cells, Content, Counter, FrameUniform, ListedLocation, LocationSizes,
    Offsets, ResourceSizes, Resources,
};
pub use crate::engine::passes::{
    Distribute, ListLength, ListRegion, RasterTargets, RecordRate, Sample, SampleOptions, Schedule,
};
pub use crate::engine::pipelines::FrameLayout;
pub use crate::render::passes::prefilter;
pub use crate::vulkan::commands::Recorder;
pub use crate::vulkan::memory::{Buffer, Image, Memory, MemoryUse};

use crate::vulkan::{Gpu, VulkanError};
use std::sync::Arc;

/// An account of memory, of at most `limit` bytes.
///
/// # Safety
/// What is made with it has a size, format and usage that the device takes, is of the sizes that the passes it is given to
/// name, and is dropped, read or written by the CPU only while no commands use it.
pub unsafe fn memory(gpu: &Arc<Gpu>, limit: Option<u64>) -> Memory {
    Memory::new(gpu.clone(), limit)
}

/// The layout that passes share.
///
/// # Errors
/// If the driver refuses it.
///
/// # Safety
/// Passes are made with it with options that their documentation allows.
pub unsafe fn frame_layout(gpu: &Arc<Gpu>) -> Result<Arc<FrameLayout>, VulkanError> {
    FrameLayout::new(gpu)
}

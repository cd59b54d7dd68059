//! Internals of the engine for the tests of single passes (`tests/gpu`). They are not part of the library's interface,
//! and change without notice.
//!
//! Passes, and the memory that they share, trust their arguments. They can only be made with a [`Memory`] or
//! [`FrameLayout`], and only be recorded with a [`Recorder`]. Making one of these three is unsafe here, with the
//! duties of everything that follows, so that safe code outside of the crate can't cause undefined behaviour.

pub use crate::engine::data::{
    Argument, CellSizes, Cells, Content, Counter, Data, FrameUniform, ListedLocation, LocationSizes, Offsets,
    ResourceRequest, ResourceSizes, Resources, ShownIds,
};
pub use crate::engine::passes::{
    Distribute, FragmentRate, ListRegion, LongLists, RasterTargets, SampleBlocks, SampleOptions,
};
pub use crate::engine::pipelines::{FrameLayout, Pass};
pub use crate::engine::sampler::Load;
pub use crate::render::passes::prefilter;
pub use crate::render::random::Random;
pub use crate::vulkan::commands::Recorder;
pub use crate::vulkan::descriptor_set::BoundDescriptor;
pub use crate::vulkan::memory::{Buffer, Image, Memory, MemoryUse, TexelBuffer};

use crate::engine::passes::{schedule, tally};
use crate::engine::spirv::frame_set;
use crate::render::passes::merge;
use crate::vulkan::{Gpu, VulkanError};
use std::sync::Arc;

/// Allocator of at most `limit` bytes.
///
/// # Safety
/// Everything made with it has a size, format and usage that is valid for the device, has the sizes that the passes
/// which get it expect, and is dropped, read or written by the CPU only while no commands use it.
pub unsafe fn memory(gpu: &Arc<Gpu>, limit: Option<u64>) -> Memory {
    Memory::new(gpu.clone(), limit)
}

/// Layout that all passes share.
///
/// # Errors
/// If the driver refuses it.
///
/// # Safety
/// Passes are made with it with options that their documentation allows.
pub unsafe fn frame_layout(gpu: &Arc<Gpu>) -> Result<Arc<FrameLayout>, VulkanError> {
    FrameLayout::new(gpu)
}

/// The passes `tally` and `schedule` for tiles of these cells.
///
/// # Errors
/// If the driver refuses a pipeline.
pub fn load_passes(layout: &FrameLayout, cells: Cells, load: &Load) -> Result<[Pass; 2], VulkanError> {
    Ok([tally::pass(layout, cells, load.pushed())?, schedule::pass(layout, cells, load.pushed())?])
}

/// The pass `merge` for the cells of `blocks`, whose triangles have one part.
///
/// # Errors
/// If the driver refuses a pipeline.
pub fn merge_pass(layout: &FrameLayout, resources: &Resources, blocks: &SampleBlocks) -> Result<Pass, VulkanError> {
    merge::merge(layout, resources, blocks, false, false)
}

/// Shows a buffer as the triangles and instances of a scene, to passes that read none.
#[must_use]
pub fn triangles_of(unread: &TexelBuffer) -> [BoundDescriptor; 3] {
    [frame_set::TRIANGLES, frame_set::INSTANCE_OF, frame_set::INSTANCES]
        .map(|binding| (binding, unread.texels().into()))
}

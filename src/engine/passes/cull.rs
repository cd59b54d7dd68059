//! cull: finds the triangles that can touch a superpixel.

use super::arguments::{self, CountedBy};
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Filter for the triangles that are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CullFilter {
    /// Triangles that may touch a cell.
    Touching,
    /// Triangles that may touch a cell, and may be thin in some cell.
    Thin,
}

/// Lists triangles that pass the filter. If nothing was detected, no invocation runs.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(layout: &FrameLayout, scene: &dyn Content, filter: CullFilter) -> Result<Pass, VulkanError> {
    let shader = spirv::Cull { thin_alone: filter == CullFilter::Thin, instanced: scene.is_instanced() };
    Ok(Pass::named(spirv::Cull::INTERFACE)
        .dispatch(arguments::dispatch(layout, CountedBy::Detect)?)
        .dispatch(layout.kernel(&shader)?.dispatch((), Argument::Cull)))
}

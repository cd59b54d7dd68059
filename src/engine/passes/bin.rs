//! bin: makes pairs of triangles and the tiles that they touch.

use super::arguments::{self, CountedBy};
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Lists the pairs, and counts the pairs of each tile: first for small triangles, then for large ones.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(layout: &FrameLayout, scene: &dyn Content) -> Result<Pass, VulkanError> {
    let instanced = scene.is_instanced();
    let bin = layout.kernel(&spirv::Bin { instanced })?;
    Ok(Pass::named(spirv::Bin::INTERFACE).dispatch(arguments::dispatch(layout, CountedBy::Cull)?).unordered([
        bin.dispatch(spirv::BinPush { large: 0 }, Argument::BinSmall),
        bin.dispatch(spirv::BinPush { large: 1 }, Argument::BinLarge),
    ]))
}

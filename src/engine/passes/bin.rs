//! bin: makes pairs of triangles and the tiles that they touch.

use super::arguments::{self, CountedBy};
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Lists the pairs, and counts the pairs of each tile: of small triangles and of large ones.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(layout: &FrameLayout, scene: &dyn Content) -> Result<Pass, VulkanError> {
    let instanced = scene.is_instanced();
    let step = |step, argument: Argument| Ok(layout.kernel(&spirv::Bin { step, instanced })?.dispatch((), argument));
    Ok(Pass::named(spirv::Bin::INTERFACE)
        .dispatch(arguments::dispatch(layout, CountedBy::Cull)?)
        .dispatch(step(spirv::BIN_BUSY, Argument::BinBusy)?)
        .unordered([step(spirv::BIN_SMALL, Argument::BinSmall)?, step(spirv::BIN_LARGE, Argument::BinLarge)?]))
}

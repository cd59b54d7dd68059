//! sort: sorts visibility samples by material bin.

use super::arguments::{self, CountedBy};
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv::{self, frame_set};
use crate::vulkan::{Specialized, VulkanError};

/// Counting sort of a round's visibility samples. If they stay `unsorted`, because all have one bin or will be merged, the pass only
/// computes the sizes of dispatches over them.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(layout: &FrameLayout, scene: &dyn Content, unsorted: bool) -> Result<Pass, VulkanError> {
    let pass = Pass::named(spirv::Sort::INTERFACE)
        .clear(frame_set::BINS)
        .dispatch(arguments::dispatch(layout, CountedBy::Sample)?);
    if unsorted {
        return Ok(pass);
    }
    let teams = layout.gpu.limits().teams;
    let sort = layout.kernel(&spirv::Sort {
        local_size: teams.workgroup(),
        team: teams.members,
        teams: teams.in_workgroup,
        instanced: scene.is_instanced(),
    })?;
    Ok(pass
        .dispatch(sort.dispatch(spirv::SortPush { scatter: 0 }, Argument::Sort))
        .dispatch(arguments::dispatch(layout, CountedBy::Fragments)?)
        .dispatch(sort.dispatch(spirv::SortPush { scatter: 1 }, Argument::Sort)))
}

//! refine: divides the lists of crowded tiles among their pixels.

use crate::engine::data::Argument;
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Refines the lists that [`setup`](super::setup) has filled, in the order that is [`Scanned`](super::setup::ListOrder::Scanned).
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout) -> Result<Pass, VulkanError> {
    let teams = layout.gpu.limits().teams;
    let refine = layout.kernel(&spirv::Refine {
        local_size: teams.workgroup(),
        team: teams.members,
        teams: teams.in_workgroup,
    })?;
    Ok(Pass::named(spirv::Refine::INTERFACE).dispatch(refine.dispatch((), Argument::Tally)))
}

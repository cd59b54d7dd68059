//! composite: blends the layers that samples see.

use crate::engine::data::{Argument, ColorConstants};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Composites each list of layers in the visibility samples of the round. The resulting colour replaces that of the list's
/// leaf, where [`resolve`](super::resolve) reads it. `output` holds the colour constants of `shaders/include/color.glsl`.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, output: &ColorConstants) -> Result<Pass, VulkanError> {
    let teams = layout.gpu.limits().teams;
    let composite = layout.kernel(&spirv::Composite {
        local_size: teams.workgroup(),
        team: teams.members,
        teams: teams.in_workgroup,
        tinted: output.tinted,
        tonemap: output.tonemap,
    })?;
    Ok(Pass::named(spirv::Composite::INTERFACE).dispatch(composite.dispatch((), Argument::Sort)))
}

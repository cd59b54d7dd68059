//! multisample: turns the device's multisampling into visibility samples.

use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Turns multisampled triangle IDs into visibility samples, for the pixels of a region's tiles.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout) -> Result<Pass, VulkanError> {
    let teams = layout.gpu.limits().teams;
    let multisample =
        layout.kernel(&spirv::Multisample { teams: teams.in_workgroup, cells_of_entry: teams.members })?;
    let dispatch = multisample.dispatch((), Size::Items(1));
    Ok(Pass::named(spirv::Multisample::INTERFACE).dispatch(dispatch))
}

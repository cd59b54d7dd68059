//! enlist: gives the tiles of a round their places in its memory, and enters them in the work lists.

use crate::engine::data::{Argument, Cells};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Allocates the lists of a round's tiles, and lists its work, over the stretches of the round. `load` are the push constants of
/// `shaders/include/load.glsl`.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, cells: Cells, load: spirv::EnlistPush) -> Result<Pass, VulkanError> {
    let teams = layout.gpu.limits().teams;
    let enlist = layout.kernel(&spirv::Enlist {
        local_size: teams.workgroup(),
        team: teams.members,
        teams: teams.in_workgroup,
        cells_of_entry: teams.members,
        locations: cells.are_locations(),
    })?;
    Ok(Pass::named(spirv::Enlist::INTERFACE).dispatch(enlist.dispatch(load, Argument::Enlist)))
}

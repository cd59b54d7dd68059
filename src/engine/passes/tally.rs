//! tally: adds up what the tiles of each stretch need, so that `schedule` takes stretches instead of tiles.

use crate::engine::data::{Argument, Cells};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Adds up the needs of the tiles of each stretch, over all stretches. `load` are the push constants of
/// `shaders/include/load.glsl`.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, cells: Cells, load: spirv::TallyPush) -> Result<Pass, VulkanError> {
    let teams = layout.gpu.limits().teams;
    let tally = layout.kernel(&spirv::Tally {
        local_size: teams.workgroup(),
        team: teams.members,
        teams: teams.in_workgroup,
        cells_of_entry: teams.members,
        locations: cells.are_locations(),
        points: cells.are_points(),
    })?;
    Ok(Pass::named(spirv::Tally::INTERFACE).dispatch(tally.dispatch(load, Argument::Tally)))
}

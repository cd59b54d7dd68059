//! schedule: chooses the tiles of a round.

use super::enlist;
use crate::engine::data::Cells;
use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Adds tiles to a round as long as they fit, and then lists them with [`enlist`]. `load` are the push constants of
/// `shaders/include/load.glsl`.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(layout: &FrameLayout, cells: Cells, load: spirv::SchedulePush) -> Result<Pass, VulkanError> {
    // A single team works, so the largest one is the fastest.
    let all = layout.gpu.limits().teams;
    let teams = all.larger(32);
    let schedule = layout.kernel(&spirv::Schedule {
        local_size: all.workgroup(),
        team: teams.members,
        teams: all.in_workgroup,
        cells_of_entry: all.members,
        locations: cells.are_locations(),
        points: cells.are_points(),
    })?;
    Ok(Pass::named(spirv::Schedule::INTERFACE)
        .dispatch(schedule.dispatch(load, Size::One))
        .then(enlist::pass(layout, cells, load)?))
}

//! groups: lists the groups of cells of a round, for cells that are locations.

use super::SampleBlocks;
use super::arguments::{self, CountedBy};
use crate::engine::data::Argument;
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Lists groups by the kernel that their samples need, and computes the sizes of the dispatches over them. `blocks` are
/// those of [`sample`](super::sample).
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(layout: &FrameLayout, blocks: &SampleBlocks) -> Result<Pass, VulkanError> {
    let cells = blocks.options.cells;
    let groups = layout.kernel(&spirv::Groups {
        cells_of_entry: layout.gpu.limits().teams.members,
        locations: cells.are_locations(),
        points: cells.are_points(),
    })?;
    let sizes = arguments::of_samples(layout, CountedBy::Groups, blocks.teams)?;
    Ok(Pass::named(spirv::Groups::INTERFACE).dispatch(groups.dispatch((), Argument::Groups)).dispatch(sizes))
}

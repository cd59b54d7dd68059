//! scatter: finds the visible triangles of samples in tiles without a list of candidates.

use super::SampleBlocks;
use super::arguments::{self, CountedBy};
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Tests the triangles of a tile one by one, so that their number is not limited, for cells of these blocks.
/// The pass processes the tiles of the round that have no list. It overwrites the lists of candidates.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(layout: &FrameLayout, scene: &dyn Content, blocks: &SampleBlocks) -> Result<Pass, VulkanError> {
    /// Number of invocations of a workgroup, as in `shaders/scatter.comp`.
    const WORKGROUP: u32 = 64;
    let (options, members) = (&blocks.options, layout.gpu.limits().teams.members);
    let scatter = layout.kernel(&spirv::Scatter {
        team: members,
        teams: WORKGROUP / members,
        cells_of_entry: members,
        rows: blocks.block / members,
        has_mask: options.has_mask,
        has_blend: options.has_blend,
        locations: options.cells.are_locations(),
        points: options.cells.are_points(),
        instanced: scene.is_instanced(),
    })?;
    let step = |step, every, argument: Argument| scatter.dispatch(spirv::ScatterPush { step, every }, argument);
    let of_owners = |name| step(name, 0, Argument::Owners);
    let of_triangles = |name| [step(name, 0, Argument::Scatter), step(name, 1, Argument::ScatterEvery)];
    let nearest = Pass::named(spirv::Scatter::INTERFACE)
        .dispatch(of_owners(spirv::SCATTER_CLEAR))
        .unordered(of_triangles(spirv::SCATTER_DEPTHS))
        .unordered(of_triangles(spirv::SCATTER_IDS));
    if !options.has_blend {
        return Ok(nearest);
    }
    Ok(nearest
        .unordered(of_triangles(spirv::SCATTER_COUNT))
        .dispatch(of_owners(spirv::SCATTER_PLACE))
        .unordered(of_triangles(spirv::SCATTER_LAYERS))
        .dispatch(arguments::dispatch(layout, CountedBy::Scatter)?)
        .dispatch(step(spirv::SCATTER_ORDER, 0, Argument::Layers)))
}

//! scatter: finds the visible triangles of samples in tiles without a list of candidates.

use super::SampleOptions;
use super::arguments::{self, CountedBy};
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Tests the triangles of a tile one by one, so that their number is not limited, for the cells and the scene of `options`.
/// The pass processes the tiles of the round that have no list. It overwrites the lists of candidates.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(layout: &FrameLayout, scene: &dyn Content, options: &SampleOptions) -> Result<Pass, VulkanError> {
    let scatter = layout.kernel(&spirv::Scatter {
        cells_of_entry: layout.gpu.limits().teams.members,
        has_mask: options.has_mask,
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

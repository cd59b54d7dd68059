//! resolve: computes the colour of each superpixel.

use super::{SampleBlocks, TileList};
use crate::engine::data::{ColorConstants, HostImage};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};
use std::sync::Arc;

/// Later pass that reads more of the pass's output than the colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ResolveTarget {
    /// No such pass.
    Nothing,
    /// [`detect`](super::detect), which compares the resolved colours.
    Detect,
    /// [`grow`](super::grow), for which `resolve` marks neighbours that contrast.
    Grow,
}

/// Averages the visibility samples of each cell, for each tile list of `blocks`.
///
/// `target` is the later pass that reads more than the colours, and `output` holds the colour constants of
/// `shaders/include/color.glsl`. Samples that see no triangle take the colour of the host's image `behind`, or of
/// the background if it is `None`. Layers are composited only over the background, so `behind` must be `None` for
/// scenes that may have layers.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(
    layout: &FrameLayout,
    blocks: &SampleBlocks,
    target: ResolveTarget,
    output: &ColorConstants,
    behind: Option<&Arc<HostImage>>,
) -> Result<Pass, VulkanError> {
    let (options, cells) = (&blocks.options, blocks.options.cells);
    let mut pass = Pass::named(spirv::Resolve::INTERFACE);
    for list in blocks.lists() {
        let shader = spirv::Resolve {
            layered: options.has_blend && matches!(list, TileList::Blended | TileList::Unlisted),
            by_lines: options.by_lines() && list != TileList::Unlisted,
            locations: cells.are_locations(),
            encoded: behind.is_some_and(|image| image.encoded()),
            ..of_list(layout, list, blocks.block, target, output)
        };
        let code = match (behind, options.spread) {
            (Some(_), None) => spirv::RESOLVE_DRAWN,
            (Some(_), Some(_)) => spirv::RESOLVE_DRAWN_FILTERED,
            (None, Some(_)) => spirv::RESOLVE_FILTERED,
            (None, None) => spirv::RESOLVE,
        };
        let resolve = layout.kernel_variant(code, &shader)?;
        let dispatch = resolve.dispatch((), list.entries());
        pass = pass.dispatch(match behind {
            Some(image) => dispatch.with(&image.sets),
            None => dispatch,
        });
    }
    Ok(pass)
}

/// The pass for the visibility samples of `multisample`, where each cell has a single header.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn for_multisample(
    layout: &FrameLayout,
    samples: u32,
    output: &ColorConstants,
) -> Result<Pass, VulkanError> {
    let list = TileList::Plain;
    let shader = of_list(layout, list, samples, ResolveTarget::Nothing, output);
    let resolve = layout.kernel_variant(spirv::RESOLVE, &shader)?;
    Ok(Pass::named(spirv::Resolve::INTERFACE).dispatch(resolve.dispatch((), list.entries())))
}

/// Constants for the pixels of a list of tiles, whose blocks have `block` samples.
fn of_list(
    layout: &FrameLayout,
    list: TileList,
    block: u32,
    target: ResolveTarget,
    output: &ColorConstants,
) -> spirv::Resolve {
    let teams = layout.gpu.limits().teams;
    spirv::Resolve {
        local_size: teams.workgroup(),
        team: teams.members,
        teams: teams.in_workgroup,
        cells_of_entry: teams.members,
        block,
        layered: false,
        list: list as u32,
        display_codes: target == ResolveTarget::Detect,
        by_lines: false,
        grows: target == ResolveTarget::Grow,
        locations: false,
        tonemap: output.tonemap,
        tonemap_codes: output.tonemap_codes,
        encoded: false,
    }
}

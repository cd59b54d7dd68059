//! merge: merges visibility samples of a superpixel that see the same triangle in the same light.

use crate::engine::data::{Content, Data, Resources};
use crate::engine::passes::{FragmentRate, SampleBlocks, sort};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::sampler::{Shading, fragment_rate};
use crate::engine::spirv::{self, merge_set};
use crate::vulkan::{Specialized, VulkanError};
use std::sync::Arc;

/// Merges the visibility samples of a scene's cells to this rate, and sorts what is left. Arguments are otherwise those of [`merge`].
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(
    layout: &FrameLayout,
    scene: &dyn Content,
    resources: &Resources,
    blocks: &SampleBlocks,
    rate: Shading,
) -> Result<Pass, VulkanError> {
    let by_part = fragment_rate(rate, scene) == FragmentRate::Part;
    Ok(merge(layout, resources, blocks, scene.is_instanced(), by_part)?.then(sort::pass(layout, scene, false)?))
}

/// Merges the visibility samples of each cell, for each tile list of `blocks`, after their shadow words have been found. With
/// `by_part`, those of triangles whose light may change within a pixel are merged only within parts of the cell. Samples that are
/// left over see nothing afterwards. The scene has no BLEND triangles; `instanced` says whether it has instances.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn merge(
    layout: &FrameLayout,
    resources: &Resources,
    blocks: &SampleBlocks,
    instanced: bool,
    by_part: bool,
) -> Result<Pass, VulkanError> {
    let shown = [(merge_set::WORDS, resources.buffer(Data::ShadowWords).into())];
    // SAFETY: the buffer lives as long as the frame or the list to which the pass belongs.
    let own = Arc::new(unsafe { layout.own_set(spirv::Merge::INTERFACE, &shown) }?);
    let teams = layout.gpu.limits().teams;
    let mut pass = Pass::named(spirv::Merge::INTERFACE);
    for list in blocks.lists() {
        let merge = layout.kernel(&spirv::Merge {
            local_size: teams.workgroup(),
            team: teams.members,
            teams: teams.in_workgroup,
            cells_of_entry: teams.members,
            rows: blocks.block / teams.members,
            list: list as u32,
            by_part,
            part: blocks.options.part_samples(),
            locations: blocks.options.cells.are_locations(),
            instanced,
            shadow_words: resources.sizes().shadow_words,
        })?;
        pass = pass.dispatch(merge.dispatch((), list.entries()).with(&own));
    }
    Ok(pass)
}

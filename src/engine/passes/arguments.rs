//! arguments: turns the counts of a pass into the sizes of the dispatches that follow.

use crate::engine::pipelines::{Dispatch, FrameLayout, Size};
use crate::engine::spirv;
use crate::vulkan::VulkanError;

/// Pass whose counts are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(crate) enum CountedBy {
    Detect = spirv::AFTER_DETECT,
    Cull = spirv::AFTER_CULL,
    Sample = spirv::AFTER_SAMPLE,
    Fragments = spirv::AFTER_FRAGMENTS,
    Spans = spirv::AFTER_SPANS,
    Thin = spirv::AFTER_THIN,
    Groups = spirv::AFTER_GROUPS,
    Lines = spirv::AFTER_LINES,
    Pairs = spirv::AFTER_PAIRS,
    Scatter = spirv::AFTER_SCATTER,
}

/// Dispatch that writes the sizes of other dispatches. One kernel serves all passes that count, because drivers take longer
/// to compile a kernel than to run it.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn dispatch(layout: &FrameLayout, counted_by: CountedBy) -> Result<Dispatch, VulkanError> {
    of_samples(layout, counted_by, [1; 3])
}

/// [`dispatch`] for the entries of lists. An entry takes `first` teams of [`sample`](super::sample) in the first run, `left`
/// for cells that this run left, and `unlisted` for tiles without a list.
///
/// # Errors
/// As [`dispatch`].
pub(crate) fn of_samples(
    layout: &FrameLayout,
    counted_by: CountedBy,
    [first, left, unlisted]: [u32; 3],
) -> Result<Dispatch, VulkanError> {
    let pushed = spirv::ArgumentsPush {
        after: counted_by as u32,
        teams_first: first,
        teams_unlisted: unlisted,
        teams_left: left,
    };
    let shader = spirv::Arguments { teams: layout.gpu.limits().teams.in_workgroup };
    Ok(layout.kernel(&shader)?.dispatch(pushed, Size::One))
}

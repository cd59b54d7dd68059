//! spans: lists rows of 8 pixels by material bin.

use crate::engine::data::Content;
use crate::engine::passes::arguments::{self, CountedBy};
use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv::{self, frame_set};
use crate::vulkan::{Specialized, VulkanError};

/// Lists the pixels of a region that need shading, for its rows of 8 pixels. With a single bin, spans need not be counted
/// first.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(layout: &FrameLayout, scene: &dyn Content) -> Result<Pass, VulkanError> {
    let one_bin = scene.bin_count() == 1;
    let teams = layout.gpu.limits().teams;
    let spans = layout.kernel(&spirv::Spans {
        local_size: teams.workgroup(),
        team: teams.members,
        teams: teams.in_workgroup,
        one_bin,
        instanced: scene.is_instanced(),
    })?;
    let count = spans.dispatch(spirv::SpansPush { scatter: 0 }, Size::Items(1));
    let list = spans.dispatch(spirv::SpansPush { scatter: 1 }, Size::Items(1));
    let sizes = arguments::dispatch(layout, CountedBy::Spans)?;
    let pass = Pass::named(spirv::Spans::INTERFACE).clear(frame_set::BINS);
    Ok(if one_bin { pass.dispatch(list).dispatch(sizes) } else { pass.dispatch(count).dispatch(sizes).dispatch(list) })
}

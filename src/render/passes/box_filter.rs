//! box_filter: averages k x k supersampled pixels.

use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Averages squares of `side` x `side` pixels, for each pixel of the filtered region.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, side: u32) -> Result<Pass, VulkanError> {
    let filter = layout.kernel(&spirv::BoxFilter)?;
    let dispatch = filter.dispatch(spirv::BoxFilterPush { side }, Size::Items(1));
    Ok(Pass::named(spirv::BoxFilter::INTERFACE).dispatch(dispatch))
}

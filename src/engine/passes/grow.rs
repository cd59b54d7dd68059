//! grow: makes pixels superpixels if they contrast with a neighbouring superpixel.

use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Replaces the resolved superpixels in the masks by the pixels that [`resolve`](super::resolve) marked, for the tiles of a
/// region. Pixels in a border of `beyond` pixels around the region grow too, because a later growth compares with them.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, beyond: u32) -> Result<Pass, VulkanError> {
    let grow = layout.kernel(&spirv::Grow { beyond })?;
    Ok(Pass::named(spirv::Grow::INTERFACE).dispatch(grow.dispatch((), Size::Items(1))))
}

//! neighbours: finds cells of an output that contrast with a superpixel beside them.

use crate::engine::data::ColorConstants;
use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Marks cells for `grow` in an output whose superpixels are sampled as a list of locations, for all cells of the output.
/// `output` holds the constants that turn radiance into the image's colours.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, output: &ColorConstants) -> Result<Pass, VulkanError> {
    let neighbours =
        layout.kernel(&spirv::Neighbours { tonemap: output.tonemap, tonemap_codes: output.tonemap_codes })?;
    let dispatch = neighbours.dispatch((), Size::Items(1));
    Ok(Pass::named(spirv::Neighbours::INTERFACE).dispatch(dispatch))
}

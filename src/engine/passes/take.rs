//! take: reads a host's colour image, in which superpixels will be replaced.

use crate::engine::data::{ColorConstants, HostImage};
use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Reads the colours of a frame's pixels, and computes the codes that detection compares. `output` are the colour constants
/// of `shaders/include/color.glsl`.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, image: &HostImage, output: &ColorConstants) -> Result<Pass, VulkanError> {
    let take = layout.kernel(&spirv::Take {
        encoded: image.encoded(),
        tonemap: output.tonemap,
        tonemap_codes: output.tonemap_codes,
    })?;
    Ok(Pass::named(spirv::Take::INTERFACE).dispatch(take.dispatch((), Size::Items(1)).with(&image.sets)))
}

//! attributes: writes depth, ID, normal and number of samples of every pixel, on request.

use crate::engine::data::Content;
use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Writes two vectors for each pixel of a region: see `shaders/attributes.comp`. `superpixels` says whether there are
/// superpixels, `grown` whether `grow` has added some.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(
    layout: &FrameLayout,
    scene: &dyn Content,
    superpixels: bool,
    grown: bool,
) -> Result<Pass, VulkanError> {
    let attributes = layout.kernel(&spirv::Attributes { superpixels, grown, instanced: scene.is_instanced() })?;
    let dispatch = attributes.dispatch((), Size::Items(1));
    Ok(Pass::named(spirv::Attributes::INTERFACE).dispatch(dispatch))
}

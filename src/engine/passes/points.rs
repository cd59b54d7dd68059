//! points: writes colour and attributes of locations that are sampled once.

use crate::engine::data::{Argument, ColorConstants, Content};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Writes a colour and, on request, two vectors of attributes for each location, as `shaders/points.comp` describes, for the
/// visibility samples of the round.
///
/// `output` holds the colour constants of `shaders/include/color.glsl`, `attributes` says whether attributes are written,
/// and places have `shadow_words` words of shadows.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(
    layout: &FrameLayout,
    scene: &dyn Content,
    output: &ColorConstants,
    attributes: bool,
    shadow_words: u32,
) -> Result<Pass, VulkanError> {
    let points = layout.kernel(&spirv::Points {
        attributes,
        tinted: output.tinted,
        locations: true,
        instanced: scene.is_instanced(),
        shadow_words,
        tonemap: output.tonemap,
        tonemap_codes: output.tonemap_codes,
    })?;
    Ok(Pass::named(spirv::Points::INTERFACE).dispatch(points.dispatch((), Argument::Fragments)))
}

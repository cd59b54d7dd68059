//! thin: finds pixels that a thin triangle crosses without covering the centre.

use super::arguments::{self, CountedBy};
use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Marks pixels that `detect` turns into superpixels, for the triangle slots of a scene. `blend_ids` says whether BLEND
/// triangles are looked up in the IDs of the nearest BLEND triangles. `folds` says whether pixels are marked in which a
/// thin triangle lies at an angle to the surface that the centre sees. `depth_of_image` holds the factor and the offset that
/// convert values of the depth image to reversed depth, in which larger values are nearer.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(
    layout: &FrameLayout,
    scene: &dyn Content,
    blend_ids: bool,
    folds: bool,
    [depth_factor, depth_constant]: [f32; 2],
) -> Result<Pass, VulkanError> {
    let thin = |select| layout.kernel(&spirv::Thin { select, blend_ids, folds, instanced: scene.is_instanced() });
    let (select, walk) = (thin(true)?, thin(false)?);
    let pushed = |long| spirv::ThinPush { long, depth_factor, depth_constant };
    let of_slots = Size::Items(spirv::THIN_PER_INVOCATION);
    Ok(Pass::named(spirv::Thin::INTERFACE)
        .dispatch(select.dispatch(pushed(0), of_slots))
        .dispatch(arguments::dispatch(layout, CountedBy::Thin)?)
        .unordered([walk.dispatch(pushed(0), Argument::Thin), walk.dispatch(pushed(1), Argument::ThinLong)]))
}

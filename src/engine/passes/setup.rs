//! setup: computes edge functions of triangles around the tiles that they touch.

use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Fills the lists of candidates that `enlist` has allocated, for all pairs.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, scene: &dyn Content) -> Result<Pass, VulkanError> {
    let instanced = scene.is_instanced();
    let setup = layout.kernel(&spirv::Setup { instanced })?;
    Ok(Pass::named(spirv::Setup::INTERFACE).dispatch(setup.dispatch((), Argument::Setup)))
}

//! setup: computes edge functions of triangles around the tiles that they touch.

use crate::engine::data::{Argument, Content};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv;
use crate::vulkan::{Specialized, VulkanError};

/// Order in which lists hold the vectors of their candidates: see `shaders/include/candidate.glsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ListOrder {
    /// Candidate by candidate.
    Whole,
    /// The last vectors first, for passes that search lists for the few candidates which they need.
    Scanned,
}

/// Fills the lists of candidates that `enlist` has allocated, for all pairs.
///
/// # Errors
/// If the driver refuses the pipeline.
pub(crate) fn pass(layout: &FrameLayout, scene: &dyn Content, order: ListOrder) -> Result<Pass, VulkanError> {
    let setup =
        layout.kernel(&spirv::Setup { scanned: order == ListOrder::Scanned, instanced: scene.is_instanced() })?;
    Ok(Pass::named(spirv::Setup::INTERFACE).dispatch(setup.dispatch((), Argument::Setup)))
}

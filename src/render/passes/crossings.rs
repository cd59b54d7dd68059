//! crossings: finds cells of a list that a thin triangle crosses without covering the location.

use crate::engine::data::{Argument, Content, Data, Resources};
use crate::engine::passes::arguments::{self, CountedBy};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::spirv::{self, crossings_set};
use crate::vulkan::{Buffer, Specialized, VulkanError};
use std::sync::Arc;

/// Surfaces at a location, and the cell to which it belongs; the layout is that of `shaders/crossings.comp`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SeenLocation {
    /// Distance along the view direction in world units; 0 for background.
    pub distance: f32,
    /// ID of the nearest opaque or MASK triangle; 0 for background.
    pub id: u32,
    /// ID of the nearest BLEND triangle in front of it; 0 for none.
    pub blend_id: u32,
    /// Index of the location's cell in the output, row by row.
    pub output: u32,
}

/// The output whose cells are marked: its size in tiles of 8 x 4 cells, its width in cells, and the width of a `pixel`
/// of the plane in world units, at distance 1 or, for parallel rays, at any distance.
pub use crate::engine::spirv::CrossingsPush as MarkedOutput;

/// Marks crossed cells for `detect`, which makes them superpixels, after `bin` for lists of locations in a scene. `seen` has a
/// [`SeenLocation`] for each location; cells of `output` are marked in `marks`, two words for each of its tiles. `folds` says
/// whether cells are marked in which a thin triangle lies at an angle to the surface that the location sees.
///
/// # Errors
/// If the driver refuses a pipeline.
///
/// # Safety
/// Both buffers outlive the execution of what is recorded, and have room for the locations and for the tiles of `output`.
pub(crate) unsafe fn pass(
    layout: &FrameLayout,
    scene: &dyn Content,
    resources: &Resources,
    seen: &Buffer,
    marks: &Buffer,
    output: MarkedOutput,
    folds: bool,
) -> Result<Pass, VulkanError> {
    let shown = [
        (crossings_set::LOADS, resources.buffer(Data::Loads).into()),
        (crossings_set::SEEN, seen.into()),
        (crossings_set::CELL_MARKS, marks.into()),
    ];
    let crossings =
        layout.kernel(&spirv::Crossings { blend_ids: scene.has_blend(), folds, instanced: scene.is_instanced() })?;
    // SAFETY: guaranteed by the caller; the first buffer lives as long as the resources.
    let own = Arc::new(unsafe { layout.own_set(spirv::Crossings::INTERFACE, &shown) }?);
    Ok(Pass::named(spirv::Crossings::INTERFACE)
        .dispatch(arguments::dispatch(layout, CountedBy::Pairs)?)
        .dispatch(crossings.dispatch(output, Argument::Thin).with(&own)))
}

//! distribute: the sample locations of a list to tiles, cells and groups of cells.

use super::spirv::{self, distribute_set};
use crate::engine::data::CellSizes;
use crate::engine::data::{Argument, Cells, Resources};
use crate::engine::pipelines::FrameLayout;
use crate::engine::pipelines::own_layout::{OwnSet, PipelineLayout, SetLayout};
use crate::vulkan::{Buffer, Pipeline, Recorder, Specialized, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Steps of the shader, in their order.
const STEPS: u32 = 4;
/// Those that go over tiles and cells; the others go over locations.
const LAY_OUT: u32 = 1;
const ENCLOSE: u32 = 3;

/// A list of sample locations, of which those count that lie in a region of the plane: on pixels from (0, 0) on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ListRegion {
    /// The region in tiles of 8 x 4 pixels.
    pub tiles: [u32; 2],
    /// Locations in the list.
    pub count: u32,
}

/// How long a list is.
#[derive(Clone, Copy)]
pub enum ListLength<'a> {
    /// As its region says.
    Known,
    /// That at the most: there are as many workgroups of locations as an indirect dispatch has.
    Counted(&'a Buffer, Argument),
}

/// Sorts one list after another into the same memory.
pub struct Distribute {
    steps: Vec<Arc<Pipeline>>,
    layout: PipelineLayout,
    set: OwnSet,
    sizes: CellSizes,
    _set_layout: SetLayout,
}

impl Distribute {
    /// Makes the pipelines, and a set that shows `locations` and what `resources` have for locations.
    ///
    /// # Errors
    /// If the driver refuses one.
    ///
    /// # Safety
    /// The view of `locations` outlives this, and shows as many as the resources have room for.
    pub unsafe fn new(
        layout: &FrameLayout,
        cells: Cells,
        sizes: CellSizes,
        resources: &Resources,
        locations: vk::BufferView,
    ) -> Result<Self, VulkanError> {
        let gpu = &layout.gpu;
        let (buffers, texels) = resources.location_buffers(locations);
        let set_layout = SetLayout::new(gpu, &distribute_set::ALL)?;
        let own_layout = PipelineLayout::new(
            gpu,
            &[set_layout.raw],
            spirv::Distribute::INTERFACE.push_bytes,
        )?;
        let step = |step: u32| {
            let points = cells.are_points();
            own_layout.compute(layout, &spirv::Distribute { step, points })
        };
        let steps = (0..STEPS).map(step).collect::<Result<_, _>>()?;
        let set = set_layout.allocate()?;
        // SAFETY: the set is new; of the list as the caller says, the rest goes with the resources.
        unsafe {
            set.write_buffers(&buffers);
            set.write_texels(&texels);
        }
        Ok(Self {
            steps,
            layout: own_layout,
            set,
            sizes,
            _set_layout: set_layout,
        })
    }

    /// Records it; afterwards the frame's set is no longer bound.
    pub fn record(&self, recorder: &Recorder<'_>, region: &ListRegion, length: ListLength<'_>) {
        let push = spirv::DistributePush {
            tiles: region.tiles,
            count: region.count,
            in_cell: self.sizes.in_cell,
            in_group: self.sizes.in_group,
            samples: self.sizes.samples,
        };
        self.layout.bind(recorder, &[self.set.raw], &push);
        for (step, pipeline) in (0..).zip(&self.steps) {
            let tiles = region.tiles[0] * region.tiles[1];
            let invocations = match (step, length) {
                (LAY_OUT, _) => tiles,
                (ENCLOSE, _) => self.sizes.most_cells(region.count, tiles),
                (_, ListLength::Known) => region.count,
                (_, ListLength::Counted(arguments, argument)) => {
                    recorder.dispatch_indirect(pipeline, arguments, argument as u32);
                    continue;
                }
            };
            recorder.dispatch(pipeline, u64::from(invocations.div_ceil(64)));
        }
    }
}

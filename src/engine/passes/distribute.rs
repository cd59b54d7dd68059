//! distribute: sorts the sampling locations of a list into tiles, cells and groups of cells. It is no
//! [`Pass`](crate::engine::pipelines::Pass), because the length and region of a list are known only when it is recorded.

use crate::engine::data::{CellSizes, Cells, Data, Resources, SampleSet};
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv;
use crate::vulkan::{Descriptor, DescriptorSets, Recorder, Specialized, VulkanError};

/// Steps of the shader, in their order.
const STEPS: [u32; 4] =
    [spirv::DISTRIBUTE_NUMBER, spirv::DISTRIBUTE_LAY_OUT, spirv::DISTRIBUTE_ARRANGE, spirv::DISTRIBUTE_ENCLOSE];

/// Size of a list of sampling locations, and of the region of the plane, from pixel (0, 0) on, in which its locations
/// are sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ListRegion {
    /// Size of the region in tiles of 8 x 4 pixels.
    pub tiles: [u32; 2],
    /// Number of locations in the list.
    pub count: u32,
}

/// Sorts one list after another into the same memory.
pub struct Distribute {
    steps: Vec<Kernel<spirv::Distribute>>,
    own: DescriptorSets,
    sizes: CellSizes,
}

impl Distribute {
    /// Makes the pipelines, and a set with the buffers of `resources` for locations.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        cells: Cells,
        sizes: CellSizes,
        resources: &Resources,
    ) -> Result<Self, VulkanError> {
        // SAFETY: the list lives as long as the other buffers, and has room for as many locations.
        unsafe { Self::of_lent(layout, cells, sizes, resources, resources.texels(Data::Locations)) }
    }

    /// As [`Self::new`], for a list with another owner.
    ///
    /// # Errors
    /// As [`Self::new`].
    ///
    /// # Safety
    /// The list `locations` outlives the returned value, and has as many locations as the resources have room for.
    pub(crate) unsafe fn of_lent(
        layout: &FrameLayout,
        cells: Cells,
        sizes: CellSizes,
        resources: &Resources,
        locations: Descriptor,
    ) -> Result<Self, VulkanError> {
        let step = |step: u32| {
            let points = cells.are_points();
            layout.kernel(&spirv::Distribute { step, points })
        };
        let shown = resources.location_buffers(locations);
        Ok(Self {
            steps: STEPS.into_iter().map(step).collect::<Result<_, _>>()?,
            // SAFETY: the caller guarantees the list, and the other buffers live as long as the resources.
            own: unsafe { layout.own_set(spirv::Distribute::INTERFACE, &shown) }?,
            sizes,
        })
    }

    /// Records the pass, after [`Resources::record_begin`] has begun the list's region. Later passes see the frame's `set` again.
    pub fn record(&self, recorder: &Recorder<'_>, resources: &Resources, set: &SampleSet, region: &ListRegion) {
        let push = spirv::DistributePush {
            tiles: region.tiles,
            count: region.count,
            in_cell: self.sizes.in_cell,
            in_group: self.sizes.in_group,
            samples: self.sizes.samples,
        };
        recorder.clear(resources.buffer(Data::Loads));
        recorder.show(&self.own);
        recorder.pass(spirv::Distribute::INTERFACE, || {
            for (step, kernel) in STEPS.into_iter().zip(&self.steps) {
                let tiles = region.tiles[0] * region.tiles[1];
                let invocations = match step {
                    spirv::DISTRIBUTE_LAY_OUT => tiles,
                    spirv::DISTRIBUTE_ENCLOSE => self.sizes.most_cells(region.count, tiles),
                    _ => region.count,
                };
                kernel.record(recorder, &push, invocations);
            }
        });
        resources.record_reach(recorder, set);
        set.show(recorder);
    }
}

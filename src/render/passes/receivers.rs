//! receivers: finds the surfaces that are about to be shaded, and that light may reach. It is no
//! [`Pass`](crate::engine::pipelines::Pass), because what receives light is known only when a frame is recorded.

use crate::engine::data::{Argument, Cells, Content, SampleSet};
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv::{self, receivers_set};
use crate::render::data::GpuScene;
use crate::vulkan::{Buffer, DescriptorSets, Recorder, Specialized, VulkanError};

pub use crate::engine::spirv::SHADOW_POINTS;

/// Points of a pixel that are tested for shadows besides its centre, relative to it. `shaders/receivers.comp` explains the choice.
pub const PROBES: [[f64; 2]; SHADOW_POINTS as usize - 1] =
    [[0.34375, 0.34375], [-0.296875, 0.40625], [0.46875, -0.296875]];

/// Places that are about to be shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Receiving {
    /// Pixels of a region.
    Pixels {
        /// Width and height of the region in pixels.
        size: [u32; 2],
        /// Number of points of a pixel: 1, or [`SHADOW_POINTS`] to mark pixels with narrow shadows.
        points: u32,
    },
    /// Visibility samples of a round.
    Fragments {
        /// Place of the first of them.
        first_place: u32,
    },
}

/// Lists the surfaces that receive light.
pub struct Receivers {
    of_pixels: Kernel<spirv::Receivers>,
    of_fragments: Kernel<spirv::Receivers>,
    own: DescriptorSets,
}

impl Receivers {
    /// Makes the pipelines for cells of a scene. The pass writes two vectors to `surfaces` for each receiver.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout, scene: &GpuScene, cells: Cells, surfaces: &Buffer) -> Result<Self, VulkanError> {
        let shown = [(receivers_set::LOCATIONS_OUT, surfaces.into())];
        let kernel = |pixels: bool| {
            layout.kernel(&spirv::Receivers {
                pixels,
                locations: cells.are_locations(),
                instanced: scene.is_instanced(),
                diffuse_transmission: scene.is_backlit(),
            })
        };
        Ok(Self {
            of_pixels: kernel(true)?,
            of_fragments: kernel(false)?,
            // SAFETY: the buffer lives as long as the frame to which this belongs.
            own: unsafe { layout.own_set(spirv::Receivers::INTERFACE, &shown) }?,
        })
    }

    /// Records the pass. Passes use the sets `set` from here on.
    pub fn record(&self, recorder: &Recorder<'_>, set: &SampleSet, receiving: Receiving) {
        set.show(recorder);
        recorder.show(&self.own);
        match receiving {
            Receiving::Pixels { size: [width, height], points } => {
                self.of_pixels.record(recorder, &spirv::ReceiversPush { points }, width * height);
            }
            Receiving::Fragments { .. } => {
                self.of_fragments.record_indirect(recorder, &spirv::ReceiversPush { points: 1 }, Argument::Fragments);
            }
        }
    }
}

//! receivers: finds the surfaces that are about to be shaded, and that light may reach. It is no
//! [`Pass`](crate::engine::pipelines::Pass), because the probe is known only when a frame is recorded.

use crate::engine::data::{Argument, Cells, Content, SampleSet};
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv::{self, receivers_set};
use crate::render::data::GpuScene;
use crate::vulkan::{Buffer, DescriptorSets, Recorder, Specialized, VulkanError};

/// Further places in a pixel that are tested for shadows, relative to its centre. `shaders/receivers.comp` explains the
/// choice.
pub const PROBES: [[f64; 2]; 3] = [[0.34375, 0.34375], [-0.296875, 0.40625], [0.46875, -0.296875]];

/// Places that are about to be shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Receiving {
    /// Centres of a region's pixels; holds the region's width and height.
    Pixels([u32; 2]),
    /// Visibility samples of a round.
    Fragments,
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

    /// Records the pass for the centres of pixels or visibility samples, or for the probe with the number `probe`. Passes
    /// use the sets `set` from here on.
    pub fn record(&self, recorder: &Recorder<'_>, set: &SampleSet, receiving: Receiving, probe: Option<u32>) {
        let push = spirv::ReceiversPush { probe: probe.unwrap_or(0) };
        set.show(recorder);
        recorder.show(&self.own);
        match receiving {
            Receiving::Pixels([width, height]) => {
                self.of_pixels.record(recorder, &push, width * height);
            }
            Receiving::Fragments => {
                self.of_fragments.record_indirect(recorder, &push, Argument::Fragments);
            }
        }
    }
}

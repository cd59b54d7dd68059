//! receivers: projects the surfaces that are about to be shaded onto the plane of a light. It is no
//! [`Pass`](crate::engine::pipelines::Pass), because the planes of lights depend on the camera.

use crate::engine::data::{Argument, Cells, Content, Resources, SampleSet};
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv::{self, receivers_set};
use crate::render::data::GpuScene;
use crate::vulkan::{Buffer, DescriptorSets, Recorder, Specialized, VulkanError};

/// Plane of a light, as the pass takes it; `shaders/receivers.comp` describes the fields.
pub use crate::engine::spirv::ReceiversPush as LightPlane;

impl LightPlane {
    /// Face of a plane that does not belong to a cube.
    pub const SINGLE: u32 = spirv::SINGLE_PLANE;
    /// Flag in `step`: the pass initialises the shadow words.
    pub const BEGINS: u32 = spirv::RECEIVERS_BEGINS;
    /// Further places in a pixel that are probed, relative to its centre. `shaders/receivers.comp` explains the
    /// choice.
    pub const PROBES: [[f64; 2]; 3] = [[0.34375, 0.34375], [-0.296875, 0.40625], [0.46875, -0.296875]];

    /// Numbers of the probes.
    pub fn probes() -> impl Iterator<Item = u32> {
        1..=Self::PROBES.len() as u32
    }

    /// This plane for the probe with this number, for which no shadow words are written.
    pub fn of(self, probe: u32) -> Self {
        let light = self.step & spirv::RECEIVERS_LIGHT;
        Self { step: light | probe << spirv::RECEIVERS_PROBE_SHIFT, ..self }
    }
}

/// Places that are about to be shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Receiving {
    /// Centres of a region's pixels; holds the region's width and height.
    Pixels([u32; 2]),
    /// Visibility samples of a round.
    Records,
}

/// Lists the places that receive light.
pub struct Receivers {
    of_pixels: Kernel<spirv::Receivers>,
    of_records: Kernel<spirv::Receivers>,
    own: DescriptorSets,
}

impl Receivers {
    /// Makes the pipelines for cells of a scene. The pass writes the receivers' locations to `locations`, two vectors
    /// each, and initialises the shadow words of the resources. If receivers are `looked_up`, it writes their surfaces
    /// instead, for all lights, and no words.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        scene: &GpuScene,
        cells: Cells,
        resources: &Resources,
        (locations, looked_up): (&Buffer, bool),
    ) -> Result<Self, VulkanError> {
        let shown = [
            (receivers_set::LOCATIONS_OUT, locations.into()),
            (receivers_set::WORDS, (&resources.shadow_words.buffer).into()),
        ];
        let kernel = |pixels: bool| {
            let shader = spirv::Receivers {
                pixels,
                looked_up,
                locations: cells.are_locations(),
                occluders: cells.are_occluders(),
                instanced: scene.is_instanced(),
                shadow_words: resources.sizes().shadow_words,
                diffuse_transmission: scene.is_backlit(),
            };
            layout.kernel(&shader)
        };
        Ok(Self {
            of_pixels: kernel(true)?,
            of_records: kernel(false)?,
            // SAFETY: both buffers live as long as the frame to which this belongs.
            own: unsafe { layout.own_set(spirv::Receivers::INTERFACE, &shown) }?,
        })
    }

    /// Records the pass for a plane. Passes use the sets `set` from here on.
    pub fn record(&self, recorder: &Recorder<'_>, set: &SampleSet, receiving: Receiving, plane: &LightPlane) {
        set.show(recorder);
        recorder.show(&self.own);
        match receiving {
            Receiving::Pixels([width, height]) => {
                self.of_pixels.record(recorder, plane, width * height);
            }
            Receiving::Records => {
                self.of_records.record_indirect(recorder, plane, Argument::Records);
            }
        }
    }
}

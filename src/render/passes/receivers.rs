//! receivers: where the surfaces that are about to be shaded appear on the plane of a light.

use super::GpuScene;
use super::beside_frame::BesideFrame;
use crate::passes::own_layout::whole;
use crate::passes::spirv::{self, receivers_set};
use crate::passes::{Argument, Cells, Content, FrameLayout, Resources, SampleSet};
use crate::vulkan::{Buffer, Pipeline, Recorder, VulkanError};
use std::sync::Arc;

/// The plane of a light as the pass is told of it; `shaders/receivers.comp` says what the fields are.
pub use crate::passes::spirv::ReceiversPush as LightPlane;

impl LightPlane {
    /// The face of what is no plane of a cube.
    pub const SINGLE: u32 = 6;
    /// In the step that begins the words.
    pub const BEGINS: u32 = 32;
    /// Other places of a pixel that are looked at, from its centre. `shaders/receivers.comp` says why these.
    pub const PROBES: [[f64; 2]; 3] = [
        [0.34375, 0.34375],
        [-0.296875, 0.40625],
        [0.46875, -0.296875],
    ];

    /// The same for each probe.
    pub fn of_probes(self) -> impl Iterator<Item = Self> {
        let light = self.step & (Self::BEGINS - 1);
        let numbers = 1..=Self::PROBES.len() as u32;
        numbers.map(move |number| Self {
            step: light | number << 6,
            ..self
        })
    }
}

/// What is about to be shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Receiving {
    /// The centres of a region's pixels, so many.
    Pixels(u32),
    /// The visibility samples of a round.
    Records,
}

/// Lists the receivers of light.
pub struct Receivers {
    of_pixels: Arc<Pipeline>,
    of_records: Arc<Pipeline>,
    beside: BesideFrame<LightPlane>,
}

impl Receivers {
    /// Makes the pipelines for cells of a scene, which write the receivers' places to `locations`, two vectors each, and begin
    /// the words of the resources.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        scene: &GpuScene,
        cells: Cells,
        resources: &Resources,
        locations: &Buffer,
    ) -> Result<Self, VulkanError> {
        let words = whole(&resources.shadow_words.buffer);
        let shown = [
            (receivers_set::LOCATIONS_OUT, whole(locations)),
            (receivers_set::WORDS, words),
        ];
        // SAFETY: both buffers go with the frame that this is of.
        let beside = unsafe { BesideFrame::new(layout, &receivers_set::ALL, &shown) }?;
        let pipeline = |pixels: bool| {
            let shader = spirv::Receivers {
                pixels,
                locations: cells.are_locations(),
                occluders: cells.are_occluders(),
                instanced: scene.is_instanced(),
                shadow_words: resources.sizes().shadow_words,
                diffuse_transmission: scene.is_backlit(),
            };
            beside.pipeline(layout, &shader)
        };
        Ok(Self {
            of_pixels: pipeline(true)?,
            of_records: pipeline(false)?,
            beside,
        })
    }

    /// Records it for a plane; afterwards the frame's set is no longer bound as other passes bind it.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        (resources, set): (&Resources, &SampleSet),
        receiving: Receiving,
        plane: &LightPlane,
    ) {
        self.beside.bind(recorder, set, plane);
        match receiving {
            Receiving::Pixels(count) => {
                recorder.dispatch(&self.of_pixels, u64::from(count.div_ceil(64)));
            }
            Receiving::Records => recorder.dispatch_indirect(
                &self.of_records,
                &resources.arguments,
                Argument::Sort as u32,
            ),
        }
    }
}

//! Shading of visibility samples by a host's own pipelines.

use crate::engine::data::{Argument, Resources, SampleSet};
use crate::engine::sampler::RecordShading;
use crate::vulkan::Recorder;
use ash::vk;

/// Names and text of the GLSL includes for a host's shaders: `gpc_visibility.glsl`, which says how a visibility sample is
/// laid out and what to do with it, `gpc_texture.glsl`, which filters textures over it, `gpc_position.glsl`, which places
/// vertices as the library does, and what they include.
pub const SHADER_INCLUDES: [(&str, &str); 7] = [
    (
        "gpc_visibility.glsl",
        include_str!("../../../shaders/include/gpc_visibility.glsl"),
    ),
    (
        "gpc_texture.glsl",
        include_str!("../../../shaders/include/gpc_texture.glsl"),
    ),
    (
        "gpc_position.glsl",
        include_str!("../../../shaders/include/gpc_position.glsl"),
    ),
    (
        "place.glsl",
        include_str!("../../../shaders/include/place.glsl"),
    ),
    (
        "place_in_tile.glsl",
        include_str!("../../../shaders/include/place_in_tile.glsl"),
    ),
    (
        "barycentric.glsl",
        include_str!("../../../shaders/include/barycentric.glsl"),
    ),
    (
        "finite.glsl",
        include_str!("../../../shaders/include/finite.glsl"),
    ),
];

/// Visibility samples of a round, sorted by shading key, on the device.
#[derive(Clone, Copy, Debug)]
pub struct VisibilitySamples {
    pub(super) set: vk::DescriptorSet,
    pub(super) arguments: vk::Buffer,
    pub(super) keys: u32,
    pub(super) condition: Option<vk::Buffer>,
}

impl VisibilitySamples {
    /// Bytes from the indirect dispatch of a key to that of the next one.
    pub const DISPATCH_STRIDE: u64 = 16;

    /// The set of [`super::Antialiaser::samples_layout`], to be bound for compute where the shaders expect it.
    #[must_use]
    pub fn descriptor_set(&self) -> vk::DescriptorSet {
        self.set
    }

    /// Number of shading keys.
    #[must_use]
    pub fn keys(&self) -> u32 {
        self.keys
    }

    /// Buffer and offset of the indirect dispatch of a key's samples, in workgroups of 64 invocations; `None` for a key
    /// that there is none of.
    #[must_use]
    pub fn dispatch(&self, key: u32) -> Option<(vk::Buffer, u64)> {
        let index = u64::from(Argument::Shade as u32) + u64::from(key);
        (key < self.keys).then_some((self.arguments, index * Self::DISPATCH_STRIDE))
    }

    /// A buffer whose first word of 32 bits is zero where the round has nothing to do, so that its dispatches are of no
    /// workgroups. Recorded after `vkCmdBeginConditionalRenderingEXT` with it, at offset 0, and ended before the callback returns,
    /// they take no time there, as the engine's own. `None` on devices without
    /// [`Host::conditional_rendering`](crate::vulkan::Host::conditional_rendering), and where what is shaded is no round.
    #[must_use]
    pub fn condition(&self) -> Option<vk::Buffer> {
        self.condition
    }
}

/// A host's materials.
pub trait ShadeSamples {
    /// Records the shading of a round's samples: for each key a pipeline, the samples' set, and the key's indirect
    /// dispatch. It is called a fixed number of times for a frame, in rounds that have nothing to do as well, outside of a render
    /// pass and of conditional rendering. Dispatches need no barrier between them; what the engine wrote is visible to them, and
    /// the engine waits for what they write. They may bind and push what they like.
    fn record(&self, commands: vk::CommandBuffer, samples: &VisibilitySamples);
}

impl<F: Fn(vk::CommandBuffer, &VisibilitySamples)> ShadeSamples for F {
    fn record(&self, commands: vk::CommandBuffer, samples: &VisibilitySamples) {
        self(commands, samples);
    }
}

/// A host's materials as a client of the engine.
pub(super) struct HostShading<'a> {
    pub shading: &'a dyn ShadeSamples,
    pub samples: VisibilitySamples,
    /// Bound again, since the host binds its own.
    pub set: &'a SampleSet,
}

impl RecordShading for HostShading<'_> {
    fn record(&self, recorder: &Recorder<'_>, resources: &Resources) {
        let samples = VisibilitySamples {
            condition: recorder.condition(),
            ..self.samples
        };
        recorder.section("shade", || {
            self.shading.record(recorder.raw(), &samples);
        });
        resources.record_bind(recorder, self.set);
    }
}

//! Shading of visibility samples by a host's own pipelines.

use crate::engine::data::{Argument, Resources};
use crate::engine::sampler::RecordShading;
use crate::vulkan::{PassTime, Recorder};
use ash::vk;

/// Names and texts of the includes for a host's shaders. `gpc_visibility.glsl` defines visibility samples and the
/// functions that read and store them, `gpc_texture.glsl` filters textures over a sample's footprint,
/// `gpc_position.glsl` transforms vertices as the library does, and `gpc_instance.glsl` defines what a shader writes about
/// an indirect draw. The other files in GLSL are included by these. `gpc_visibility.slang` is the first file in Slang.
pub const SHADER_INCLUDES: [(&str, &str); 9] = [
    ("gpc_visibility.glsl", include_str!("../../../shaders/include/gpc_visibility.glsl")),
    ("gpc_texture.glsl", include_str!("../../../shaders/include/gpc_texture.glsl")),
    ("gpc_position.glsl", include_str!("../../../shaders/include/gpc_position.glsl")),
    ("gpc_instance.glsl", include_str!("../../../shaders/include/gpc_instance.glsl")),
    ("place.glsl", include_str!("../../../shaders/include/place.glsl")),
    ("place_in_tile.glsl", include_str!("../../../shaders/include/place_in_tile.glsl")),
    ("barycentric.glsl", include_str!("../../../shaders/include/barycentric.glsl")),
    ("finite.glsl", include_str!("../../../shaders/include/finite.glsl")),
    ("gpc_visibility.slang", include_str!("../../../shaders/slang/gpc_visibility.slang")),
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
    /// Distance in bytes from the indirect dispatch of one key to that of the next.
    pub const DISPATCH_STRIDE: u64 = 16;

    /// Descriptor set with the layout [`super::Antialiaser::samples_layout`], to be bound for compute at the set number
    /// that the shaders use.
    #[must_use]
    pub fn descriptor_set(&self) -> vk::DescriptorSet {
        self.set
    }

    /// Number of shading keys.
    #[must_use]
    pub fn keys(&self) -> u32 {
        self.keys
    }

    /// Buffer and offset of the indirect dispatch over a key's samples, in workgroups of 64 invocations; `None` if
    /// there is no such key.
    #[must_use]
    pub fn dispatch(&self, key: u32) -> Option<(vk::Buffer, u64)> {
        let index = u64::from(Argument::Shade as u32) + u64::from(key);
        (key < self.keys).then_some((self.arguments, index * Self::DISPATCH_STRIDE))
    }

    /// Buffer for conditional rendering; its first 32-bit word is zero if the round has no work. The dispatches of such
    /// a round have no workgroups. To skip them altogether, record them between `vkCmdBeginConditionalRenderingEXT`,
    /// with this buffer and offset 0, and its end, within the callback. `None` on devices without
    /// [`Host::conditional_rendering`](crate::vulkan::Host::conditional_rendering), and for shading outside of rounds.
    #[must_use]
    pub fn condition(&self) -> Option<vk::Buffer> {
        self.condition
    }
}

/// Materials of a host.
pub trait ShadeSamples {
    /// Records the shading of a round's samples: for each key, a pipeline, the samples' descriptor set, and the key's
    /// indirect dispatch.
    ///
    /// The engine calls this a fixed number of times for each frame, also for rounds without work, outside of a render
    /// pass and of conditional rendering. The engine's writes are visible to the dispatches, which need no barrier
    /// between them, and the engine waits for their writes. The callback may bind and push anything.
    fn record(&self, commands: vk::CommandBuffer, samples: &VisibilitySamples);
}

impl<F: Fn(vk::CommandBuffer, &VisibilitySamples)> ShadeSamples for F {
    fn record(&self, commands: vk::CommandBuffer, samples: &VisibilitySamples) {
        self(commands, samples);
    }
}

/// Materials of a host as a client of the engine.
pub(super) struct HostShading<'a> {
    pub shading: &'a dyn ShadeSamples,
    pub samples: VisibilitySamples,
}

impl RecordShading for HostShading<'_> {
    fn record(&self, recorder: &Recorder<'_>, _resources: &Resources) {
        let samples = VisibilitySamples { condition: recorder.condition(), ..self.samples };
        recorder.section(PassTime::HOST_SHADING, || {
            self.shading.record(recorder.raw(), &samples);
        });
    }
}

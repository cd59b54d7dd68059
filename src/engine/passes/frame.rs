//! The uniform block `Frame` of `shaders/include/frame.glsl`.

use super::ResourceSizes;

/// The uniform block `Frame`; the shader's comments say what the fields are.
pub use super::spirv::Frame as FrameUniform;

impl FrameUniform {
    /// With the room that these sizes give lists, and nothing else.
    pub(crate) fn with_room(sizes: &ResourceSizes) -> Self {
        Self {
            survivor_capacity: sizes.survivor_capacity,
            pair_capacity: sizes.pair_capacity,
            list_capacity: sizes.list_capacity,
            record_capacity: sizes.record_capacity,
            group_count: sizes.locations.map_or(0, |locations| locations.groups),
            ..Self::default()
        }
    }
}

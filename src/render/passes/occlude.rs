//! occlude: finds the receivers of light that another triangle occludes, in the lists of the tiles of a light's plane.
//! It is no [`Pass`](crate::engine::pipelines::Pass), because the lights, and what is shadowed, are known only when a
//! frame is recorded.

use super::{Receiving, Unshadowed};
use crate::engine::data::{Argument, Content, Data, Resources};
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv::{self, occlude_set};
use crate::render::data::GpuScene;
use crate::vulkan::{DescriptorSets, Recorder, Specialized, VulkanError};

/// Plane of a light, as the pass takes it; `shaders/occlude.comp` describes the fields.
pub use crate::engine::spirv::OccludePush as LightPlane;

impl LightPlane {
    /// Face of a plane that does not belong to a cube.
    pub const SINGLE: u32 = spirv::SINGLE_PLANE;
}

/// Receivers of a team.
const RECEIVERS: u32 = 64;

/// Writes the shadow words of receivers.
pub struct Occlude {
    kernel: Kernel<spirv::Occlude>,
    own: DescriptorSets,
}

impl Occlude {
    /// Makes the pipeline, which searches `casters` for occluders and writes the shadow words of the receivers' resources.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(
        layout: &FrameLayout,
        casters: &GpuScene,
        receivers: &Resources,
        unshadowed: &Unshadowed,
    ) -> Result<Self, VulkanError> {
        let shown = [
            (occlude_set::WORDS, receivers.buffer(Data::ShadowWords).into()),
            (occlude_set::LEFT, unshadowed.buffer().into()),
            (occlude_set::MARKS_OF_PIXELS, receivers.buffer(Data::Marks).into()),
        ];
        let teams = layout.gpu.limits().teams;
        let shader = spirv::Occlude {
            local_size: teams.workgroup(),
            team: teams.members,
            teams: teams.in_workgroup,
            translucent: casters.has_mask() || casters.has_blend(),
            rows: RECEIVERS / teams.members,
            instanced: casters.is_instanced(),
            shadow_words: receivers.sizes().shadow_words,
        };
        Ok(Self {
            kernel: layout.kernel(&shader)?,
            // SAFETY: the buffers live as long as the frame to which this belongs.
            own: unsafe { layout.own_set(spirv::Occlude::INTERFACE, &shown) }?,
        })
    }

    /// Records the pass for the lists of a plane, whose set passes use, and the surfaces that `receivers` has found. Visibility
    /// samples are those of `resources`.
    pub fn record(&self, recorder: &Recorder<'_>, receiving: Receiving, resources: &Resources, plane: &LightPlane) {
        recorder.show(&self.own);
        match receiving {
            Receiving::Pixels { size, points } => {
                let side = (RECEIVERS / points).isqrt();
                let teams = size.map(|length| length.div_ceil(side));
                let push = LightPlane { first_place: 0, region: size, points, ..*plane };
                self.kernel.record_teams(recorder, &push, teams[0] * teams[1]);
            }
            Receiving::Fragments { first_place } => {
                let push = LightPlane { first_place, region: [0; 2], points: 1, ..*plane };
                self.kernel.record_counted(recorder, &push, resources.buffer(Data::Arguments), Argument::Sort);
            }
        }
    }
}

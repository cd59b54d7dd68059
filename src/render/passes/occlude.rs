//! occlude: finds the receivers of light that another triangle occludes, in the lists of the tiles of a light's plane.
//! It is no [`Pass`](crate::engine::pipelines::Pass), because the lights, and what is shadowed, are known only when a
//! frame is recorded.

use super::{LightPlane, Receiving, Unshadowed};
use crate::engine::data::{Argument, Content, Resources};
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv::{self, occlude_set};
use crate::render::data::GpuScene;
use crate::vulkan::{DescriptorSets, Recorder, Specialized, VulkanError};

/// Width and height of the pixels of a team, as in `shaders/occlude.comp`.
const SIDE: u32 = 8;

/// Receivers of a team.
const RECEIVERS: u32 = SIDE * SIDE;

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
            (occlude_set::WORDS, (&receivers.shadow_words.buffer).into()),
            (occlude_set::LEFT, unshadowed.buffer().into()),
            (occlude_set::MARKS_OF_PIXELS, (&receivers.marks).into()),
        ];
        let teams = layout.gpu.limits().teams;
        let shader = spirv::Occlude {
            local_size: teams.workgroup(),
            team: teams.members,
            teams: teams.in_workgroup,
            has_mask: casters.has_mask(),
            rows: RECEIVERS / teams.members,
            instanced: casters.is_instanced(),
        };
        Ok(Self {
            kernel: layout.kernel(&shader)?,
            // SAFETY: the buffers live as long as the frame to which this belongs.
            own: unsafe { layout.own_set(spirv::Occlude::INTERFACE, &shown) }?,
        })
    }

    /// Records the pass for the lists of a plane, whose set passes use. The receivers are those of `resources`; the first one's
    /// place is `first_place`.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        (receiving, resources): (Receiving, &Resources),
        plane: &LightPlane,
        first_place: u32,
    ) {
        let region = match receiving {
            Receiving::Pixels(size) => size,
            Receiving::Records => [0; 2],
        };
        let push = spirv::OccludePush {
            to_plane: plane.to_plane,
            light: plane.light,
            cone: plane.cone,
            range: plane.range,
            step: plane.step,
            face: plane.face,
            first_place,
            region,
        };
        recorder.show(&self.own);
        match receiving {
            Receiving::Pixels(size) => {
                let groups = size.map(|side| side.div_ceil(SIDE));
                self.kernel.record_teams(recorder, &push, groups[0] * groups[1]);
            }
            Receiving::Records => {
                let size = (&resources.arguments, Argument::Sort);
                self.kernel.record_counted(recorder, &push, size);
            }
        }
    }
}

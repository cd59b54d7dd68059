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
    /// Flag in `step`: the pass initialises the shadow words.
    pub const BEGINS: u32 = spirv::OCCLUDE_BEGINS;
}

/// Use of what is found out about the receivers of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadowTarget {
    /// Writes shadow words of places, from this index on.
    Words(u32),
    /// Marks pixels in which the probe with this number gets another share of the light than the centre.
    Marks(u32),
}

impl ShadowTarget {
    /// Number of the probe whose receivers are tested.
    pub fn probe(self) -> Option<u32> {
        match self {
            Self::Words(_) => None,
            Self::Marks(probe) => Some(probe),
        }
    }
}

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
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        receiving: Receiving,
        resources: &Resources,
        plane: &LightPlane,
        target: ShadowTarget,
    ) {
        let (first_place, step) = match target {
            ShadowTarget::Words(first) => (first, plane.step),
            ShadowTarget::Marks(probe) => (0, plane.step & spirv::OCCLUDE_LIGHT | probe << spirv::OCCLUDE_PROBE_SHIFT),
        };
        let region = match receiving {
            Receiving::Pixels(size) => size,
            Receiving::Fragments => [0; 2],
        };
        let push = LightPlane { step, first_place, region, ..*plane };
        recorder.show(&self.own);
        match receiving {
            Receiving::Pixels(size) => {
                let groups = size.map(|side| side.div_ceil(SIDE));
                self.kernel.record_teams(recorder, &push, groups[0] * groups[1]);
            }
            Receiving::Fragments => {
                self.kernel.record_counted(recorder, &push, resources.buffer(Data::Arguments), Argument::Sort);
            }
        }
    }
}

//! Passes and memory that find shadows.

use super::casters::{Casters, Lit, caster_moment};
use super::light::{LightView, Sight, most_planes, plane_side, views};
use crate::engine::data::{Cells, Data, Offsets, ResourceRequest, ResourceSizes, Resources, SampleSet, ShownIds};
use crate::engine::pipelines::FrameLayout;
use crate::engine::sampler::{Capacity, SamplerSettings, Shortfall, TriangleLists};
use crate::engine::spirv::frame_set;
use crate::render::RenderError;
use crate::render::data::{FrameGeometry, FrameLook, GpuScene};
use crate::render::passes::{Occlude, PosePass, Receivers, Receiving, SHADOW_POINTS, Unshadowed};
use crate::scene::Moment;
use crate::vulkan::{Memory, PassTime, Recorder, VulkanError};
use std::sync::Arc;

/// Pipelines and memory that find the casters between lights and the places that a frame or a run of locations shades.
pub(in crate::render) struct ShadowFinder {
    casters: Arc<Casters>,
    lit: Lit,
    /// Moment that is shown instead of the first pose.
    moment: Option<Moment>,
    settings: SamplerSettings,
    /// Side of the lights' planes in pixels.
    side: u32,
    receivers: Receivers,
    lists: TriangleLists,
    occlude: Occlude,
    unshadowed: Unshadowed,
    pose: Option<PosePass>,
    geometry: FrameGeometry,
    look: FrameLook,
    /// Memory for the lists of planes: of each plane, or of one after the other.
    planes: Vec<Resources>,
}

/// Casters and lights for whose shadows memory is planned, and what these fall on.
#[derive(Clone, Copy)]
pub(in crate::render) struct ShadowRequest<'a> {
    pub layout: &'a Arc<FrameLayout>,
    pub casters: &'a Arc<Casters>,
    pub settings: &'a SamplerSettings,
    pub capacity: Capacity,
    /// Number of pixels of the whole image, or of locations of the whole list.
    pub places: u64,
    /// Limit for all device memory in bytes; `None` for no limit.
    pub max_memory: Option<u64>,
}

/// Places that are about to be shaded: the memory of their owner, and the views of lights onto them.
#[derive(Clone, Copy)]
pub(in crate::render) struct Shadowed<'a> {
    pub resources: &'a Resources,
    pub set: &'a SampleSet,
    /// Size in pixels of the region of an image; 0 for a list of locations.
    pub size: [u32; 2],
    /// Views of lights onto the places.
    pub views: &'a [LightView],
}

/// Number of bytes that the lists of all planes of the lights may take, and their share of a limit for memory. If they take
/// more, memory has room for the lists of one plane, which are made for each search.
const MOST_LIST_BYTES: u64 = 768 << 20;
const LIST_SHARE: u64 = 4;

/// Memory for the lists of planes.
struct PlanePlan {
    side: u32,
    sizes: ResourceSizes,
    /// Number of planes whose lists are in memory at once.
    planes: u32,
}

impl ShadowRequest<'_> {
    fn plan(&self) -> PlanePlan {
        let Self { layout, casters, settings, capacity, places, max_memory } = *self;
        let side = plane_side(places, capacity.planes.longest);
        let sizes = TriangleLists::sizes(layout, &*casters.scene, &settings.cells, [side; 2], capacity);
        let planes = most_planes(&casters.lit, casters.scene.moves()).max(1);
        let most = max_memory.map_or(MOST_LIST_BYTES, |limit| MOST_LIST_BYTES.min(limit / LIST_SHARE));
        let is_room = u64::from(planes) * sizes.planned_bytes() <= most;
        PlanePlan { side, sizes, planes: if is_room { planes } else { 1 } }
    }

    /// Number of bytes of a finder.
    pub fn bytes(&self) -> u64 {
        let PlanePlan { sizes, planes, .. } = self.plan();
        let scene = &*self.casters.scene;
        u64::from(planes) * sizes.planned_bytes() + FrameGeometry::bytes(scene) + FrameLook::bytes(scene)
    }
}

impl ShadowFinder {
    /// Makes pipelines and memory for cells of a scene that are shaded with the memory `shading`.
    ///
    /// # Errors
    /// If the driver refuses something, or memory runs out.
    pub fn new(
        request: &ShadowRequest<'_>,
        memory: &Memory,
        scene: &GpuScene,
        cells: Cells,
        shading: &Resources,
    ) -> Result<Self, RenderError> {
        let ShadowRequest { layout, casters, settings, .. } = *request;
        let occluding = &*casters.scene;
        let PlanePlan { side, sizes, planes } = request.plan();
        sizes.check(layout.gpu.limits())?;
        let geometry = FrameGeometry::new(memory, occluding, true)?;
        let look = FrameLook::new(memory, occluding)?;
        let mut shown = geometry.shown(occluding);
        shown.extend(look.shown(occluding));
        shown.push((frame_set::LOCATIONS, shading.texels(Data::Surfaces)));
        let request = ResourceRequest {
            sizes,
            others: &shown,
            ids: ShownIds::Unread,
            offsets: &[Offsets { all: &[[0.0; 2]], count: 1 }],
            scratch: None,
        };
        let plane = |_| Resources::new(layout, memory, &request);
        let unshadowed = Unshadowed::new(memory)?;
        Ok(Self {
            side,
            receivers: Receivers::new(layout, scene, cells, shading.buffer(Data::Surfaces))?,
            lists: TriangleLists::new(layout, occluding)?,
            occlude: Occlude::new(layout, occluding, shading, &unshadowed)?,
            unshadowed,
            pose: occluding.moves().then(|| PosePass::new(layout)).transpose()?,
            lit: casters.lit.clone(),
            moment: None,
            casters: casters.clone(),
            settings: settings.clone(),
            planes: (0..planes).map(plane).collect::<Result<_, _>>()?,
            geometry,
            look,
        })
    }

    /// Records initial copies to the device.
    pub fn record_upload(&self, recorder: &Recorder<'_>) {
        self.geometry.record_upload(recorder, &self.casters.scene);
        self.look.record_upload(recorder, &self.casters.scene);
        for plane in &self.planes {
            plane.record_upload(recorder);
        }
    }

    /// Views of the lights onto the visible part of the scene.
    pub fn views(&self, sight: &Sight) -> Vec<LightView> {
        views(&self.lit, sight, self.side)
    }

    /// Shows another moment of the casters' motion, from the next recording on.
    pub fn show(&mut self, moment: &Moment) {
        let moment = caster_moment(moment);
        self.look.show(&self.casters.scene, &moment);
        self.lit = self.casters.at(&moment);
        self.moment = Some(moment);
    }

    /// Records the beginning of a frame or run. The device must have finished the previous one.
    pub fn record_begin(&mut self, recorder: &Recorder<'_>) {
        self.unshadowed.record_begin(recorder);
        self.look.record(recorder);
        let set = self.planes.first().and_then(|plane| plane.set(0));
        if let (Some(moment), Some(pose), Some(set)) = (&self.moment, &self.pose, set) {
            self.geometry.write_moment(moment);
            set.show(recorder);
            pose.record(recorder, &self.casters.scene, &self.geometry, moment);
        }
    }

    /// Records the end of a frame or run.
    pub fn record_end(&self, recorder: &Recorder<'_>) {
        self.unshadowed.record_end(recorder);
    }

    /// Records the lists that all searches of a region or list have in common. Passes use the sets `set` afterwards.
    pub fn record_planes(&self, recorder: &Recorder<'_>, views: &[LightView], set: &SampleSet) {
        if self.keeps_lists(views) {
            recorder.section(PassTime::SHADOWS, || {
                for (view, plane) in views.iter().zip(&self.planes) {
                    self.record_lists(recorder, view, plane);
                }
                set.show(recorder);
            });
        }
    }

    /// Whether the lists of all planes are in memory at once.
    fn keeps_lists(&self, views: &[LightView]) -> bool {
        views.len() <= self.planes.len()
    }

    fn record_lists(&self, recorder: &Recorder<'_>, view: &LightView, plane: &Resources) {
        let Some(set) = plane.set(0) else {
            return;
        };
        let (scene, sizes) = (&*self.casters.scene, plane.sizes());
        let uniform = view.window.uniform(scene, &view.pinhole, &self.settings, Cells::Points, 1, sizes);
        self.lists.record(recorder, plane, set, uniform);
    }

    /// Records the search for the lights that reach the centres of pixels, before these are shaded. With `marks`, pixels are marked
    /// in which a light reaches another point differently. Passes use the places' descriptor sets before and after.
    pub fn record_pixels(&self, recorder: &Recorder<'_>, shaded: Shadowed<'_>, marks: bool) {
        let points = if marks { SHADOW_POINTS } else { 1 };
        self.record_search(recorder, shaded, Receiving::Pixels { size: shaded.size, points });
    }

    /// Records the search for the lights that reach the visibility samples of a round. Passes use their descriptor sets before and
    /// after.
    pub fn record_fragments(&self, recorder: &Recorder<'_>, shaded: Shadowed<'_>) {
        let first_place = shaded.size[0] * shaded.size[1];
        self.record_search(recorder, shaded, Receiving::Fragments { first_place });
    }

    fn record_search(&self, recorder: &Recorder<'_>, shaded: Shadowed<'_>, receiving: Receiving) {
        recorder.section(PassTime::SHADOWS, || {
            if shaded.views.is_empty() {
                recorder.clear(shaded.resources.buffer(Data::ShadowWords));
                return;
            }
            self.receivers.record(recorder, shaded.set, receiving);
            let has_lists = self.keeps_lists(shaded.views);
            for (view, plane) in shaded.views.iter().zip(self.planes.iter().cycle()) {
                if !has_lists {
                    self.record_lists(recorder, view, plane);
                } else if let Some(set) = plane.set(0) {
                    set.show(recorder);
                }
                self.occlude.record(recorder, receiving, shaded.resources, &view.plane);
            }
            shaded.set.show(recorder);
        });
    }

    /// Adds the work that the last recording could not finish.
    ///
    /// # Errors
    /// If its counters can't be read.
    pub fn add_shortfall(&self, shortfall: &mut Shortfall) -> Result<(), VulkanError> {
        self.unshadowed.add_shortfall(shortfall)
    }
}

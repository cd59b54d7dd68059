//! Passes and memory that find shadows.

use super::casters::{Casters, Lit, caster_moment};
use super::light::{LightView, Sight, most_planes, views};
use crate::engine::data::{Argument, Cells, Content, FrameUniform, Offsets, ResourceSizes, Resources, SampleSet};
use crate::engine::passes::{ListLength, RasterTargets};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::sampler::{
    Capacity, ListCells, RecordShading, Sampler, SamplerContext, SamplerRun, SamplerSettings, Shortfall, TileLists,
};
use crate::engine::spirv::frame_set;
use crate::render::RenderError;
use crate::render::data::{FrameGeometry, FrameLook, GpuScene};
use crate::render::passes::{
    LightPlane, Occlude, PosePass, Receivers, Receiving, ShadeSource, Shadow, ShadowTarget, Unshadowed, shade,
};
use crate::scene::Moment;
use crate::vulkan::{Memory, MemoryUse, PassTime, Recorder, TexelBuffer, VulkanError};
use ash::vk;
use std::sync::Arc;

/// Pipelines and memory that find the casters between lights and the places that a frame or a run of locations shades.
pub(in crate::render) struct ShadowFinder {
    casters: Arc<Casters>,
    lit: Lit,
    /// Moment that is shown instead of the first pose.
    moment: Option<Moment>,
    settings: SamplerSettings,
    receivers: Receivers,
    search: Search,
    unshadowed: Unshadowed,
    pose: Option<PosePass>,
    geometry: FrameGeometry,
    look: FrameLook,
    /// Memory for the casters that a plane shows: that of each plane, or of one after the other.
    planes: Vec<Resources>,
    targets: RasterTargets,
    _locations: TexelBuffer,
}

/// Search for the occluders of receivers.
enum Search {
    /// The triangles of each tile of each plane are listed, and receivers are looked up in these lists.
    Lists { lists: TileLists, occlude: Occlude },
    /// Receivers are sampled, as other lists of locations are.
    Samples {
        sampler: Box<Sampler>,
        /// Shading of casters that let light pass; `None` without such casters.
        shade: Option<Pass>,
        shadow: Shadow,
    },
}

/// Number of pixels of a plane for each place. More pixels make the lists of tiles shorter, and their making longer.
/// Receivers before BLEND casters are always sampled, for which lists are made anew in each round. In other scenes, the
/// result must not depend on whether receivers are looked up or sampled.
fn pixels_per_place(casters: &GpuScene) -> f64 {
    if casters.has_blend() { 2.0 } else { 8.0 }
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

/// Client of the sampler that finds occluders between a plane of a light and receivers.
struct Occlusion<'a> {
    shade: Option<&'a Pass>,
    shadow: &'a Shadow,
    target: ShadowTarget,
    /// Bit of the light in the words of receivers.
    light: u32,
}

impl Shadowed<'_> {
    fn pixels(&self) -> u32 {
        self.size[0] * self.size[1]
    }
}

impl RecordShading for Occlusion<'_> {
    /// Shades casters that let light pass, to get their opacities.
    fn record(&self, recorder: &Recorder<'_>, _resources: &Resources) {
        if let Some(shade) = self.shade {
            shade.record(recorder);
        }
    }

    fn record_round_end(&self, recorder: &Recorder<'_>) {
        self.shadow.record(recorder, self.target, self.light);
    }
}

/// Kind of the lists with which casters are sampled.
const OCCLUDERS: ListCells = ListCells { cells: Cells::Occluders, attributes: false, shadow_words: 0, lent: true };

/// Number of bytes that the lists of all planes of the lights may take. With more, receivers are sampled.
const MOST_LIST_BYTES: u64 = 768 << 20;

/// Plan of a search: the memory of a plane, and the number of planes in memory at once.
struct SearchPlan {
    sizes: ResourceSizes,
    planes: u32,
    looks_up: bool,
}

impl SearchPlan {
    /// Plan for an image or list of `places` places, whose owner has memory of the sizes `shading`.
    fn new(
        layout: &FrameLayout,
        casters: &Casters,
        settings: &SamplerSettings,
        capacity: Capacity,
        (places, shading): (u64, &ResourceSizes),
    ) -> Self {
        let (scene, options) = (&*casters.scene, &settings.cells);
        let region = [LightView::side(places, pixels_per_place(scene)); 2];
        let listed = Self {
            sizes: TileLists::sizes(layout, scene, options, region, capacity),
            planes: most_planes(&casters.lit, casters.scene.moves()).max(1),
            looks_up: true,
        };
        let fits = listed.sizes.check("the lists of a light", layout.gpu.limits());
        // Opacities of casters are known only where they are sampled.
        let looks_up = capacity.looks_up_occluders && !scene.has_blend() && fits.is_ok();
        if looks_up && u64::from(listed.planes) * listed.sizes.bytes() <= MOST_LIST_BYTES {
            return listed;
        }
        let room = (shading.receivers(), region);
        Self { sizes: OCCLUDERS.sizes(layout, scene, options, room, capacity), planes: 1, looks_up: false }
    }

    fn bytes(&self) -> u64 {
        u64::from(self.planes) * self.sizes.bytes()
    }
}

impl ShadowFinder {
    /// Approximate number of bytes for an image or list of `places` places; the places' owner has memory of the sizes
    /// `sizes`.
    pub fn bytes(
        layout: &FrameLayout,
        casters: &Casters,
        settings: &SamplerSettings,
        capacity: Capacity,
        (places, shading): (u64, &ResourceSizes),
    ) -> u64 {
        let plan = SearchPlan::new(layout, casters, settings, capacity, (places, shading));
        let list = 32 * u64::from(shading.receivers());
        let scene = &*casters.scene;
        list + plan.bytes() + FrameGeometry::bytes(scene) + FrameLook::bytes(scene)
    }

    /// Makes pipelines and memory for cells of a scene that are shaded with `resources`, in an image or list of
    /// `places` places.
    ///
    /// # Errors
    /// If the driver refuses something, or memory runs out.
    pub fn new(
        layout: &Arc<FrameLayout>,
        memory: &Memory,
        casters: &Arc<Casters>,
        settings: &SamplerSettings,
        capacity: Capacity,
        (scene, cells, shading): (&GpuScene, Cells, &Resources),
        places: u64,
    ) -> Result<Self, RenderError> {
        let occluding = &*casters.scene;
        let plan = SearchPlan::new(layout, casters, settings, capacity, (places, shading.sizes()));
        let sizes = plan.sizes;
        sizes.check("the largest list of shadows", layout.gpu.limits())?;
        let (offsets, count) = OCCLUDERS.offsets(layout, &settings.cells)?;
        let offsets = Offsets { all: &offsets, count };
        let once = vk::SampleCountFlags::TYPE_1;
        let targets = RasterTargets::new(memory, 1, 1, once, false)?;
        let geometry = FrameGeometry::new(memory, occluding, true)?;
        let look = FrameLook::new(memory, occluding)?;
        let mut shown = geometry.shown(occluding);
        shown.extend(look.shown(occluding));
        let locations = memory.texel_buffer(
            "receivers of light",
            2 * u64::from(shading.sizes().receivers()),
            vk::Format::R32G32B32A32_UINT,
            vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER | vk::BufferUsageFlags::STORAGE_BUFFER,
            MemoryUse::Device,
        )?;
        shown.push((frame_set::LOCATIONS, locations.texels().into()));
        let plane = |_| {
            let views = targets.views();
            Resources::new(layout, memory, occluding, &shown, &views, sizes, &[offsets])
        };
        let planes = (0..plan.planes).map(plane).collect::<Result<Vec<_>, _>>()?;
        let output = settings.color_constants(occluding);
        let context = SamplerContext {
            layout,
            memory,
            scene: occluding,
            settings,
            output: &output,
            sizes: &sizes,
            capacity: Capacity { samples_unlisted: !plan.looks_up, ..capacity },
            // `shadow` and `occlude` count on the device, so that no runs are counted here.
            runs: 0,
        };
        let unshadowed = Unshadowed::new(memory)?;
        let search = match planes.first() {
            Some(resources) if !plan.looks_up => {
                // SAFETY: the list lives as long as this, and has room for that many locations.
                let sampler = unsafe { OCCLUDERS.sampler(&context, (resources, locations.texels())) }?;
                let opacities = || {
                    let source = ShadeSource::Records { cells: Cells::Occluders };
                    shade::pass(layout, occluding, (source, 0), &output)
                };
                Search::Samples {
                    sampler: Box::new(sampler),
                    shade: occluding.has_blend().then(opacities).transpose()?,
                    shadow: Shadow::new(layout, shading, &unshadowed)?,
                }
            }
            _ => Search::Lists {
                lists: TileLists::new(&context)?,
                occlude: Occlude::new(layout, occluding, shading, &unshadowed)?,
            },
        };
        Ok(Self {
            receivers: Receivers::new(layout, scene, cells, shading, (&locations.buffer, plan.looks_up))?,
            search,
            unshadowed,
            pose: occluding.moves().then(|| PosePass::new(layout)).transpose()?,
            lit: casters.lit.clone(),
            moment: None,
            casters: casters.clone(),
            settings: settings.clone(),
            geometry,
            look,
            planes,
            targets,
            _locations: locations,
        })
    }

    /// Records initial copies to the device.
    pub fn record_upload(&self, recorder: &Recorder<'_>) {
        self.geometry.record_upload(recorder, &self.casters.scene);
        self.look.record_upload(recorder, &self.casters.scene);
        for plane in &self.planes {
            plane.record_upload(recorder);
        }
        self.targets.record_unused(recorder);
    }

    /// Views of the lights onto the visible part of the scene.
    pub fn views(&self, sight: &Sight) -> Vec<LightView> {
        let per_place = pixels_per_place(&self.casters.scene);
        views(&self.lit, sight, per_place)
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

    /// Records what all searches of a region or list have in common. Passes use the sets `set` afterwards.
    pub fn record_planes(&self, recorder: &Recorder<'_>, views: &[LightView], set: &SampleSet) {
        let Search::Lists { lists, .. } = &self.search else {
            return;
        };
        recorder.section(PassTime::SHADOWS, || {
            for (view, resources) in views.iter().zip(&self.planes) {
                if let Some(set) = resources.set(0) {
                    let uniform = self.uniform(view, 1, resources);
                    lists.record(recorder, (resources, set), &uniform);
                }
            }
            set.show(recorder);
        });
    }

    /// Uniform block of a plane, for cells of `samples` samples.
    fn uniform(&self, view: &LightView, samples: u32, resources: &Resources) -> FrameUniform {
        let (scene, settings, sizes) = (&*self.casters.scene, &self.settings, resources.sizes());
        let cells = (Cells::Occluders, samples);
        let window = &view.window;
        window.uniform(scene, &view.pinhole, settings, cells, sizes)
    }

    /// Records the search for the lights that reach the places to be shaded next. Passes use the places'
    /// descriptor sets before and after.
    pub fn record(&self, recorder: &Recorder<'_>, shaded: Shadowed<'_>, receiving: Receiving) {
        recorder.section(PassTime::SHADOWS, || {
            if shaded.views.is_empty() {
                recorder.clear(&shaded.resources.shadow_words.buffer);
                return;
            }
            let first_place = match receiving {
                Receiving::Pixels(_) => 0,
                Receiving::Records => shaded.pixels(),
            };
            let target = ShadowTarget::Words { first_place };
            self.record_search(recorder, shaded, receiving, |plane| plane, target);
        });
    }

    /// Records marks for the pixels of a region in which a probe is reached by other lights than the centre. The
    /// shadows of the centres must have been found before. Passes use the region's descriptor sets before and after.
    pub fn record_probes(&self, recorder: &Recorder<'_>, shaded: Shadowed<'_>) {
        recorder.section(PassTime::SHADOWS, || {
            let receiving = Receiving::Pixels(shaded.size);
            let target = ShadowTarget::Marks { width: shaded.size[0] };
            for probe in LightPlane::probes() {
                self.record_search(recorder, shaded, receiving, |plane| plane.of(probe), target);
            }
        });
    }

    /// Records the search for all lights. `plane` is what `receivers` takes for the plane of a light.
    fn record_search(
        &self,
        recorder: &Recorder<'_>,
        shaded: Shadowed<'_>,
        receiving: Receiving,
        plane: impl Fn(LightPlane) -> LightPlane,
        target: ShadowTarget,
    ) {
        match &self.search {
            Search::Lists { occlude, .. } => {
                let (first_place, _) = target.pushed();
                let planes: Vec<_> = shaded.views.iter().map(|view| plane(view.plane)).collect();
                if let Some(any) = planes.first() {
                    self.receivers.record(recorder, shaded.set, receiving, any);
                }
                for (plane, resources) in planes.iter().zip(&self.planes) {
                    if let Some(set) = resources.set(0) {
                        set.show(recorder);
                        let receivers = (receiving, shaded.resources);
                        occlude.record(recorder, receivers, plane, first_place);
                    }
                }
            }
            Search::Samples { sampler, shade, shadow } => {
                let Some(resources) = self.planes.first() else {
                    return;
                };
                let Some(set) = resources.set(0) else {
                    return;
                };
                let (most, length) = match receiving {
                    Receiving::Pixels([width, height]) => (width * height, ListLength::Known),
                    Receiving::Records => {
                        let shading = shaded.resources;
                        let length = ListLength::Counted(&shading.arguments, Argument::Records);
                        (shading.sizes().record_capacity, length)
                    }
                };
                for view in shaded.views {
                    self.receivers.record(recorder, shaded.set, receiving, &plane(view.plane));
                    let uniform = self.uniform(view, sampler.samples(), resources);
                    resources.record_begin(recorder, set, &uniform);
                    let run = SamplerRun { resources, set, uniform: &uniform, list: (most, length), index: 0 };
                    let occlusion = Occlusion { shade: shade.as_ref(), shadow, target, light: view.bit };
                    sampler.record(recorder, &run, &occlusion);
                    shadow.record_left(recorder);
                }
            }
        }
        shaded.set.show(recorder);
    }

    /// Adds the work that the last recording could not finish.
    ///
    /// # Errors
    /// If its counters can't be read.
    pub fn add_shortfall(&self, shortfall: &mut Shortfall) -> Result<(), VulkanError> {
        shortfall.unshadowed += u64::from(self.unshadowed.read()?);
        Ok(())
    }
}

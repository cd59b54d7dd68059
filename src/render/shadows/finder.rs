//! Passes and memory that find shadows.

use super::casters::{Casters, Lit, caster_moment};
use super::light::{LightView, Sight, views};
use crate::engine::data::{Argument, Cells, Content, Offsets, ResourceSizes, Resources, SampleSet};
use crate::engine::passes::{ListLength, RasterTargets};
use crate::engine::pipelines::{FrameLayout, Pass};
use crate::engine::sampler::{
    Capacity, ListCells, RecordShading, Sampler, SamplerContext, SamplerRun, SamplerSettings,
    Shortfall,
};
use crate::engine::spirv::frame_set;
use crate::render::RenderError;
use crate::render::data::{FrameGeometry, FrameLook, GpuScene};
use crate::render::passes::{
    LightPlane, PosePass, Receivers, Receiving, ShadeSource, Shadow, ShadowTarget, shade,
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
    sampler: Sampler,
    /// Shading of casters that let light pass; `None` without such casters.
    shade: Option<Pass>,
    shadow: Shadow,
    pose: Option<PosePass>,
    geometry: FrameGeometry,
    look: FrameLook,
    resources: Resources,
    targets: RasterTargets,
    _locations: TexelBuffer,
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
    finder: &'a ShadowFinder,
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
        if let Some(shade) = &self.finder.shade {
            shade.record(recorder);
        }
    }

    fn record_round_end(&self, recorder: &Recorder<'_>) {
        let shadow = &self.finder.shadow;
        shadow.record(recorder, self.target, self.light);
    }
}

/// Kind of the lists with which casters are sampled.
const OCCLUDERS: ListCells = ListCells {
    cells: Cells::Occluders,
    attributes: false,
    shadow_words: 0,
    lent: true,
};

fn sizes(
    layout: &FrameLayout,
    casters: &Casters,
    settings: &SamplerSettings,
    capacity: Capacity,
    (places, shading): (u64, &ResourceSizes),
) -> ResourceSizes {
    let room = (shading.receivers(), [LightView::side(places); 2]);
    OCCLUDERS.sizes(layout, &*casters.scene, &settings.cells, room, capacity)
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
        let sizes = sizes(layout, casters, settings, capacity, (places, shading));
        let list = 32 * u64::from(shading.receivers());
        let scene = &*casters.scene;
        list + sizes.bytes() + FrameGeometry::bytes(scene) + FrameLook::bytes(scene)
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
        let sizes = sizes(
            layout,
            casters,
            settings,
            capacity,
            (places, shading.sizes()),
        );
        sizes.check("the largest list of shadows", layout.gpu.limits())?;
        let (offsets, count) = OCCLUDERS.offsets(layout, &settings.cells)?;
        let offsets = Offsets {
            all: &offsets,
            count,
        };
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
        let resources = Resources::new(
            layout,
            memory,
            occluding,
            &shown,
            &targets.views(),
            sizes,
            &[offsets],
        )?;
        let output = settings.color_constants(occluding);
        let context = SamplerContext {
            layout,
            memory,
            scene: occluding,
            settings,
            output: &output,
            sizes: &sizes,
            capacity: Capacity {
                samples_unlisted: true,
                ..capacity
            },
            // `shadow` counts on the device, so that no runs are counted here.
            runs: 0,
        };
        // SAFETY: the list lives as long as this, and has room for that many locations.
        let sampler = unsafe { OCCLUDERS.sampler(&context, (&resources, locations.texels())) }?;
        let opacities = || {
            let source = ShadeSource::Records {
                cells: Cells::Occluders,
            };
            shade::pass(layout, occluding, (source, 0), &output)
        };
        Ok(Self {
            shade: occluding.has_blend().then(opacities).transpose()?,
            receivers: Receivers::new(layout, scene, cells, shading, &locations.buffer)?,
            shadow: Shadow::new(layout, memory, shading)?,
            pose: occluding
                .moves()
                .then(|| PosePass::new(layout))
                .transpose()?,
            lit: casters.lit.clone(),
            moment: None,
            casters: casters.clone(),
            settings: settings.clone(),
            sampler,
            geometry,
            look,
            resources,
            targets,
            _locations: locations,
        })
    }

    /// Records initial copies to the device.
    pub fn record_upload(&self, recorder: &Recorder<'_>) {
        self.geometry.record_upload(recorder, &self.casters.scene);
        self.look.record_upload(recorder, &self.casters.scene);
        self.resources.record_upload(recorder);
        self.targets.record_unused(recorder);
    }

    /// Views of the lights onto the visible part of the scene.
    pub fn views(&self, sight: &Sight) -> Vec<LightView> {
        views(&self.lit, sight)
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
        self.shadow.record_begin(recorder);
        self.look.record(recorder);
        if let (Some(moment), Some(pose), Some(set)) =
            (&self.moment, &self.pose, self.resources.set(0))
        {
            self.geometry.write_moment(moment);
            set.show(recorder);
            pose.record(recorder, &self.casters.scene, &self.geometry, moment);
        }
    }

    /// Records the end of a frame or run.
    pub fn record_end(&self, recorder: &Recorder<'_>) {
        self.shadow.record_end(recorder);
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
            for view in shaded.views {
                self.record_view(recorder, shaded, receiving, (view, &view.plane), target);
            }
            shaded.set.show(recorder);
        });
    }

    /// Records marks for the pixels of a region in which a probe is reached by other lights than the centre. The
    /// shadows of the centres must have been found before. Passes use the region's descriptor sets before and after.
    pub fn record_probes(&self, recorder: &Recorder<'_>, shaded: Shadowed<'_>) {
        recorder.section(PassTime::SHADOWS, || {
            let receiving = Receiving::Pixels(shaded.pixels());
            let target = ShadowTarget::Marks {
                width: shaded.size[0],
            };
            for view in shaded.views {
                for plane in view.plane.of_probes() {
                    self.record_view(recorder, shaded, receiving, (view, &plane), target);
                }
            }
            shaded.set.show(recorder);
        });
    }

    fn record_view(
        &self,
        recorder: &Recorder<'_>,
        shaded: Shadowed<'_>,
        receiving: Receiving,
        (view, plane): (&LightView, &LightPlane),
        target: ShadowTarget,
    ) {
        let (scene, resources, shading) = (&*self.casters.scene, &self.resources, shaded.resources);
        let Some(set) = resources.set(0) else {
            return;
        };
        let (most, length) = match receiving {
            Receiving::Pixels(count) => (count, ListLength::Known),
            Receiving::Records => {
                let length = ListLength::Counted(&shading.arguments, Argument::Sort);
                (shading.sizes().record_capacity, length)
            }
        };
        let cells = (Cells::Occluders, self.sampler.samples());
        let (pinhole, window) = (&view.pinhole, &view.window);
        let uniform = window.uniform(scene, pinhole, &self.settings, cells, resources.sizes());
        self.receivers
            .record(recorder, shaded.set, receiving, plane);
        resources.record_begin(recorder, set, &uniform);
        let run = SamplerRun {
            resources,
            set,
            uniform: &uniform,
            list: (most, length),
            index: 0,
        };
        let occlusion = Occlusion {
            finder: self,
            target,
            light: view.bit,
        };
        self.sampler.record(recorder, &run, &occlusion);
        self.shadow.record_left(recorder);
    }

    /// Adds the work that the last recording could not finish.
    ///
    /// # Errors
    /// If its counters can't be read.
    pub fn add_shortfall(&self, shortfall: &mut Shortfall) -> Result<(), VulkanError> {
        let (left, other_subgroups) = self.shadow.left()?;
        shortfall.unshadowed += u64::from(left);
        shortfall.other_subgroups |= other_subgroups;
        Ok(())
    }
}

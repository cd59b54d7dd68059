//! One frame: its passes and memory, made once and recorded again and again.

mod delivery;
mod outcome;
mod passes;
pub(super) mod recording;
mod target;
mod uniform;

pub use target::Target;

use super::shadows::{Casters, ShadowFinder};
use super::{RenderError, Settings, Shadows};
use crate::camera::Camera;
use crate::engine::sampler::plan::{Capacity, Plan};
use crate::engine::sampler::{CounterLog, with_probes};
use crate::passes::{
    Cells, Content, Encoding, FrameLayout, Offsets, RasterTargets, ResourceSizes, Resources,
};
use crate::render::passes::{FrameGeometry, FrameLook, GpuScene};
use crate::scene::Moment;
use crate::vulkan::{Completion, Memory, Recorder, Timings};
use ash::vk;
use passes::{Passes, raster_samples};
use recording::Recording;
use std::ops::Range;
use std::sync::Arc;

/// Pipelines and memory for frames of one scene, which it keeps alive, of one size and method.
pub struct Frame {
    scene: Arc<GpuScene>,
    /// What casts shadows, and what finds these, where the settings ask for it.
    casters: Option<Arc<Casters>>,
    shadows: Option<ShadowFinder>,
    /// What is shown in the stead of the first pose.
    moment: Option<Arc<Moment>>,
    encoding: Option<Encoding>,
    reserved: u64,
    settings: Settings,
    plan: Plan,
    passes: Passes,
    targets: RasterTargets,
    geometry: FrameGeometry,
    look: FrameLook,
    resources: Resources,
    /// What the whole frame counted.
    counters: CounterLog,
    timings: Timings,
    memory: Memory,
    completion: Completion,
    /// Whether a recording with the uploads was executed.
    uploaded: bool,
}

/// Pixels of the whole image as it is drawn.
fn drawn_pixels(settings: &Settings) -> u64 {
    let drawn = settings.size.map(|side| u64::from(side * settings.side()));
    drawn.into_iter().product()
}

impl Frame {
    /// Of what the settings allow, `reserved` bytes are kept free for others.
    pub(super) fn new(
        layout: &Arc<FrameLayout>,
        (scene, casters): (&Arc<GpuScene>, Option<&Arc<Casters>>),
        settings: &Settings,
        encoding: Option<Encoding>,
        capacity: Capacity,
        reserved: u64,
    ) -> Result<Self, RenderError> {
        let settings = &settings.with_shadowed_samples();
        let casters = match settings.shadows {
            Shadows::None => None,
            Shadows::Exact => Some(casters.ok_or(RenderError::NoCasters)?),
        };
        let gpu = scene.memory().gpu().clone();
        let taken = scene.memory_bytes() + reserved;
        let beside_regions = taken + FrameGeometry::bytes(scene) + FrameLook::bytes(scene);
        let pixels = drawn_pixels(settings);
        let of_others = |sizes: &ResourceSizes| {
            let bytes =
                |casters| ShadowFinder::bytes(layout, casters, settings, capacity, (pixels, sizes));
            beside_regions + casters.map_or(0, |casters| bytes(casters))
        };
        let plan = Plan::new(
            settings,
            &**scene,
            gpu.limits(),
            (
                encoding,
                casters.map_or(0, |casters| casters.shadow_words()),
            ),
            capacity,
            &of_others,
        )?;
        let memory = Memory::new(
            gpu.clone(),
            settings.max_memory.map(|limit| limit.saturating_sub(taken)),
        );
        let [width, height] = plan.sizes.region;
        let targets = RasterTargets::new(
            &memory,
            width,
            height,
            raster_samples(settings),
            scene.has_blend(),
        )?;
        let offsets = settings.offsets()?;
        let sample_count = offsets.len() as u32;
        let offsets = with_probes(offsets)?;
        let centre = Offsets {
            all: &[[0.0, 0.0]],
            count: 1,
        };
        let offsets = Offsets {
            all: &offsets,
            count: sample_count,
        };
        let geometry = FrameGeometry::new(&memory, scene, true)?;
        let look = FrameLook::new(&memory, scene)?;
        let mut texels = geometry.texels(scene);
        texels.push(look.texels(scene));
        let resources = Resources::new(
            layout,
            &memory,
            &**scene,
            (&texels, look.lights(scene)),
            &targets.views(),
            plan.sizes,
            &[centre, offsets],
        )?;
        let passes = Passes::new(layout, &memory, scene, settings, &plan, encoding)?;
        let shadows = |casters| {
            let shading = (&**scene, Cells::Pixels, &resources);
            ShadowFinder::new(
                layout, &memory, casters, settings, capacity, shading, pixels,
            )
        };
        let shadows = casters.map(shadows).transpose()?;
        let regions = plan.regions.len() as u64;
        let runs = 2 + settings.growths();
        let marks = regions as u32 * (18 + runs * 14) + 8;
        Ok(Self {
            scene: scene.clone(),
            casters: casters.cloned(),
            shadows,
            moment: None,
            encoding,
            reserved,
            passes,
            targets,
            geometry,
            look,
            resources,
            counters: CounterLog::new(&memory, 1)?,
            timings: Timings::new(&gpu, marks)?,
            settings: settings.clone(),
            plan,
            completion: Completion::new(&gpu)?,
            memory,
            uploaded: false,
        })
    }

    /// The settings it was prepared with.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Shows another moment of the motion that its scene was prepared with, from the next recording on: that one hands the
    /// device the moment's matrices and weights and what changes of materials and lights, and nothing else. Nothing waits for
    /// the device.
    ///
    /// # Errors
    /// [`RenderError::OtherMotion`] if the moment is one of another motion.
    pub fn show(&mut self, moment: Arc<Moment>) -> Result<(), RenderError> {
        if !self.scene.has_moment(&moment) {
            return Err(RenderError::OtherMotion);
        }
        if let Some(shadows) = &mut self.shadows {
            shadows.show(&moment);
        }
        self.look.show(&self.scene, &moment);
        self.moment = Some(moment);
        Ok(())
    }

    pub(super) fn moment(&self) -> Option<&Arc<Moment>> {
        self.moment.as_ref()
    }

    pub(super) fn scene(&self) -> &Arc<GpuScene> {
        &self.scene
    }

    pub(super) fn casters(&self) -> Option<&Arc<Casters>> {
        self.casters.as_ref()
    }

    pub(super) fn encoding(&self) -> Option<Encoding> {
        self.encoding
    }

    /// Bytes of what the settings allow that are others'.
    pub(super) fn reserved(&self) -> u64 {
        self.reserved
    }

    /// What it was planned for.
    pub(super) fn capacity(&self) -> Capacity {
        self.plan.capacity
    }

    /// Whether [`Capacity::with_doubled_lists`] makes any difference.
    pub(super) fn lists_can_grow(&self) -> bool {
        self.plan.lists_can_grow && self.settings.max_memory.is_none()
    }

    /// Bytes of device memory that it takes.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        self.memory.used()
    }

    /// Records a frame. It submits nothing, waits for nothing and allocates nothing.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass and of conditional rendering, for the device and queue family of the renderer.
    /// - The upload of the frame's scene was recorded before, and is executed before these commands.
    /// - The commands of this frame's last recording are done, or will never be executed: its memory is used again.
    /// - The frame, which keeps its scene alive, outlives the execution of the commands; so do the target's handles.
    /// - The target's handles are of the settings' output size, and as [`Target`] says.
    pub unsafe fn record(&mut self, camera: &Camera, commands: vk::CommandBuffer, target: &Target) {
        let regions = 0..self.regions();
        // SAFETY: passed on to the caller.
        unsafe { self.record_regions(camera, commands, target, regions) };
    }

    /// Regions that the image is made in.
    pub(super) fn regions(&self) -> usize {
        self.plan.regions.len()
    }

    /// As [`Frame::record`], some of the regions: those of an image may be recorded into several command buffers.
    ///
    /// # Safety
    /// As [`Frame::record`]; and the regions before are recorded, and executed before these.
    pub(super) unsafe fn record_regions(
        &mut self,
        camera: &Camera,
        commands: vk::CommandBuffer,
        target: &Target,
        regions: Range<usize>,
    ) {
        let gpu = self.memory.gpu().clone();
        // SAFETY: passed on to the caller.
        let mut recorder = unsafe { Recorder::new(&gpu, commands, Some(&mut self.timings)) };
        let is_last = regions.end == self.plan.regions.len();
        if regions.start == 0 {
            self.uploaded |= self.completion.begin(&recorder);
            if !self.uploaded {
                self.geometry.record_upload(&recorder, &self.scene);
                self.look.record_upload(&recorder, &self.scene);
                self.resources.record_upload(&recorder);
                if let Some(shadows) = &self.shadows {
                    shadows.record_upload(&recorder);
                }
            }
            if let Some(shadows) = &mut self.shadows {
                shadows.record_begin(&recorder);
            }
            if let Some(moment) = &self.moment {
                self.geometry.write_moment(moment);
            }
            self.look.record(&recorder);
        }
        let to_clip = uniform::to_clip(&self.scene, camera, &self.settings);
        let side = self.settings.side();
        let image = self.settings.size.map(|pixels| pixels * side);
        self.geometry.place(&self.scene, &to_clip, Some(image));
        let recording = Recording {
            settings: &self.settings,
            plan: &self.plan,
            passes: &self.passes,
            targets: &self.targets,
            geometry: &self.geometry,
            resources: &self.resources,
            shadows: self.shadows.as_ref(),
            counters: &self.counters,
            scene: &self.scene,
            moment: self.moment.as_deref(),
            camera,
            target,
        };
        recording.record(&mut recorder, regions);
        if is_last {
            self.completion.end(&recorder);
        }
    }
}

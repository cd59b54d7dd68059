//! A frame: its passes and memory, made once and recorded any number of times.

mod delivery;
mod outcome;
mod passes;
pub(super) mod recording;
mod target;
mod uniform;

pub use target::Target;

use super::shadows::{Casters, ShadowFinder, ShadowRequest};
use super::{RenderError, Settings, Shadows};
use crate::camera::Camera;
use crate::engine::data::{Cells, Content, Offsets, ResourceRequest, ShownIds};
use crate::engine::passes::RasterTargets;
use crate::engine::pipelines::FrameLayout;
use crate::engine::sampler::plan::Plan;
use crate::engine::sampler::{Capacity, Job};
use crate::render::data::{FrameGeometry, FrameLook, GpuScene};
use crate::render::passes::Encoding;
use crate::scene::Moment;
use crate::vulkan::{Memory, Recorder};
use ash::vk;
use passes::{Passes, raster_samples};
use recording::FrameRecording;
use std::ops::Range;
use std::sync::Arc;

/// Pipelines and memory for frames of one scene in one size with one method. A frame keeps its scene alive.
pub struct SceneFrame {
    scene: Arc<GpuScene>,
    /// Casters of shadows, and the passes that find the shadows; `None` for settings without shadows.
    casters: Option<Arc<Casters>>,
    shadows: Option<ShadowFinder>,
    /// Moment that is shown instead of the first pose.
    moment: Option<Arc<Moment>>,
    encoding: Option<Encoding>,
    reserved: u64,
    settings: Settings,
    plan: Plan,
    passes: Passes,
    targets: RasterTargets,
    geometry: FrameGeometry,
    look: FrameLook,
    job: Job,
}

/// Number of pixels of the whole image at the resolution that is rasterized.
fn drawn_pixels(settings: &Settings) -> u64 {
    let side = settings.method.side();
    let drawn = settings.size.map(|pixels| u64::from(pixels * side));
    drawn.into_iter().product()
}

impl SceneFrame {
    /// Prepares a frame. `reserved` bytes of the memory that the settings allow are left to other owners.
    pub(super) fn new(
        layout: &Arc<FrameLayout>,
        scene: &Arc<GpuScene>,
        casters: Option<&Arc<Casters>>,
        asked: &Settings,
        encoding: Option<Encoding>,
        capacity: Capacity,
        reserved: u64,
    ) -> Result<Self, RenderError> {
        // Only passes and memory depend on how samples are shaded.
        let settings = &asked.clone().with_shadowed_samples();
        let sampler = asked.merging_sampler(&**scene);
        let casters = match settings.scene.shadows {
            Shadows::None => None,
            Shadows::Exact => Some(casters.ok_or(RenderError::NoCasters)?),
        };
        let gpu = scene.memory.gpu().clone();
        let taken = scene.memory_bytes() + reserved;
        let beside_regions = taken + FrameGeometry::bytes(scene) + FrameLook::bytes(scene);
        let shadows = casters.map(|casters| ShadowRequest {
            layout,
            casters,
            settings: &sampler,
            capacity,
            places: drawn_pixels(settings),
            max_memory: settings.scene.max_memory,
        });
        let plan = Plan::new(
            &settings.image(),
            &**scene,
            gpu.limits(),
            encoding.map_or(0, Encoding::encoded_bytes),
            casters.map_or(0, |casters| casters.shadow_words()),
            capacity,
            beside_regions + shadows.map_or(0, |request| request.bytes()),
        )?;
        let memory = Memory::new(gpu.clone(), settings.scene.max_memory.map(|limit| limit.saturating_sub(taken)));
        let [width, height] = plan.sizes.region;
        let targets = RasterTargets::new(&memory, width, height, raster_samples(settings), scene.has_blend())?;
        let offsets = settings.method.offsets()?;
        let sample_count = offsets.len() as u32;
        let centre = Offsets { all: &[[0.0, 0.0]], count: 1 };
        let offsets = Offsets { all: &offsets, count: sample_count };
        let geometry = FrameGeometry::new(&memory, scene, true)?;
        let look = FrameLook::new(&memory, scene)?;
        let mut shown = geometry.shown(scene);
        shown.extend(look.shown(scene));
        let request = ResourceRequest {
            sizes: plan.sizes,
            others: &shown,
            ids: ShownIds::Drawn(targets.views()),
            offsets: &[centre, offsets],
            scratch: None,
        };
        let job = Job::new(layout, memory, &sampler, capacity, &request)?.with_repetitions(settings.scene.time_rounds);
        let passes = Passes::new(layout, &job, scene, settings, plan.regions.len(), encoding)?;
        let finder = |request| ShadowFinder::new(&request, job.memory(), scene, Cells::Pixels, job.resources());
        let shadows = shadows.map(finder).transpose()?;
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
            settings: asked.clone(),
            plan,
            job,
        })
    }

    /// Settings with which the frame was prepared.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Shows another moment of the motion with which the scene was prepared, from the next recording on. That
    /// recording uploads the moment's matrices and weights and the changes of materials and lights, nothing else. This
    /// does not wait for the device.
    ///
    /// # Errors
    /// [`RenderError::OtherMotion`] if the moment belongs to another motion.
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

    /// Bytes of the memory that the settings allow which are left to other owners.
    pub(super) fn reserved(&self) -> u64 {
        self.reserved
    }

    /// Capacity with which the frame was planned.
    pub(super) fn capacity(&self) -> Capacity {
        self.job.capacity()
    }

    /// Whether [`Capacity::with_lists`] makes a difference.
    pub(super) fn lists_can_grow(&self) -> bool {
        self.plan.lists_can_grow && self.settings.scene.max_memory.is_none()
    }

    /// Bytes of device memory of the frame, without its scene.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        self.job.memory().used()
    }

    /// Records a frame into `commands`. It submits nothing, waits for nothing and allocates nothing.
    ///
    /// # Safety
    /// - `commands` is being recorded, outside of a render pass and of conditional rendering, for the device and queue
    ///   family of the renderer.
    /// - The upload of the frame's scene was recorded before, and is executed before these commands.
    /// - The commands of this frame's previous recording have run, or will never be executed: the frame's memory is
    ///   used again.
    /// - If the commands are submitted again, results are read only when that submission is done: until the device begins
    ///   it, it is taken for done.
    /// - The frame, which keeps its scene alive, outlives the execution of the commands; so do the target's handles.
    /// - The target has the settings' output size and the properties that [`Target`] requires.
    pub unsafe fn record(&mut self, camera: &Camera, commands: vk::CommandBuffer, target: &Target) {
        let regions = 0..self.regions();
        // SAFETY: guaranteed by the caller.
        unsafe { self.record_regions(camera, commands, target, regions) };
    }

    /// Number of regions in which the image is rendered.
    pub(super) fn regions(&self) -> usize {
        self.plan.regions.len()
    }

    /// Records some of the regions of a frame, as [`SceneFrame::record`] records all; an image's regions may be recorded
    /// into several command buffers.
    ///
    /// # Safety
    /// As [`SceneFrame::record`]; and the regions before `regions` were recorded, and are executed before these.
    pub(super) unsafe fn record_regions(
        &mut self,
        camera: &Camera,
        commands: vk::CommandBuffer,
        target: &Target,
        regions: Range<usize>,
    ) {
        let is_last = regions.end == self.plan.regions.len();
        let recording = if regions.start == 0 {
            let upload = |recorder: &Recorder<'_>| {
                self.geometry.record_upload(recorder, &self.scene);
                self.look.record_upload(recorder, &self.scene);
                if let Some(shadows) = &self.shadows {
                    shadows.record_upload(recorder);
                }
            };
            // SAFETY: guaranteed by the caller.
            let recording = unsafe { self.job.begin(commands, upload) };
            if let Some(shadows) = &mut self.shadows {
                shadows.record_begin(&recording.recorder);
            }
            if let Some(moment) = &self.moment {
                self.geometry.write_moment(moment);
            }
            self.look.record(&recording.recorder);
            recording
        } else {
            // SAFETY: guaranteed by the caller.
            unsafe { self.job.go_on(commands) }
        };
        let to_clip = uniform::to_clip(&self.scene, camera, &self.settings);
        let side = self.settings.method.side();
        let image = self.settings.size.map(|pixels| pixels * side);
        self.geometry.place(&self.scene, &to_clip, Some(image));
        let regions_of_frame = FrameRecording {
            settings: &self.settings,
            sampler: recording.settings,
            plan: &self.plan,
            passes: &self.passes,
            targets: &self.targets,
            geometry: &self.geometry,
            resources: recording.resources,
            shadows: self.shadows.as_ref(),
            scene: &self.scene,
            moment: self.moment.as_deref(),
            camera,
            target,
        };
        regions_of_frame.record(&recording.recorder, regions);
        if is_last {
            recording.end();
        }
    }
}

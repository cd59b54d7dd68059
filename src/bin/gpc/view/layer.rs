//! A picture of the scene under one method of antialiasing, and the frames that refine it.

use super::band::Took;
use super::engine::Engine;
use super::look::Look;
use super::picture::Picture;
use super::preparer::{Preparer, Ticket};
use super::schedule::{PictureSchedule, PictureWork};
use ash::vk;
use gpc::camera::Camera;
use gpc::render::{EngineError, PixelRect, PreparedScene, RenderError, SceneFrame, Settings, Statistics};
use gpc::scene::Moment;
use std::sync::{Arc, Weak};
use std::time::Instant;

/// Number of times that a frame's capacity is raised before the error is reported.
const RETRIES: u32 = 6;

/// A picture of the scene, at most as large as the window.
pub struct Layer {
    pub look: Look,
    pub schedule: PictureSchedule,
    picture: Picture,
    /// Picture that is shown until this layer has rendered something.
    before: Option<Picture>,
    /// Ticket that identifies the layer to the preparer.
    ticket: Ticket,
    /// Frames of drafts that are not in use.
    spare: Vec<SceneFrame>,
    /// A frame for bands that is not in use.
    band: Option<SceneFrame>,
    /// Settings of the frames that are being prepared.
    asked: Vec<Settings>,
    /// Work that waits until its frame is prepared.
    waiting: Option<PictureWork>,
    /// Work to repeat, the frame with more room for it, and the number of repetitions.
    again: Option<(PictureWork, SceneFrame, u32)>,
    /// Number of the picture, which tells the results of older pictures apart.
    version: u64,
    /// Samples a pixel of the visible picture, if all of its pixels have the same number.
    pub shown: Option<u32>,
    /// Statistics of the work on the visible picture.
    pub statistics: Statistics,
}

/// Work that the device has not finished, and the objects that it uses.
pub struct Job {
    /// Ticket of the layer that takes the job back.
    pub ticket: Weak<()>,
    frame: SceneFrame,
    work: PictureWork,
    version: u64,
    tries: u32,
    /// Picture that a band is rendered to before it is copied; kept until the job is done.
    _band: Option<Picture>,
}

/// Subject of a picture: scene, camera and moment.
pub struct Sight<'a> {
    pub scene: &'a Arc<PreparedScene>,
    pub camera: &'a Camera,
    pub moment: Option<&'a Arc<Moment>>,
}

impl Layer {
    /// Makes a layer that has rendered nothing yet.
    pub fn new(engine: &Engine, look: Look, now: Instant) -> anyhow::Result<Self> {
        Ok(Self {
            picture: Picture::new(&engine.device, look.settings.size)?,
            before: None,
            schedule: PictureSchedule::new(&look, now),
            look,
            ticket: Ticket::default(),
            spare: Vec::new(),
            band: None,
            asked: Vec::new(),
            waiting: None,
            again: None,
            version: 0,
            shown: None,
            statistics: Statistics::default(),
        })
    }

    /// Shows another picture until this layer has rendered something.
    pub fn set_before(&mut self, before: Picture) {
        self.before = Some(before);
    }

    /// Picture that is shown at present.
    pub fn picture(&self) -> &Picture {
        let before = self.before.as_ref();
        before.filter(|_| !self.picture.is_written()).unwrap_or(&self.picture)
    }

    /// Splits the layer into the picture that is shown, for use until another layer has something to show, and the
    /// picture that is not shown.
    pub fn into_pictures(self) -> (Picture, Option<Picture>) {
        match self.before {
            Some(before) if !self.picture.is_written() => (before, Some(self.picture)),
            before => (self.picture, before),
        }
    }

    /// Starts a new picture because the view or the scene has changed.
    pub fn restart(&mut self, now: Instant) {
        self.schedule.restart(now);
        self.again = None;
        self.waiting = None;
        self.version += 1;
    }

    /// Records the next work that is due, if any.
    ///
    /// # Errors
    /// If memory runs out.
    ///
    /// # Safety
    /// `commands` is being recorded for the engine's device, to which the scene was uploaded. The job and this layer (or
    /// the pictures of [`Self::into_pictures`]) outlive the execution of the commands.
    pub unsafe fn record(
        &mut self,
        (engine, preparer): (&Arc<Engine>, &Preparer),
        commands: vk::CommandBuffer,
        sight: &Sight<'_>,
        now: Instant,
    ) -> anyhow::Result<Option<Job>> {
        let (work, mut frame, tries) = match self.again.take() {
            Some(again) => again,
            None => {
                let waited = self.waiting.take();
                let Some(work) = waited.or_else(|| self.schedule.take(now)) else {
                    return Ok(None);
                };
                let settings = self.settings(&work);
                let Some(frame) = self.frame(&settings) else {
                    if !self.asked.contains(&settings) {
                        self.asked.push(settings.clone());
                        preparer.ask(&self.ticket, settings, sight.scene, engine);
                    }
                    self.waiting = Some(work);
                    return Ok(None);
                };
                (work, frame, 0)
            }
        };
        if let Some(moment) = sight.moment {
            frame.show(moment.clone())?;
        }
        let band = if work.is_draft {
            let target = self.picture.target();
            // SAFETY: guaranteed by the caller; commands that used a spare frame have run, and the picture has the
            // frame's size.
            unsafe { frame.record(sight.camera, commands, &target) };
            None
        } else {
            let mut band = Picture::new(&engine.device, frame.settings().output_size())?;
            let target = band.target();
            // SAFETY: as above; the band lies in the picture, and the job keeps it.
            unsafe {
                frame.record(sight.camera, commands, &target);
                self.picture.record_rows(commands, &band, work.rows.start);
            }
            Some(band)
        };
        Ok(Some(Job { ticket: Arc::downgrade(&self.ticket), frame, work, version: self.version, tries, _band: band }))
    }

    /// Finishes a job that the device has done.
    ///
    /// # Errors
    /// If the work is still too large after all retries, or its statistics can't be read.
    pub fn finish(&mut self, engine: &Engine, job: Job) -> Result<(), RenderError> {
        let is_current = job.version == self.version;
        match job.frame.statistics() {
            Ok(statistics) => {
                log::trace!("{:?} took {:.1} ms", job.work, statistics.gpu_ms());
                self.schedule.learn(&job.work, Took::of(&statistics), Instant::now());
                if is_current {
                    self.note(&job.work, statistics);
                }
                if job.work.is_draft {
                    self.spare.push(job.frame);
                }
                Ok(())
            }
            Err(RenderError::Engine(EngineError::Unfinished { .. })) if job.tries < RETRIES => {
                if is_current {
                    let frame = engine.renderer.prepare_again(&job.frame)?;
                    self.again = Some((job.work, frame, job.tries + 1));
                }
                Ok(())
            }
            Err(error) => Err(error),
        }
    }

    /// Whether frames and jobs with this ticket belong to the layer.
    pub fn is_meant(&self, ticket: &Weak<()>) -> bool {
        Weak::ptr_eq(&Arc::downgrade(&self.ticket), ticket)
    }

    /// Takes a frame that was requested, or the error of preparing it.
    pub fn prepared(&mut self, settings: &Settings, frame: Result<SceneFrame, RenderError>) -> Result<(), RenderError> {
        self.asked.retain(|asked| asked != settings);
        match frame {
            Ok(frame) if settings.region.is_none() => self.spare.push(frame),
            Ok(frame) => self.band = Some(frame),
            Err(error) => {
                self.waiting = None;
                return Err(error);
            }
        }
        Ok(())
    }

    /// Whether work waits for its frame to be prepared.
    pub fn is_waiting(&self) -> bool {
        self.waiting.is_some()
    }

    /// Time at which the next work is due; `None` while work waits for its frame.
    pub fn due(&self) -> Option<Instant> {
        self.schedule.due().filter(|_| !self.is_waiting())
    }

    /// Whether work has to be repeated, which can be done at once.
    pub fn has_again(&self) -> bool {
        self.again.is_some()
    }

    /// Adds the statistics of work on the visible picture.
    fn note(&mut self, work: &PictureWork, statistics: Statistics) {
        let is_last = work.rows.end == self.picture.size()[1];
        self.shown = is_last.then_some(work.samples);
        if work.rows.start == 0 {
            self.statistics = Statistics { skipped_passes: statistics.skipped_passes.clone(), ..Statistics::default() };
        }
        // A pass counts as skipped if no band needed it.
        let skipped = &mut self.statistics.skipped_passes;
        skipped.retain(|pass| statistics.skipped_passes.contains(pass));
        self.statistics.append(statistics);
    }

    /// A prepared frame for these settings, if there is one. Frames of drafts are reused while the settings stay, and
    /// dropped otherwise.
    fn frame(&mut self, settings: &Settings) -> Option<SceneFrame> {
        if settings.region.is_some() {
            return self.band.take_if(|frame| frame.settings() == settings);
        }
        self.spare.retain(|frame| frame.settings() == settings);
        self.spare.pop()
    }

    fn settings(&self, work: &PictureWork) -> Settings {
        if work.is_draft {
            return self.look.draft(work.samples);
        }
        let size = [self.look.settings.size[0], work.rows.end - work.rows.start];
        self.look.at(work.samples, Some(PixelRect { corner: [0, work.rows.start], size }))
    }
}

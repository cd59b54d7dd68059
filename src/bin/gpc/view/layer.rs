//! A picture of the scene with one way of antialiasing, and the frames that refine it.

use super::engine::Engine;
use super::look::Look;
use super::picture::Picture;
use super::preparer::{Preparer, Ticket};
use super::schedule::{PictureWork, Schedule, Took};
use ash::vk;
use gpc::camera::Camera;
use gpc::render::{Frame, PixelRect, PreparedScene, RenderError, Settings, Shadows, Statistics};
use gpc::scene::Moment;
use std::sync::{Arc, Weak};
use std::time::Instant;

/// A frame's capacity is raised this often before what is lacking is said.
const RETRIES: u32 = 6;

/// A picture of the scene, at most as large as the window.
pub struct Layer {
    pub look: Look,
    pub schedule: Schedule,
    picture: Picture,
    /// Seen until there is something in the picture.
    before: Option<Picture>,
    /// Ticket that identifies the layer to the preparer.
    ticket: Ticket,
    /// Frames of drafts that nothing uses just now.
    spare: Vec<Frame>,
    /// A frame of a band that nothing uses.
    band: Option<Frame>,
    /// Settings of the frames that are being prepared.
    asked: Vec<Settings>,
    /// Work that waits for its frame.
    waiting: Option<PictureWork>,
    /// Work to do again, in a frame that has more room.
    again: Option<(PictureWork, Frame, u32)>,
    /// Number of the picture, by which results of older pictures are recognised.
    version: u64,
    /// Samples a pixel of the picture that is shown, if all of its pixels have the same number.
    pub shown: Option<u32>,
    /// Figures of the last work.
    pub statistics: Statistics,
}

/// Work that the device has not done yet, and what it uses.
pub struct Job {
    /// Ticket of the layer that takes the job back.
    pub ticket: Weak<()>,
    frame: Frame,
    work: PictureWork,
    version: u64,
    tries: u32,
    /// Picture that a band is rendered to before it is copied.
    _band: Option<Picture>,
}

/// Scene and camera of a picture.
pub struct Sight<'a> {
    pub scene: &'a Arc<PreparedScene>,
    pub camera: &'a Camera,
    pub moment: Option<&'a Arc<Moment>>,
}

impl Layer {
    /// Makes a layer of which nothing is rendered yet.
    pub fn new(engine: &Engine, look: Look, now: Instant) -> anyhow::Result<Self> {
        Ok(Self {
            picture: Picture::new(&engine.device, look.settings.size)?,
            before: None,
            schedule: Schedule::new(&look, now),
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
        before
            .filter(|_| !self.picture.is_written())
            .unwrap_or(&self.picture)
    }

    /// Splits the layer into the picture that is shown, for use until another layer has something to show, and one that
    /// is not shown.
    pub fn into_pictures(self) -> (Picture, Option<Picture>) {
        match self.before {
            Some(before) if !self.picture.is_written() => (before, Some(self.picture)),
            before => (self.picture, before),
        }
    }

    /// The picture is another one from now on: something moved.
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
    /// `commands` is being recorded for the engine's device, after the upload of the scene; the job, and this or what
    /// [`Self::into_pictures`] hands over, outlive their execution.
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
        let band = match &work {
            PictureWork::Draft { .. } => {
                let target = self.picture.target();
                // SAFETY: passed on to the caller; spare frames were waited for, and the picture has the frame's size.
                unsafe { frame.record(sight.camera, commands, &target) };
                None
            }
            PictureWork::Band { rows, .. } => {
                let mut band = Picture::new(&engine.device, frame.settings().output_size())?;
                let target = band.target();
                // SAFETY: as above; the band lies in the picture, and the job keeps it.
                unsafe {
                    frame.record(sight.camera, commands, &target);
                    self.picture.record_rows(commands, &band, rows.start);
                }
                Some(band)
            }
        };
        Ok(Some(Job {
            ticket: Arc::downgrade(&self.ticket),
            frame,
            work,
            version: self.version,
            tries,
            _band: band,
        }))
    }

    /// Takes back a job that the device has done.
    ///
    /// # Errors
    /// If the frame can't be finished however often its work is split, or its figures can't be read.
    pub fn finish(&mut self, engine: &Engine, job: Job) -> Result<(), RenderError> {
        let is_current = job.version == self.version;
        match job.frame.statistics() {
            Ok(statistics) => {
                log::trace!("{:?} took {:.1} ms", job.work, statistics.gpu_ms());
                self.schedule
                    .learn(&job.work, Took::of(&statistics), Instant::now());
                if is_current {
                    self.note(&job.work, statistics);
                }
                if let PictureWork::Draft { .. } = job.work {
                    self.spare.push(job.frame);
                }
                Ok(())
            }
            Err(RenderError::Unfinished { .. }) if job.tries < RETRIES => {
                if is_current {
                    let frame = engine.renderer.prepare_again(&job.frame)?;
                    self.again = Some((job.work, frame, job.tries + 1));
                }
                Ok(())
            }
            Err(error) => Err(error),
        }
    }

    /// Whether frames and jobs of this ticket are the layer's.
    pub fn is_meant(&self, ticket: &Weak<()>) -> bool {
        Weak::ptr_eq(&Arc::downgrade(&self.ticket), ticket)
    }

    /// Takes a frame that was asked for, or the error of preparing it.
    pub fn prepared(
        &mut self,
        settings: &Settings,
        frame: Result<Frame, RenderError>,
    ) -> Result<(), RenderError> {
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

    /// Whether there is work whose frame is being prepared.
    pub fn is_waiting(&self) -> bool {
        self.waiting.is_some()
    }

    /// Time at which the next work is due, if it waits for nothing else.
    pub fn due(&self) -> Option<Instant> {
        self.schedule.due().filter(|_| !self.is_waiting())
    }

    /// Whether there is work that waits for nothing.
    pub fn has_again(&self) -> bool {
        self.again.is_some()
    }

    /// Adds figures of work on the picture that is seen.
    fn note(&mut self, work: &PictureWork, statistics: Statistics) {
        let is_first = match work {
            PictureWork::Draft { samples } => {
                self.shown = Some(*samples);
                true
            }
            PictureWork::Band { samples, rows } => {
                let is_last = rows.end == self.picture.size()[1];
                self.shown = is_last.then_some(*samples);
                rows.start == 0
            }
        };
        if is_first {
            self.statistics = Statistics {
                skipped_passes: statistics.skipped_passes.clone(),
                ..Statistics::default()
            };
        }
        // Of the whole picture, what no band needed.
        let skipped = &mut self.statistics.skipped_passes;
        skipped.retain(|pass| statistics.skipped_passes.contains(pass));
        self.statistics.append(statistics);
    }

    /// A frame of these settings, if one is prepared. Drafts use theirs again, and let go of others.
    fn frame(&mut self, settings: &Settings) -> Option<Frame> {
        if settings.region.is_some() {
            return self.band.take_if(|frame| frame.settings() == settings);
        }
        self.spare.retain(|frame| frame.settings() == settings);
        self.spare.pop()
    }

    fn settings(&self, work: &PictureWork) -> Settings {
        let settings = match work {
            PictureWork::Draft { samples } => self.look.draft(*samples),
            PictureWork::Band { samples, rows } => self.look.at(
                *samples,
                Some(PixelRect {
                    corner: [0, rows.start],
                    size: [self.look.settings.size[0], rows.end - rows.start],
                }),
            ),
        };
        // Shadows are for pictures of the worker: they would take frames too long.
        Settings {
            shadows: Shadows::None,
            ..settings
        }
    }
}

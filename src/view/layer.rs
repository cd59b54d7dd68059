//! A picture of the scene with one way of antialiasing, and the frames that refine it.

use super::engine::Engine;
use super::look::Look;
use super::picture::Picture;
use super::schedule::{Schedule, Work};
use ash::vk;
use gpc::camera::Camera;
use gpc::passes::Encoding;
use gpc::render::{Frame, PixelRect, PreparedScene, RenderError, Settings, Shadows, Statistics};
use gpc::scene::Moment;
use std::sync::Arc;
use std::time::Instant;

/// A frame's capacity is raised this often before what is lacking is said.
const RETRIES: u32 = 6;

/// A picture of the scene, at most as large as the window.
pub struct Layer {
    pub look: Look,
    pub schedule: Schedule,
    picture: Picture,
    /// Frames of drafts that nothing uses just now.
    spare: Vec<Frame>,
    /// Work to do again, in a frame that has more room.
    again: Option<(Work, Frame, u32)>,
    /// Counts pictures, so that the results of older ones are told apart.
    version: u64,
    /// Samples of what is seen, where all of it has as many.
    pub shown: Option<u32>,
    /// Figures of the last work.
    pub statistics: Statistics,
}

/// Work that the device has not done yet, and what it uses.
pub struct Job {
    frame: Frame,
    work: Work,
    version: u64,
    tries: u32,
    /// Where a band is rendered before its copy.
    _band: Option<Picture>,
}

/// What is seen, and where from.
pub struct Sight<'a> {
    pub scene: &'a PreparedScene,
    pub camera: &'a Camera,
    pub moment: Option<&'a Arc<Moment>>,
}

impl Layer {
    /// A picture of which nothing is rendered.
    pub fn new(engine: &Engine, look: Look, now: Instant) -> anyhow::Result<Self> {
        Ok(Self {
            picture: Picture::new(&engine.device, look.settings.size)?,
            schedule: Schedule::new(&look, now),
            look,
            spare: Vec::new(),
            again: None,
            version: 0,
            shown: None,
            statistics: Statistics::default(),
        })
    }

    /// What is rendered so far.
    pub fn picture(&self) -> &Picture {
        &self.picture
    }

    /// The picture is another one from now on: something moved.
    pub fn restart(&mut self, now: Instant) {
        self.schedule.restart(now);
        self.again = None;
        self.version += 1;
    }

    /// Records the next work that is due, if any.
    ///
    /// # Errors
    /// If memory runs out or the settings are impossible.
    ///
    /// # Safety
    /// `commands` is being recorded for the engine's device, after the upload of the scene; this and the job outlive their
    /// execution.
    pub unsafe fn record(
        &mut self,
        engine: &Engine,
        commands: vk::CommandBuffer,
        sight: &Sight<'_>,
        now: Instant,
    ) -> anyhow::Result<Option<Job>> {
        let (work, mut frame, tries) = match self.again.take() {
            Some(again) => again,
            None => {
                let Some(work) = self.schedule.take(now) else {
                    return Ok(None);
                };
                let frame = self.frame(engine, sight.scene, &work)?;
                (work, frame, 0)
            }
        };
        if let Some(moment) = sight.moment {
            frame.show(moment.clone())?;
        }
        let band = match &work {
            Work::Draft { .. } => {
                let target = self.picture.target();
                // SAFETY: passed on to the caller; spare frames were waited for, and the picture has the frame's size.
                unsafe { frame.record(sight.camera, commands, &target) };
                None
            }
            Work::Band { rows, .. } => {
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
                    .learn(&job.work, statistics.gpu_ms(), Instant::now());
                if is_current {
                    self.note(&job.work, statistics);
                }
                if let Work::Draft { .. } = job.work {
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

    /// Whether there is work that waits for nothing.
    pub fn has_again(&self) -> bool {
        self.again.is_some()
    }

    /// Adds figures of work on the picture that is seen.
    fn note(&mut self, work: &Work, statistics: Statistics) {
        let is_first = match work {
            Work::Draft { samples } => {
                self.shown = Some(*samples);
                true
            }
            Work::Band { samples, rows } => {
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

    /// A frame for some work: one that was used before, where it fits.
    fn frame(
        &mut self,
        engine: &Engine,
        scene: &PreparedScene,
        work: &Work,
    ) -> Result<Frame, RenderError> {
        let settings = match work {
            Work::Draft { samples } => {
                self.spare
                    .retain(|frame| frame.settings().samples == *samples);
                if let Some(frame) = self.spare.pop() {
                    return Ok(frame);
                }
                self.look.draft(*samples)
            }
            Work::Band { samples, rows } => self.look.at(
                *samples,
                Some(PixelRect {
                    corner: [0, rows.start],
                    size: [self.look.settings.size[0], rows.end - rows.start],
                }),
            ),
        };
        // Shadows are for pictures of the studio: frames have none.
        let settings = Settings {
            shadows: Shadows::None,
            ..settings
        };
        engine
            .renderer
            .prepare(scene, &settings, Some(Encoding::Rgba8))
    }
}

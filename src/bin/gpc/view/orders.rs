//! Orders for pictures that cover the frames.

use super::cover::{Change, CoverOrder};
use super::picture::Picture;
use super::window::Viewer;
use super::worker::{Pixels, SceneTask, Subject, Task};
use gpc::render::Settings;
use std::time::Instant;

impl Viewer {
    /// Discards covers that do not fit the view or the scene any longer, and orders new ones.
    pub fn view_changed(&mut self, change: Change) {
        // A photograph has no frames to show meanwhile, so that its old cover stays.
        if !self.cover.is_photo && !self.cover.keeps_earlier(change) {
            self.canvas.set_cover(None);
        }
        self.begin_cover(change);
    }

    /// Shows the frames, or a photograph as it was, because a cover can't be made.
    pub fn cover_failed(&mut self) {
        self.cover.failed();
        if !self.cover.is_photo {
            self.canvas.set_cover(None);
        }
    }

    /// Orders another cover of the same view, or removes the cover if none is needed.
    pub fn cover_changed(&mut self) {
        self.canvas.refines = !self.cover.is_wanted();
        if self.canvas.refines {
            self.canvas.set_cover(None);
        }
        self.begin_cover(Change::Cover);
    }

    /// Shows a picture that the worker has made.
    pub fn show_made(&mut self, number: u64, pixels: &Pixels) -> anyhow::Result<()> {
        if self.cover.arrived(number, pixels.draft, Instant::now()) {
            let picture = Picture::from_pixels(&self.canvas.engine.device, pixels)?;
            log::trace!("shows cover {number}, {:?}", pixels.draft);
            self.canvas.set_cover(Some(picture));
            self.cover_figures.clone_from(&pixels.figures);
        }
        Ok(())
    }

    /// Orders the first picture of the cover, if one is wanted.
    fn begin_cover(&mut self, change: Change) {
        self.is_dirty = true;
        self.cover_figures = None;
        if self.cover.is_wanted() {
            let look = &self.looks[self.layer_under_pointer()];
            let order = self.cover.begin(change, look, Instant::now());
            self.order_cover(order);
        } else {
            self.worker.supersede();
        }
    }

    /// Orders the next picture of the cover, if there is one.
    pub fn refine_cover(&mut self) {
        if let Some(order) = self.cover.refine() {
            self.order_cover(order);
        }
    }

    fn order_cover(&mut self, order: CoverOrder) {
        let CoverOrder { number, settings, is_draft } = order;
        if let Some(easel) = &self.easel {
            let size = self.pixels();
            let (lenses, tints) = (&self.cover.lenses, self.cover.tints);
            let view = easel.view(size, lenses.map(), tints, self.pointer.place());
            self.worker.ask(number, Task::Photo(view));
        } else if let Some(subject) = self.cover.subject() {
            self.order(number, settings, is_draft, subject);
        }
    }

    /// Orders a picture of the visible scene from the worker.
    pub fn order(&mut self, number: u64, settings: Settings, is_draft: bool, subject: Subject) {
        let Some(stage) = self.canvas.stage() else {
            return;
        };
        let task = SceneTask {
            stage: stage.clone(),
            time: self.time(),
            standpoint: self.standpoint,
            settings,
            is_draft,
            shows_environment: self.cover.shows_environment,
            subject,
        };
        self.worker.ask(number, Task::Scene(Box::new(task)));
    }
}

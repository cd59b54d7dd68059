//! Orders for pictures that cover the frames.

use super::cover::Cover;
use super::picture::Picture;
use super::window::Viewer;
use super::worker::{Pixels, SceneTask, Subject, Task};
use std::time::Instant;

impl Viewer {
    /// Discards covers of the previous view, and orders new ones.
    pub fn view_changed(&mut self) {
        self.is_dirty = true;
        // A photograph has no frames to show meanwhile, so that its old cover stays.
        if !self.cover.is_photo {
            self.canvas.set_cover(None);
        }
        self.begin_cover(true);
    }

    /// Orders another cover of the same view, or removes the cover if none is needed.
    pub fn cover_changed(&mut self) {
        self.is_dirty = true;
        self.canvas.refines = !self.cover.is_wanted();
        if self.canvas.refines {
            self.canvas.set_cover(None);
        }
        self.begin_cover(false);
    }

    /// Shows a picture that the worker has made.
    pub fn show_made(&mut self, number: u64, pixels: &Pixels) -> anyhow::Result<()> {
        let arrival = self.cover.arrived(number, Instant::now());
        if arrival.is_shown {
            let picture = Picture::from_pixels(&self.canvas.engine.device, pixels)?;
            self.canvas.set_cover(Some(picture));
            self.cover_figures.clone_from(&pixels.figures);
        }
        if arrival.refines {
            self.order_cover(Cover::refine);
        }
        Ok(())
    }

    /// Orders the first picture of the cover, if one is wanted.
    fn begin_cover(&mut self, view_changed: bool) {
        self.cover_figures = None;
        let look = &self.looks[self.layer_under_pointer()];
        let asked = look.samples();
        self.order_cover(|cover| cover.begin(view_changed, asked));
    }

    /// Orders the next picture, for which the cover has waited.
    pub fn refine_cover(&mut self) {
        self.order_cover(Cover::refine);
    }

    fn order_cover(&mut self, step: impl FnOnce(&mut Cover) -> (u64, u32)) {
        if let Some(easel) = &self.easel {
            let size = self.pixels();
            let (lenses, tints) = (&self.cover.lenses, self.cover.tints);
            let view = easel.view(size, lenses.map(), tints, self.pointer.place());
            let (number, _) = step(&mut self.cover);
            self.worker.ask(number, Task::Photo(view));
        } else if let Some(subject) = self.cover.subject() {
            let (number, samples) = step(&mut self.cover);
            let look = &self.looks[self.layer_under_pointer()];
            let samples = if look.can_have(samples) { samples } else { look.samples() };
            self.order(number, samples, subject);
        } else {
            self.worker.supersede();
        }
    }

    /// Orders a picture of the visible scene from the worker, with the antialiasing of the picture under the pointer.
    pub fn order(&mut self, number: u64, samples: u32, subject: Subject) {
        let Some(stage) = self.canvas.stage() else {
            return;
        };
        let look = &self.looks[self.layer_under_pointer()];
        let task = SceneTask {
            source: stage.source.clone(),
            scene: stage.scene.clone(),
            time: self.time(),
            standpoint: self.standpoint,
            settings: look.at(samples, None),
            shows_environment: self.cover.shows_environment,
            subject,
        };
        self.worker.ask(number, Task::Scene(Box::new(task)));
    }
}

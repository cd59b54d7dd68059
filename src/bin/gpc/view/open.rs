//! Loading what is looked at, in the background.

use super::app::Event;
use super::photo::{Easel, Photo};
use super::player::Player;
use super::progress::Progress;
use super::source::{Opened, Source, Stage};
use super::standpoint::Standpoint;
use super::watch::Watch;
use super::window::Viewer;
use std::path::Path;
use std::time::Instant;

/// File that is being loaded.
pub struct Loading {
    number: u64,
    pub source: Source,
    pub since: Instant,
    pub progress: Progress,
    /// Whether the scene is seen from the standpoint of the scene before it.
    pub keeps_view: bool,
}

impl Drop for Loading {
    /// Nobody waits for it any more.
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

impl Viewer {
    /// Loads what was asked for, in the background.
    pub fn load(&mut self, keeps_view: bool) {
        let source = self.source.clone();
        self.loads += 1;
        let number = self.loads;
        let progress = Progress::default();
        self.loading = Some(Loading {
            number,
            source: source.clone(),
            since: Instant::now(),
            progress: progress.clone(),
            keeps_view,
        });
        self.is_dirty = true;
        self.reload = None;
        self.watch(&source.path);
        let engine = self.canvas.engine.clone();
        let proxy = self.proxy.clone();
        let appearance = self.appearance.clone();
        let max_memory = self.looks[0].settings.max_memory;
        self.loaders.retain(|loader| !loader.is_finished());
        self.loaders.push(std::thread::spawn(move || {
            let opened = source.open(engine, &appearance, max_memory, &progress);
            // Nobody waits for it once the window is closed.
            let _ = proxy.send_event(Event::Opened(number, Box::new(opened)));
        }));
    }

    /// Whether what was asked for is shown, as it is now or as it was.
    pub fn shows_source(&self) -> bool {
        let scene = self.canvas.stage().map(|stage| &stage.source.path);
        let photo = self.easel.as_ref().map(|easel| &easel.photo.path);
        scene.or(photo) == Some(&self.source.path)
    }

    /// Watches the file, whether it can be loaded or not.
    fn watch(&mut self, path: &Path) {
        let proxy = self.proxy.clone();
        let watch = Watch::new(path, move || {
            // Nobody waits for it once the window is closed.
            let _ = proxy.send_event(Event::Changed);
        });
        if let Err(error) = &watch {
            log::warn!("{} is not watched: {error}", path.display());
        }
        self.watch = watch.ok();
    }

    /// Takes what was loaded.
    pub fn opened(&mut self, number: u64, opened: anyhow::Result<Opened>) -> anyhow::Result<()> {
        // Another one was asked for meanwhile, or none.
        let Some(loading) = self.loading.take_if(|loading| loading.number == number) else {
            return Ok(());
        };
        let opened = match opened {
            Ok(opened) => opened,
            Err(error) => {
                self.notes.fail(&error);
                return Ok(());
            }
        };
        self.notes.clear_errors();
        if let Opened::Scene(stage) = &opened {
            for warning in &stage.warnings {
                log::warn!("{warning}");
            }
            if stage.prepared.triangle_count() == 0 {
                let name = loading.source.name();
                self.notes.say(format!("{name}: there is nothing to draw"));
            }
        }
        self.window
            .set_title(&format!("{} - gpc", loading.source.name()));
        log::debug!("shows {}", loading.source.path.display());
        match opened {
            Opened::Scene(stage) => self.set_stage(*stage, loading.keeps_view),
            Opened::Photo(photo) => {
                self.set_photo(photo, loading.keeps_view);
                Ok(())
            }
        }
    }

    fn set_stage(&mut self, stage: Stage, keeps_view: bool) -> anyhow::Result<()> {
        self.set_easel(None);
        if !keeps_view {
            let aspect = self.aspect();
            let start = self.start.take().unwrap_or_default();
            let asked = start.standpoint(&stage.cameras, stage.bounds, aspect);
            self.standpoint = asked.unwrap_or_else(|error| {
                self.notes.fail(&error.into());
                Standpoint::first(&stage.cameras, stage.bounds, aspect)
            });
            self.flight = None;
        }
        self.player = stage.motion.as_ref().map(|_| {
            let animation = stage.animations.get(stage.animation());
            let duration = animation.map_or(0.0, |animation| animation.duration);
            Player::new(stage.source.request.time, duration)
        });
        self.moment = None;
        self.canvas.set_stage(Some(stage));
        self.renew_layers()
    }

    fn set_photo(&mut self, photo: Photo, keeps_view: bool) {
        let mut easel = Easel::new(photo, self.pixels());
        if let Some(before) = self.easel.as_ref().filter(|_| keeps_view) {
            easel.framing = before.framing;
            easel.unzooms = before.unzooms;
        }
        if easel.photo.zoomed().is_some() {
            self.notes
                .say("the image holds a zoom: U unzooms it under the pointer");
        }
        (self.player, self.moment, self.flight) = (None, None, None);
        self.set_easel(Some(easel));
        self.canvas.set_stage(None);
        self.view_changed();
    }

    /// Switches between scenes and photographs, whose lenses are not at the same places.
    fn set_easel(&mut self, easel: Option<Easel>) {
        if easel.is_some() != self.easel.is_some() {
            self.cover = self.cover.cleared(easel.is_some());
        }
        self.easel = easel;
        self.canvas.refines = !self.cover.is_wanted();
    }
}

//! Loading of files in the background.

use super::app::Event;
use super::cover::Change;
use super::losses::is_lost;
use super::photo::{Easel, Photo};
use super::player::Player;
use super::progress::Progress;
use super::source::{LoadedScene, Opened, SceneSource};
use super::standpoint::Standpoint;
use super::watch::watch;
use super::window::Viewer;
use crate::cli::render::args::CameraArgs;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// A file that is being loaded.
pub struct Loading {
    number: u64,
    pub source: SceneSource,
    pub since: Instant,
    pub progress: Progress,
    /// Whether the new scene is seen from the standpoint of the scene before it.
    pub keeps_view: bool,
}

impl Drop for Loading {
    /// Cancels the loading, whose result is no longer wanted.
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

impl Viewer {
    /// Starts to load the requested source in the background.
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
        let appearance = self.options.appearance.clone();
        let settings = self.looks[0].settings.scene.clone();
        self.loaders.retain(|loader| !loader.is_finished());
        self.loaders.push(std::thread::spawn(move || {
            let opened = source.open(engine, &appearance, &settings, &progress);
            // An error means that the window is closed and that the result is no longer needed.
            let _ = proxy.send_event(Event::Opened(number, Box::new(opened)));
        }));
    }

    /// Whether the requested source is shown; a version from before the file changed counts too.
    pub fn shows_source(&self) -> bool {
        let scene = self.canvas.stage().map(|stage| &stage.source.path);
        let photo = self.easel.as_ref().map(|easel| &easel.photo.path);
        scene.or(photo) == Some(&self.source.path)
    }

    /// Watches a file for changes, even one that can't be loaded.
    fn watch(&mut self, path: &Path) {
        let proxy = self.proxy.clone();
        let watcher = watch(path, move || {
            // An error means that the window is closed and that the message is no longer needed.
            let _ = proxy.send_event(Event::Changed);
        });
        if let Err(error) = &watcher {
            log::warn!("{} is not watched: {error}", path.display());
        }
        self.watcher = watcher.ok();
    }

    /// Takes the result of loading; `number` is that of the request.
    pub fn opened(&mut self, number: u64, opened: anyhow::Result<Opened>) -> anyhow::Result<()> {
        // Another file was requested meanwhile, or the request was cancelled.
        let Some(loading) = self.loading.take_if(|loading| loading.number == number) else {
            return Ok(());
        };
        let opened = match opened {
            Ok(opened) => opened,
            // The device was lost since the request, and another one has to be opened.
            Err(error) if is_lost(&error) => return Err(error),
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
        self.window.set_title(&format!("{} - gpc", loading.source.name()));
        log::debug!("shows {}", loading.source.path.display());
        match opened {
            Opened::Scene(stage) => self.set_stage(stage, loading.keeps_view),
            Opened::Photo(photo) => {
                self.set_photo(photo, loading.keeps_view);
                Ok(())
            }
        }
    }

    fn set_stage(&mut self, stage: Arc<LoadedScene>, keeps_view: bool) -> anyhow::Result<()> {
        self.set_easel(None);
        if !keeps_view {
            let aspect = self.aspect();
            let start = if self.has_started { CameraArgs::default() } else { self.options.start.clone() };
            self.has_started = true;
            let asked = Standpoint::asked(&start, &stage.pose.cameras, stage.bounds, aspect);
            self.standpoint = asked.unwrap_or_else(|error| {
                self.notes.fail(&error.into());
                Standpoint::first(&stage.pose.cameras, stage.bounds, aspect)
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
        if easel.photo.zoom.is_some() {
            self.notes.say("the image holds a zoom: U unzooms it under the pointer");
        }
        (self.player, self.moment, self.flight) = (None, None, None);
        self.set_easel(Some(easel));
        self.canvas.set_stage(None);
        self.view_changed(Change::Scene);
    }

    /// Shows a photograph, or returns to the scene. Lenses are removed, because their places in one mean nothing in the
    /// other.
    fn set_easel(&mut self, easel: Option<Easel>) {
        if easel.is_some() != self.easel.is_some() {
            self.cover = self.cover.cleared(easel.is_some());
        }
        self.easel = easel;
        self.canvas.refines = !self.cover.is_wanted();
    }
}

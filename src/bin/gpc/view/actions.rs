//! Actions of keys, buttons and the mouse.

use super::command::{Shot, line, unzoom_photo, zoom_photo};
use super::files::{free_name, scenes_at};
use super::fly::Way;
use super::keys::{self, Action};
use super::lens::Lenses;
use super::look::Look;
use super::mouse::{NOTCH, pinched};
use super::overlay::Overlay;
use super::photo::Framing;
use super::player::Player;
use super::pointer::Drag;
use super::source::{LoadedScene, SceneSource};
use super::standpoint::Standpoint;
use super::window::Viewer;
use super::worker::{Subject, Task};
use crate::cli::input::stem;
use glam::DVec2;
use gpc::render::MethodKind;
use gpc::sampling::MAX_SAMPLES;
use std::path::{Path, PathBuf};
use std::time::Instant;
use winit::event::{ElementState, KeyEvent, MouseScrollDelta, WindowEvent};
use winit::window::Fullscreen;

impl Viewer {
    /// Handles an event of the window.
    pub fn on_event(&mut self, event: &WindowEvent) -> anyhow::Result<()> {
        let response = self.interface.on_window_event(&self.window, event);
        self.is_dirty |= response.repaint;
        // The panel's context knows that the panel is hidden only once the window is drawn again.
        let is_taken = response.consumed && (self.shows_panel || self.shows_keys);
        match event {
            WindowEvent::CloseRequested => self.wants_to_quit = true,
            WindowEvent::Resized(size) => {
                self.canvas.resize((*size).into())?;
                self.renew_layers()?;
            }
            WindowEvent::RedrawRequested | WindowEvent::Occluded(false) => self.is_dirty = true,
            WindowEvent::ModifiersChanged(modifiers) => self.modifiers = modifiers.state(),
            WindowEvent::DroppedFile(path) => self.open(path),
            // Synthetic events report keys that went down before the window had the focus; they were meant for another
            // window.
            WindowEvent::KeyboardInput { event, is_synthetic: false, .. } => self.on_key(event, is_taken)?,
            WindowEvent::Focused(false) => {
                // Without the focus the window isn't told when a key is released.
                if let Some(flight) = &mut self.flight {
                    flight.stop();
                }
            }
            WindowEvent::CursorMoved { position, .. } => {
                let to = DVec2::new(position.x, position.y);
                if let Some((drag, by)) = self.pointer.moved(to) {
                    self.drag(drag, by);
                }
                self.is_dirty |= self.magnifier.is_some();
                if self.easel.as_ref().is_some_and(|easel| easel.unzooms) {
                    self.cover_changed();
                }
            }
            WindowEvent::MouseInput { state, button, .. } => match state {
                ElementState::Pressed if !is_taken => self.press(*button),
                _ => self.pointer.released(),
            },
            WindowEvent::MouseWheel { delta, .. } if !is_taken => {
                let pixels = match delta {
                    MouseScrollDelta::LineDelta(x, y) => {
                        self.pixels_of_notches(DVec2::new(f64::from(*x), f64::from(*y)))
                    }
                    MouseScrollDelta::PixelDelta(pixels) => DVec2::new(pixels.x, pixels.y),
                };
                if self.modifiers.shift_key() {
                    self.drag(Drag::Pan, pixels);
                } else {
                    self.wheel(NOTCH.powf(self.notches(pixels.y)));
                }
            }
            WindowEvent::PinchGesture { delta, .. } => self.wheel(pinched(*delta)),
            _ => {}
        }
        Ok(())
    }

    fn on_key(&mut self, event: &KeyEvent, is_taken: bool) -> anyhow::Result<()> {
        let way = Way::of(event.physical_key).filter(|_| !self.modifiers.control_key());
        if let (Some(flight), Some(way)) = (&mut self.flight, way) {
            match event.state {
                ElementState::Pressed if is_taken => {}
                ElementState::Pressed => flight.hold(way, Instant::now()),
                ElementState::Released => flight.release(way),
            }
            self.is_dirty = true;
            return Ok(());
        }
        let action = keys::action(&event.logical_key, self.modifiers);
        match action.filter(|_| event.state == ElementState::Pressed && !is_taken) {
            Some(action) => self.act(action),
            None => Ok(()),
        }
    }

    /// Opens a file, or the scene files of a folder, in addition to those that are open.
    fn open(&mut self, path: &Path) {
        match scenes_at(path) {
            Ok(scenes) => {
                let first = self.scenes.len();
                self.scenes.extend(scenes);
                self.show_scene(first);
            }
            Err(error) => self.notes.fail(&error),
        }
        self.is_dirty = true;
    }

    /// Shows the open file with this index.
    fn show_scene(&mut self, index: usize) {
        self.scene = index;
        self.source = SceneSource::new(self.scenes[index].clone());
        self.load(false);
    }

    /// Does what a key or the panel asks for.
    pub fn act(&mut self, action: Action) -> anyhow::Result<()> {
        self.is_dirty = true;
        self.notes.clear_errors();
        match action {
            Action::Help => self.shows_keys = !self.shows_keys,
            Action::Panel => self.shows_panel = !self.shows_panel,
            Action::FullScreen => {
                let is_full = self.window.fullscreen().is_some();
                let full = Fullscreen::Borderless(None);
                self.window.set_fullscreen((!is_full).then_some(full));
            }
            Action::Back => {
                if let Some(loading) = self.loading.take() {
                    self.notes.say(format!("stopped loading {}", loading.source.name()));
                }
                for path in self.worker.stop_files() {
                    self.notes.say(format!("stopped writing {}", path.display()));
                }
                self.shows_keys = false;
                self.flight = None;
            }
            Action::Quit => self.wants_to_quit = true,
            Action::ShowAll => {
                let size = self.pixels();
                let photo = self.easel.as_ref();
                if let Some(photo) = photo.map(|easel| easel.photo.photograph.size()) {
                    self.reframe(|framing| *framing = Framing::fitting(photo, size));
                }
                if let Some(bounds) = self.canvas.stage().map(|stage| stage.bounds) {
                    let aspect = self.aspect();
                    self.go(|turntable| turntable.fit(bounds, aspect));
                }
            }
            Action::LookFrom(side) => self.go(|turntable| turntable.look_from(side)),
            Action::NextCamera => self.next_camera(),
            Action::Fly => self.toggle_flight(),
            Action::PreviousScene => self.turn_to(self.scenes.len().saturating_sub(1)),
            Action::NextScene => self.turn_to(1),
            Action::Reload => self.reload = Some(Instant::now()),
            Action::SetMethod(method) => {
                let layer = self.layer_under_pointer();
                self.looks[layer].set_method(method);
                self.renew_layers()?;
            }
            Action::SetLook(layer, look) => {
                self.looks[layer] = *look;
                self.renew_layers()?;
            }
            Action::MoreSamples => self.change_samples(|samples| samples * 2)?,
            Action::FewerSamples => self.change_samples(|samples| samples / 2)?,
            Action::Split => self.toggle_split()?,
            Action::Magnify => {
                self.magnifier = match self.magnifier {
                    None => Some(8),
                    Some(32) => None,
                    Some(factor) => Some(2 * factor),
                };
            }
            Action::Lens => {
                if self.cover.lenses.regions().is_empty() {
                    self.add_lens();
                } else {
                    self.cover.lenses = Lenses::default();
                    self.cover_changed();
                }
            }
            Action::AddLens => self.add_lens(),
            Action::RemoveLens => {
                self.cover.lenses.remove();
                self.cover_changed();
            }
            Action::SetLens(shape, transition) => {
                self.change_lens(|lenses| lenses.set(shape, transition));
            }
            Action::Tint => {
                self.cover.tints = !self.cover.tints;
                self.cover_changed();
            }
            Action::Unzoom => self.toggle_unzoom(),
            Action::NextOverlay => self.set_overlay(Overlay::next(self.cover.overlay)),
            Action::ShowOverlay(overlay) => self.set_overlay(overlay),
            Action::Screenshot => self.write_screenshot(),
            Action::CopyCommand => self.copy_command(),
            Action::PlayOrPause => self.play(|player| player.toggle(Instant::now())),
            Action::Slower => self.play(|player| player.change_speed(-1)),
            Action::Faster => self.play(|player| player.change_speed(1)),
            Action::Seek(time) => {
                self.play(|player| player.seek(time));
                self.show_time();
            }
            Action::PlayAnimation(index) => {
                self.source.request.animation = Some(index.to_string());
                self.source.request.time = 0.0;
                self.load(true);
            }
        }
        Ok(())
    }

    fn add_lens(&mut self) {
        let place = self.plane_place(self.pointer.place());
        let height = self.size()[1] * self.easel.as_ref().map_or(1.0, |easel| easel.framing.step());
        self.cover.lenses.add(place, height);
        self.cover_changed();
    }

    /// Turns unzooming of the region under the pointer on or off.
    fn toggle_unzoom(&mut self) {
        match &mut self.easel {
            Some(easel) if easel.photo.zoom.is_some() => {
                easel.unzooms = !easel.unzooms;
                self.cover_changed();
            }
            _ => self.notes.say("only an image of gpc zoom can be unzoomed"),
        }
    }

    fn set_overlay(&mut self, overlay: Option<Overlay>) {
        self.cover.overlay = overlay;
        let name = overlay.map_or_else(|| "colours".to_owned(), Overlay::name);
        self.notes.say(format!("shows {name}"));
        self.cover_changed();
    }

    fn next_camera(&mut self) {
        let count = self.canvas.stage().map_or(0, |stage| stage.pose.cameras.len());
        if count == 0 {
            self.notes.say("the scene has no cameras");
            return;
        }
        let next = match self.standpoint {
            Standpoint::Camera(index) => (index + 1) % count,
            Standpoint::Free(_) => 0,
        };
        self.standpoint = Standpoint::Camera(next);
        self.restart();
    }

    /// Shows the file that is `by` places further on in the list; the first file follows the last.
    fn turn_to(&mut self, by: usize) {
        if self.scenes.len() > 1 {
            self.show_scene((self.scene + by) % self.scenes.len());
        }
    }

    /// Index of the picture that the pointer is over.
    pub fn layer_under_pointer(&self) -> usize {
        let column = self.split_column().map(f64::from);
        usize::from(column.is_some_and(|column| self.pointer.place().x >= column))
    }

    /// Changes the number of samples of the picture under the pointer to the next one that its method and pattern
    /// allow.
    fn change_samples(&mut self, change: impl Fn(u32) -> u32) -> anyhow::Result<()> {
        let layer = self.layer_under_pointer();
        let look = &mut self.looks[layer];
        let mut samples = look.samples();
        // Numbers that aren't allowed are skipped.
        while (1..=MAX_SAMPLES).contains(&change(samples)) {
            samples = change(samples);
            let mut changed = look.clone();
            changed.set_samples(samples);
            if changed.can_have(samples) {
                *look = changed;
                self.notes.say(format!("{samples} samples a pixel"));
                return self.renew_layers();
            }
        }
        Ok(())
    }

    /// Changes how the animation plays.
    fn play(&mut self, change: impl FnOnce(&mut Player)) {
        match &mut self.player {
            Some(player) => change(player),
            None => self.notes.say("the scene has no animations"),
        }
    }

    /// Turns the comparison of two methods side by side on or off.
    fn toggle_split(&mut self) -> anyhow::Result<()> {
        if self.looks.len() > 1 {
            self.looks.truncate(1);
        } else {
            let mut other: Look = self.looks[0].clone();
            other.set_method(match other.method() {
                MethodKind::None => MethodKind::Superpixel,
                _ => MethodKind::None,
            });
            self.looks.push(other);
        }
        self.renew_layers()
    }

    /// Writes the picture under the pointer to a PNG with all its samples, equal to the one that the copied command
    /// writes.
    fn write_screenshot(&mut self) {
        let path = free_name(Path::new(""), &stem(&self.source.path));
        if let Some(easel) = &self.easel {
            let Some(map) = self.cover.lenses.map() else {
                self.notes.say("no lens changes the photograph: there is nothing to write");
                return;
            };
            let task = Task::PhotoFile(easel.whole(map), path.clone());
            self.worker.ask(0, task);
            self.notes.say(format!("writing {}", path.display()));
            return;
        }
        if self.canvas.stage().is_none() {
            return;
        }
        let settings = self.looks[self.layer_under_pointer()].settings.clone();
        self.notes.say(format!("writing {}", path.display()));
        self.order(0, settings, false, Subject::File(path, self.cover.lenses.map()));
    }

    /// Copies the command that makes the picture under the pointer to the clipboard.
    fn copy_command(&mut self) {
        let output = PathBuf::from(stem(&self.source.path)).with_extension("png");
        let lenses = self.cover.lenses.regions();
        let arguments = match (&self.easel, self.canvas.stage()) {
            (Some(easel), _) if easel.unzooms => {
                let region = easel.region_at(self.pointer.place());
                unzoom_photo(&easel.photo.path, region, &output)
            }
            (Some(_), _) if lenses.is_empty() => {
                self.notes.say("no lens changes the photograph: there is nothing to copy");
                return;
            }
            (Some(easel), _) => zoom_photo(&easel.photo.path, lenses, &output),
            (None, Some(stage)) => self.shot(stage).arguments(&output),
            (None, None) => return,
        };
        let command = line(&arguments);
        self.interface.set_clipboard_text(command.clone());
        self.notes.say(format!("copied: {command}"));
    }

    /// Scene, standpoint and settings of the picture under the pointer.
    fn shot<'a>(&'a self, stage: &'a LoadedScene) -> Shot<'a> {
        Shot {
            source: &stage.source,
            standpoint: &self.standpoint,
            look: &self.looks[self.layer_under_pointer()],
            appearance: &self.options.appearance_options,
            shows_environment: self.cover.shows_environment,
            time: self.time(),
            lenses: self.cover.lenses.regions(),
        }
    }
}

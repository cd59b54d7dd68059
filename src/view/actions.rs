//! What keys and mouse do.

use super::command::{Shot, line};
use super::files::{free_name, scenes_at};
use super::keys::{self, Action};
use super::lens;
use super::look::Look;
use super::navigate::Turntable;
use super::panel::Wishes;
use super::pick;
use super::pointer::Drag;
use super::source::Source;
use super::standpoint::Standpoint;
use super::studio::Subject;
use super::window::View;
use glam::DVec2;
use gpc::camera::zoom::ZoomRegion;
use gpc::camera::{Camera, Pinhole};
use gpc::output::AovKind;
use gpc::render::Method;
use gpc::sampling::MAX_SAMPLES;
use std::path::{Path, PathBuf};
use std::time::Instant;
use winit::event::{ElementState, MouseButton, MouseScrollDelta, WindowEvent};

/// How much nearer a notch of the wheel brings.
const NOTCH: f64 = 1.15;
/// Pixels of a touchpad or of a drag that count as a notch.
const PIXELS_A_NOTCH: f64 = 40.0;
/// Pixels from the line of a split at which it is taken hold of.
const GRIP: f64 = 6.0;

impl View {
    /// Takes an event of the window.
    pub fn on_event(&mut self, event: &WindowEvent) -> anyhow::Result<()> {
        let response = self.interface.on_window_event(&self.window, event);
        self.is_dirty |= response.repaint;
        match event {
            WindowEvent::CloseRequested => self.wants_to_quit = true,
            WindowEvent::Resized(size) => {
                self.canvas.resize((*size).into())?;
                self.renew_layers()?;
            }
            WindowEvent::RedrawRequested | WindowEvent::Occluded(false) => self.is_dirty = true,
            WindowEvent::ModifiersChanged(modifiers) => self.modifiers = modifiers.state(),
            WindowEvent::DroppedFile(path) => self.open(path),
            WindowEvent::KeyboardInput { event, .. } if event.state == ElementState::Pressed => {
                if !response.consumed
                    && let Some(action) = keys::action(&event.logical_key, self.modifiers)
                {
                    self.act(action)?;
                }
            }
            WindowEvent::CursorMoved { position, .. } => {
                let to = DVec2::new(position.x, position.y);
                if let Some((drag, by)) = self.pointer.moved(to) {
                    self.drag(drag, by);
                }
                self.is_dirty |= self.magnifier.is_some();
            }
            WindowEvent::MouseInput { state, button, .. } => match state {
                ElementState::Pressed if !response.consumed => self.press(*button),
                _ => self.pointer.released(),
            },
            WindowEvent::MouseWheel { delta, .. } if !response.consumed => {
                let notches = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => f64::from(*lines),
                    MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_A_NOTCH,
                };
                let factor = NOTCH.powf(notches);
                if !self.change_lens(|lens| lens::enlarge(lens, factor)) {
                    self.zoom(factor, self.pointer.place());
                }
            }
            WindowEvent::PinchGesture { delta, .. } => {
                self.zoom(1.0 + delta, self.pointer.place());
            }
            _ => {}
        }
        Ok(())
    }

    /// Opens a file, or those of a folder, beside those that there are.
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

    /// Opens a file of those that there are.
    fn show_scene(&mut self, index: usize) {
        self.scene = index;
        self.source = Source::new(self.scenes[index].clone());
        self.load(false);
    }

    fn act(&mut self, action: Action) -> anyhow::Result<()> {
        self.is_dirty = true;
        self.notes.clear_errors();
        match action {
            Action::Help => self.shows_keys = !self.shows_keys,
            Action::Panel => self.shows_panel = !self.shows_panel,
            Action::Back => {
                if let Some(loading) = self.loading.take() {
                    self.notes
                        .say(format!("stopped loading {}", loading.source.name()));
                }
                self.shows_keys = false;
            }
            Action::Quit => self.wants_to_quit = true,
            Action::Fit => {
                if let Some(bounds) = self.canvas.stage().map(|stage| stage.bounds) {
                    let aspect = self.aspect();
                    self.go(|turntable| turntable.fit(bounds, aspect));
                }
            }
            Action::LookFrom(side) => self.go(|turntable| turntable.look_from(side)),
            Action::NextCamera => self.next_camera(),
            Action::PreviousScene => self.turn_to(self.scenes.len().saturating_sub(1)),
            Action::NextScene => self.turn_to(1),
            Action::Reload => self.reload = Some(Instant::now()),
            Action::SetMethod(method) => {
                let layer = self.layer_under_pointer();
                self.looks[layer].set_method(method);
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
                let (place, height) = (self.pointer.place(), self.size()[1]);
                self.cover.lens = match self.cover.lens {
                    None => Some(lens::at(place, height)),
                    Some(_) => None,
                };
                self.cover_changed()?;
            }
            Action::NextAttribute => {
                self.cover.next_attribute();
                let name = self.cover.attribute.map_or("colours", AovKind::name);
                self.notes.say(format!("shows {name}"));
                self.cover_changed()?;
            }
            Action::Screenshot => self.write_screenshot(),
            Action::CopyCommand => self.copy_command(),
            Action::PlayOrPause => self.play_or_pause(),
            Action::Slower => self.change_speed(-1),
            Action::Faster => self.change_speed(1),
        }
        Ok(())
    }

    /// Moves to another place.
    fn go(&mut self, change: impl FnOnce(&mut Turntable)) {
        let aspect = self.aspect();
        if let Some(stage) = self.canvas.stage() {
            let cameras = match &self.moment {
                Some(moment) => &moment.cameras,
                None => &stage.cameras,
            };
            self.standpoint.go(cameras, stage.bounds, aspect, change);
            self.restart();
        }
    }

    /// Everything has to be rendered again.
    fn restart(&mut self) {
        self.canvas.restart(Instant::now());
        if let Err(error) = self.view_changed() {
            self.notes.fail(&error);
        }
    }

    /// Changes the lens, where there is one. Says whether there is.
    fn change_lens(&mut self, change: impl FnOnce(&mut ZoomRegion)) -> bool {
        let Some(lens) = &mut self.cover.lens else {
            return false;
        };
        change(lens);
        if let Err(error) = self.cover_changed() {
            self.notes.fail(&error);
        }
        true
    }

    fn press(&mut self, button: MouseButton) {
        let near_split = self
            .split_column()
            .is_some_and(|column| (self.pointer.place().x - f64::from(column)).abs() < GRIP);
        let drag = match button {
            MouseButton::Left if near_split => Drag::Split,
            MouseButton::Left if self.modifiers.shift_key() => Drag::Pan,
            MouseButton::Left if self.cover.lens.is_some() => Drag::Lens,
            MouseButton::Left => Drag::Orbit,
            MouseButton::Middle => Drag::Pan,
            MouseButton::Right => Drag::Zoom,
            _ => return,
        };
        if drag == Drag::Lens {
            let place = self.pointer.place();
            self.change_lens(|lens| lens::press(lens, place));
        }
        let is_double = self.pointer.pressed(drag, Instant::now());
        if is_double && drag == Drag::Orbit {
            self.recentre();
        }
    }

    fn drag(&mut self, drag: Drag, by: DVec2) {
        let [width, height] = self.size();
        match drag {
            Drag::Orbit => self.go(|turntable| turntable.orbit(by, height)),
            Drag::Pan => self.go(|turntable| turntable.pan(by, height)),
            Drag::Zoom => {
                let factor = NOTCH.powf(-by.y / PIXELS_A_NOTCH);
                self.go(|turntable| turntable.zoom(factor, DVec2::ZERO, height));
            }
            Drag::Lens => {
                let place = self.pointer.place();
                self.change_lens(|lens| lens::drag(lens, place));
            }
            Drag::Split => {
                self.split = (self.pointer.place().x / width).clamp(0.0, 1.0);
                self.is_dirty = true;
            }
        }
    }

    /// Comes nearer to what is at a place in the window.
    fn zoom(&mut self, factor: f64, place: DVec2) {
        let [width, height] = self.size();
        let pointer = place - 0.5 * DVec2::new(width, height);
        self.go(|turntable| turntable.zoom(factor, pointer, height));
    }

    /// Brings what is under the pointer into the middle.
    fn recentre(&mut self) {
        let Some(stage) = self.canvas.stage() else {
            return;
        };
        let size = self.canvas.size().unwrap_or([1, 1]);
        let camera = self
            .standpoint
            .camera(self.cameras(), stage.bounds, self.aspect());
        let pinhole = camera
            .ok()
            .and_then(|camera: Camera| Pinhole::from_camera(&camera, size).ok());
        let hit = pinhole
            .map(|pinhole| pinhole.ray(self.pointer.place()))
            .and_then(|ray| pick::first_hit(&stage.geometry, &ray));
        if let Some(point) = hit {
            self.go(|turntable| turntable.recentre(point));
        }
    }

    fn next_camera(&mut self) {
        let count = self.canvas.stage().map_or(0, |stage| stage.cameras.len());
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

    /// Goes on by so many scenes, round and round.
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

    /// Changes the samples of the picture under the pointer, where its method and pattern can have so many.
    fn change_samples(&mut self, change: impl Fn(u32) -> u32) -> anyhow::Result<()> {
        let layer = self.layer_under_pointer();
        let look = &mut self.looks[layer];
        let mut samples = look.settings.samples;
        // Numbers in between are passed over.
        while (1..=MAX_SAMPLES).contains(&change(samples)) {
            samples = change(samples);
            let changed = Look::new(look.at(samples, None), look.contrast);
            if changed.can_have(samples) {
                *look = changed;
                self.notes.say(format!("{samples} samples a pixel"));
                return self.renew_layers();
            }
        }
        Ok(())
    }

    /// Does what the user asked of the panel.
    pub fn fulfil(&mut self, wishes: Wishes) -> anyhow::Result<()> {
        if let Some((layer, look)) = wishes.look {
            self.notes.clear_errors();
            self.looks[layer] = look;
            self.renew_layers()?;
        }
        if let Some(time) = wishes.time
            && let Some(player) = &mut self.player
        {
            player.seek(time);
            self.show_time();
        }
        if let Some(lens) = wishes.lens {
            self.change_lens(|old| *old = lens);
        }
        if let Some(attribute) = wishes.attribute {
            self.cover.attribute = attribute;
            self.cover_changed()?;
        }
        if wishes.toggles_play {
            self.play_or_pause();
        }
        if wishes.speed_steps != 0 {
            self.change_speed(wishes.speed_steps);
        }
        if let Some(index) = wishes.animation {
            self.source.request.animation = Some(index.to_string());
            self.source.request.time = 0.0;
            self.load(true);
        }
        Ok(())
    }

    fn play_or_pause(&mut self) {
        match &mut self.player {
            Some(player) => player.toggle(Instant::now()),
            None => self.notes.say("the scene has no animations"),
        }
        self.is_dirty = true;
    }

    fn change_speed(&mut self, steps: i32) {
        if let Some(player) = &mut self.player {
            player.change_speed(steps);
            self.is_dirty = true;
        }
    }

    /// Begins or ends to show two methods side by side.
    fn toggle_split(&mut self) -> anyhow::Result<()> {
        if self.looks.len() > 1 {
            self.looks.truncate(1);
        } else {
            let mut other: Look = self.looks[0].clone();
            other.set_method(match other.settings.method {
                Method::None => Method::Superpixel,
                _ => Method::None,
            });
            self.looks.push(other);
        }
        self.renew_layers()
    }

    /// Writes the picture under the pointer with all its samples, as `gpc render` does.
    fn write_screenshot(&mut self) {
        let Some(stage) = self.canvas.stage() else {
            return;
        };
        let path = free_name(Path::new(""), &stage.source.stem());
        let samples = self.looks[self.layer_under_pointer()].settings.samples;
        self.notes.say(format!("writing {}", path.display()));
        self.order(0, samples, Subject::File(path));
    }

    /// Puts the command that makes the picture under the pointer on the clipboard.
    fn copy_command(&mut self) {
        let Some(stage) = self.canvas.stage() else {
            return;
        };
        let shot = Shot {
            source: &stage.source,
            standpoint: &self.standpoint,
            look: &self.looks[self.layer_under_pointer()],
            background: &self.background,
            time: self.time(),
            lens: self.cover.lens.as_ref(),
        };
        let output = PathBuf::from(stage.source.stem()).with_extension("png");
        let command = line(&shot.arguments(&output));
        self.interface.set_clipboard_text(command.clone());
        self.notes.say(format!("copied: {command}"));
    }
}

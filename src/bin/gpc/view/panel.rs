//! Panel, notes and list of keys, drawn over the picture.

use super::keys::{self, Action};
use super::layer::Layer;
use super::look::Look;
use super::overlay::Overlay;
use super::player::Player;
use super::source::LoadedScene;
use super::window::Viewer;
use gpc::camera::zoom::{Shape, Transition};
use gpc::compare::heat_color;
use gpc::render::{Detection, MethodKind};
use gpc::sampling::Pattern;
use std::time::{Duration, Instant};

const ERROR: egui::Color32 = egui::Color32::from_rgb(255, 140, 130);
/// Largest contrast threshold that the panel offers, in 8-bit sRGB code values.
const MOST_CONTRAST: u8 = 64;

impl Viewer {
    /// Lays out panel, notes and lists, and returns what the user asked for.
    pub fn show_interface(&self, ctx: &egui::Context, now: Instant) -> Vec<Action> {
        let mut asked = Vec::new();
        if let Some(column) = self.split_column() {
            show_split(ctx, column);
        }
        if self.shows_panel && (self.canvas.stage().is_some() || self.easel.is_some()) {
            self.show_panel(ctx, &mut asked);
        }
        self.show_notes(ctx, now);
        if self.shows_keys {
            show_keys(ctx);
        }
        asked
    }

    fn show_panel(&self, ctx: &egui::Context, asked: &mut Vec<Action>) {
        egui::Window::new("panel").title_bar(false).resizable(false).default_pos([8.0, 8.0]).show(ctx, |ui| {
            if let Some(easel) = &self.easel {
                let [width, height] = easel.photo.photograph.size();
                ui.strong(self.source.name());
                ui.label(format!("{width} x {height} pixels"));
                if easel.photo.zoom.is_some() {
                    ui.label("zoomed: U unzooms it under the pointer");
                }
            }
            if let Some(stage) = self.canvas.stage() {
                self.show_stage(ui, stage, asked);
                ui.separator();
                self.show_overlay(ui, asked);
            }
            self.show_lenses(ui, asked);
            if !self.cover.is_done() {
                ui.weak("being made in the background");
            }
            ui.weak("H lists the keys, P hides this");
        });
    }

    fn show_stage(&self, ui: &mut egui::Ui, stage: &LoadedScene, asked: &mut Vec<Action>) {
        ui.strong(stage.source.name());
        ui.label(format!("{} triangles", stage.prepared.triangle_count()));
        if !stage.warnings.is_empty() {
            let title = format!("warnings: {}", stage.warnings.len());
            ui.collapsing(title, |ui| {
                egui::ScrollArea::vertical().max_height(200.0).show(ui, |ui| {
                    for warning in &stage.warnings {
                        ui.label(warning);
                    }
                });
            });
        }
        if let Some(player) = &self.player {
            ui.separator();
            show_player(ui, stage, player, asked);
        }
        for (index, layer) in self.canvas.layers().iter().enumerate() {
            ui.separator();
            ui.push_id(index, |ui| {
                let mut look = layer.look.clone();
                edit(ui, &mut look);
                if look != layer.look {
                    asked.push(Action::SetLook(index, Box::new(look)));
                }
                show_figures(ui, layer);
            });
        }
    }

    /// Controls of the overlay.
    fn show_overlay(&self, ui: &mut egui::Ui, asked: &mut Vec<Action>) {
        let name = |overlay: Option<Overlay>| overlay.map_or_else(|| "colours".to_owned(), Overlay::name);
        let shown = self.cover.overlay;
        egui::ComboBox::from_label("shown").selected_text(name(shown)).show_ui(ui, |ui| {
            let all = std::iter::once(None).chain(Overlay::ALL.map(Some));
            for overlay in all {
                if ui.selectable_label(overlay == shown, name(overlay)).clicked() {
                    asked.push(Action::ShowOverlay(overlay));
                }
            }
        });
        if let Some(overlay) = shown.filter(|overlay| !overlay.scale().is_empty()) {
            show_scale(ui, overlay.scale());
        }
        if let Some(figures) = &self.cover_figures {
            ui.label(figures);
        }
    }

    /// Controls of the lenses.
    fn show_lenses(&self, ui: &mut egui::Ui, asked: &mut Vec<Action>) {
        let lenses = &self.cover.lenses;
        let Some(lens) = lenses.regions().get(lenses.active()) else {
            return;
        };
        ui.separator();
        ui.label(format!(
            "lens {} of {}: {:.2} times as large",
            lenses.active() + 1,
            lenses.regions().len(),
            1.0 / lens.multiplicity
        ));
        let (mut shape, mut transition) = (lens.shape, lens.transition);
        ui.horizontal(|ui| {
            ui.selectable_value(&mut shape, Shape::Circle, "circle");
            ui.selectable_value(&mut shape, Shape::Rectangle, "rectangle");
        });
        ui.horizontal(|ui| {
            ui.selectable_value(&mut transition, Transition::Linear, "linear");
            ui.selectable_value(&mut transition, Transition::Smooth, "smooth");
        });
        if (shape, transition) != (lens.shape, lens.transition) {
            asked.push(Action::SetLens(shape, transition));
        }
        ui.horizontal(|ui| {
            if ui.button("Remove").clicked() {
                asked.push(Action::RemoveLens);
            }
            let mut tints = self.cover.tints;
            if ui.checkbox(&mut tints, "transition in colour").changed() {
                asked.push(Action::Tint);
            }
        });
    }

    fn show_notes(&self, ctx: &egui::Context, now: Instant) {
        let notes = self.notes.all();
        if notes.is_empty() && self.loading.is_none() {
            return;
        }
        // What is behind the notes can be dragged through them.
        let area = overlay("notes", egui::Align2::LEFT_BOTTOM).interactable(false);
        area.show(ctx, |ui| {
            ui.set_max_width(0.7 * ctx.content_rect().width());
            if let Some(loading) = &self.loading {
                let (step, share) = loading.progress.step();
                let since = now.saturating_duration_since(loading.since);
                ui.label(format!("Loading {}: {}", loading.source.name(), step.name()));
                let waited = format!("{} s; Esc stops it", since.as_secs());
                ui.add(egui::ProgressBar::new(share).text(waited).desired_width(240.0));
                ctx.request_repaint_after(Duration::from_millis(250));
            }
            for note in notes {
                if note.is_error {
                    ui.colored_label(ERROR, &note.text);
                } else {
                    ui.label(&note.text);
                }
            }
        });
    }
}

/// The colours of a heat map and their meaning.
fn show_scale(ui: &mut egui::Ui, labels: &[&str]) {
    const SIZE: egui::Vec2 = egui::vec2(200.0, 26.0);
    const BAR: f32 = 10.0;
    const STRIPES: u32 = 50;
    let (response, painter) = ui.allocate_painter(SIZE, egui::Sense::hover());
    let area = response.rect.shrink2(egui::vec2(8.0, 0.0));
    let at = |share: f32| area.left() + share * area.width();
    for stripe in 0..STRIPES {
        let share = |stripe: u32| stripe as f32 / STRIPES as f32;
        let [r, g, b] = heat_color(share(stripe) + 0.5 / STRIPES as f32);
        let ends = [at(share(stripe)), at(share(stripe + 1))];
        let stripe = egui::Rect::from_x_y_ranges(ends[0]..=ends[1], area.top()..=area.top() + BAR);
        painter.rect_filled(stripe, 0.0, egui::Color32::from_rgb(r, g, b));
    }
    for (index, text) in labels.iter().enumerate() {
        let share = index as f32 / (labels.len() - 1) as f32;
        painter.text(
            egui::pos2(at(share), area.bottom()),
            egui::Align2::CENTER_BOTTOM,
            text,
            egui::FontId::proportional(11.0),
            ui.visuals().text_color(),
        );
    }
}

fn show_player(ui: &mut egui::Ui, stage: &LoadedScene, player: &Player, asked: &mut Vec<Action>) {
    let (animations, chosen) = (&stage.animations, stage.animation());
    let name = |index: usize| {
        let name = animations.get(index).and_then(|a| a.name.clone());
        name.unwrap_or_else(|| format!("animation {index}"))
    };
    if animations.len() > 1 {
        egui::ComboBox::from_id_salt("animation").selected_text(name(chosen)).show_ui(ui, |ui| {
            for index in 0..animations.len() {
                if ui.selectable_label(index == chosen, name(index)).clicked() {
                    asked.push(Action::PlayAnimation(index));
                }
            }
        });
    }
    ui.horizontal(|ui| {
        let label = if player.is_playing() { "Pause" } else { "Play" };
        for (label, action) in [(label, Action::PlayOrPause), ("Slower", Action::Slower), ("Faster", Action::Faster)] {
            if ui.button(label).clicked() {
                asked.push(action);
            }
        }
        ui.label(format!("x {}", player.speed()));
    });
    let mut time = player.time();
    let slider = egui::Slider::new(&mut time, 0.0..=player.duration()).suffix(" s");
    if ui.add(slider).changed() {
        asked.push(Action::Seek(time));
    }
}

/// Controls of a picture's antialiasing.
fn edit(ui: &mut egui::Ui, look: &mut Look) {
    ui.horizontal(|ui| {
        for method in [MethodKind::Superpixel, MethodKind::None, MethodKind::Msaa, MethodKind::Ssaa] {
            let is_chosen = look.method() == method;
            if ui.selectable_label(is_chosen, method.to_string()).clicked() && !is_chosen {
                look.set_method(method);
            }
        }
    });
    if look.method() == MethodKind::None {
        return;
    }
    egui::ComboBox::from_label("samples").selected_text(look.samples().to_string()).show_ui(ui, |ui| {
        for samples in (0..=10).map(|exponent| 1 << exponent) {
            // Most devices have these numbers of samples.
            let is_common = look.method() == MethodKind::Msaa && samples <= 8;
            if is_common || look.can_have(samples) {
                let is_chosen = look.samples() == samples;
                if ui.selectable_label(is_chosen, samples.to_string()).clicked() {
                    look.set_samples(samples);
                }
            }
        }
    });
    let Some(superpixels) = look.superpixels_mut() else {
        return;
    };
    ui.horizontal(|ui| {
        ui.label("contrast");
        let mut contrast = superpixels.threshold();
        if ui.add(egui::Slider::new(&mut contrast, 0..=MOST_CONTRAST)).changed() {
            superpixels.contrast = Some(contrast);
        }
        if superpixels.contrast.is_some() && ui.button("default").clicked() {
            superpixels.contrast = None;
        }
    });
    ui.horizontal(|ui| {
        ui.label("detect");
        for detection in [Detection::Contrast, Detection::Edges, Detection::Exact] {
            let name = gpc::names::name(&detection);
            ui.selectable_value(&mut superpixels.detection, detection, name);
        }
    });
    ui.horizontal(|ui| {
        ui.label("pattern");
        for pattern in [Pattern::Lines, Pattern::Sobol, Pattern::Lattice, Pattern::Korobov, Pattern::Grid] {
            if pattern.offsets(superpixels.cells.samples).is_ok() {
                let name = pattern.to_string();
                ui.selectable_value(&mut superpixels.cells.pattern, pattern, name);
            }
        }
    });
}

/// Figures about the work that the picture took.
fn show_figures(ui: &mut egui::Ui, layer: &Layer) {
    let statistics = &layer.statistics;
    match layer.shown {
        Some(1) => ui.label("one sample a pixel"),
        Some(samples) => ui.label(format!("{samples} samples a pixel")),
        None if layer.is_waiting() => ui.label("kernels are compiled"),
        None => ui.label("being refined"),
    };
    let [width, height] = layer.look.settings.size.map(f64::from);
    if layer.look.method() == MethodKind::Superpixel {
        let share = 100.0 * statistics.superpixels as f64 / (width * height).max(1.0);
        ui.label(format!("{} superpixels, {share:.1} %", statistics.superpixels));
    }
    ui.label(format!("{:.1} ms on the device, {} MiB", statistics.gpu_ms(), statistics.memory_bytes >> 20));
    if !statistics.skipped_passes.is_empty() {
        ui.label(format!("skipped: {}", statistics.skipped_passes.join(", ")));
    }
    ui.collapsing("passes", |ui| {
        egui::Grid::new("passes").num_columns(2).show(ui, |ui| {
            for pass in &statistics.passes {
                ui.label(pass.pass);
                ui.monospace(format!("{:8.2} ms", pass.ms));
                ui.end_row();
            }
        });
    });
}

fn show_split(ctx: &egui::Context, column: u32) {
    let x = column as f32 / ctx.pixels_per_point();
    let line = egui::Stroke::new(1.0, egui::Color32::WHITE);
    let height = ctx.content_rect().y_range();
    ctx.layer_painter(egui::LayerId::background()).vline(x, height, line);
}

fn show_keys(ctx: &egui::Context) {
    // The list scrolls if it is higher than the window.
    const MARGIN: f32 = 48.0;
    let height = ctx.content_rect().height() - MARGIN;
    let area = egui::ScrollArea::vertical().min_scrolled_height(height);
    overlay("keys", egui::Align2::CENTER_CENTER).show(ctx, |ui| {
        area.show(ui, |ui| {
            egui::Grid::new("list of keys").striped(true).show(ui, |ui| {
                for (label, does) in keys::list().chain(keys::MOUSE) {
                    ui.strong(label);
                    ui.label(does);
                    ui.end_row();
                }
            });
        });
    });
}

/// A small window without a title or a handle.
fn overlay(id: &'static str, anchor: egui::Align2) -> egui::Window<'static> {
    let margin = egui::vec2(8.0, 8.0) * -anchor.to_sign();
    egui::Window::new(id).title_bar(false).resizable(false).anchor(anchor, margin)
}

//! Panel, notes and list of keys, drawn over the picture.

use super::keys::{self, Action};
use super::lens::Lenses;
use super::look::Look;
use super::notes::Note;
use super::overlay::Overlay;
use super::player::Player;
use gpc::camera::zoom::{Shape, Transition};
use gpc::compare::heat_color;
use gpc::render::{Detection, MethodKind, Statistics};
use gpc::sampling::Pattern;
use gpc::scene::AnimationInfo;
use std::time::Duration;

/// State that the panel shows.
pub struct Facts<'a> {
    pub notes: &'a [Note],
    pub loading: Option<LoadingFacts<'a>>,
    pub shows_keys: bool,
    pub shows_panel: bool,
    /// Column of the split in pixels.
    pub split: Option<u32>,
    pub lenses: &'a Lenses,
    /// Whether the lenses' transitions are coloured.
    pub tints: bool,
    /// Overlay that is shown instead of colours.
    pub overlay: Option<Overlay>,
    /// Text about the overlay.
    pub figures: Option<&'a str>,
    /// Whether a picture with more samples is being made.
    pub is_refining: bool,
    pub photo: Option<PhotoFacts>,
    pub scene: Option<SceneFacts<'a>>,
    pub pictures: Vec<PictureFacts<'a>>,
}

/// State of the file that is being loaded.
pub struct LoadingFacts<'a> {
    pub name: &'a str,
    pub since: Duration,
    pub step: &'static str,
    /// Share of the loading that is done, 0 to 1.
    pub share: f32,
}

/// Description of the photograph.
pub struct PhotoFacts {
    pub name: String,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Whether the photograph can be unzoomed.
    pub is_zoomed: bool,
}

/// Description of the scene.
pub struct SceneFacts<'a> {
    pub name: String,
    /// Warnings: parts of the file that can't be shown.
    pub warnings: &'a [String],
    pub triangles: u64,
    /// Animations, the index of the one that is played, and its player; `None` without animations.
    pub motion: Option<(&'a [AnimationInfo], usize, &'a Player)>,
}

/// State of a picture.
pub struct PictureFacts<'a> {
    pub look: &'a Look,
    /// Samples a pixel of the visible picture, if all of its pixels have the same number.
    pub shown: Option<u32>,
    /// Whether the device has compiled the picture's kernels.
    pub is_prepared: bool,
    pub statistics: &'a Statistics,
}

/// Changes that the user has asked for in the panel.
#[derive(Default)]
pub struct Wishes {
    /// Index of a picture, and the antialiasing that it should have.
    pub look: Option<(usize, Look)>,
    /// Outline and transition that the active lens should have.
    pub lens: Option<(Shape, Transition)>,
    /// Action of a button, for which there is also a key.
    pub action: Option<Action>,
    /// Overlay to show; `Some(None)` shows colours again.
    pub overlay: Option<Option<Overlay>>,
    /// Time of the animation to show, in seconds.
    pub time: Option<f64>,
    /// Index of the animation to play.
    pub animation: Option<usize>,
    /// Whether to switch between playing and pausing.
    pub toggles_play: bool,
    /// Number of steps by which to change the speed.
    pub speed_steps: i32,
}

const ERROR: egui::Color32 = egui::Color32::from_rgb(255, 140, 130);
/// Largest contrast threshold that the panel offers, in 8-bit sRGB code values.
const MOST_CONTRAST: u8 = 64;

/// Lays out panel, notes and lists, and returns what the user asked for.
pub fn show(ctx: &egui::Context, facts: &Facts<'_>) -> Wishes {
    let mut wishes = Wishes::default();
    if let Some(column) = facts.split {
        show_split(ctx, column);
    }
    if facts.shows_panel && (facts.scene.is_some() || facts.photo.is_some()) {
        show_panel(ctx, facts, &mut wishes);
    }
    show_notes(ctx, facts);
    if facts.shows_keys {
        show_keys(ctx);
    }
    wishes
}

fn show_panel(ctx: &egui::Context, facts: &Facts<'_>, wishes: &mut Wishes) {
    egui::Window::new("panel").title_bar(false).resizable(false).default_pos([8.0, 8.0]).show(ctx, |ui| {
        if let Some(photo) = &facts.photo {
            let [width, height] = photo.size;
            ui.strong(&photo.name);
            ui.label(format!("{width} x {height} pixels"));
            if photo.is_zoomed {
                ui.label("zoomed: U unzooms it under the pointer");
            }
        }
        if let Some(scene) = &facts.scene {
            show_scene(ui, scene, facts, wishes);
            ui.separator();
            show_overlay(ui, facts, wishes);
        }
        show_lenses(ui, facts, wishes);
        if facts.is_refining {
            ui.weak("being made in the background");
        }
        ui.weak("H lists the keys, P hides this");
    });
}

fn show_scene(ui: &mut egui::Ui, scene: &SceneFacts<'_>, facts: &Facts<'_>, wishes: &mut Wishes) {
    ui.strong(&scene.name);
    ui.label(format!("{} triangles", scene.triangles));
    if !scene.warnings.is_empty() {
        let title = format!("warnings: {}", scene.warnings.len());
        ui.collapsing(title, |ui| {
            egui::ScrollArea::vertical().max_height(200.0).show(ui, |ui| {
                for warning in scene.warnings {
                    ui.label(warning);
                }
            });
        });
    }
    if let Some((animations, chosen, player)) = scene.motion {
        ui.separator();
        show_player(ui, animations, chosen, player, wishes);
    }
    for (index, picture) in facts.pictures.iter().enumerate() {
        ui.separator();
        ui.push_id(index, |ui| {
            let mut look = picture.look.clone();
            edit(ui, &mut look);
            if look != *picture.look {
                wishes.look = Some((index, look));
            }
            show_figures(ui, picture);
        });
    }
}

/// Controls of the overlay.
fn show_overlay(ui: &mut egui::Ui, facts: &Facts<'_>, wishes: &mut Wishes) {
    let name = |overlay: Option<Overlay>| overlay.map_or("colours", Overlay::name);
    egui::ComboBox::from_label("shown").selected_text(name(facts.overlay)).show_ui(ui, |ui| {
        let all = std::iter::once(None).chain(Overlay::ALL.map(Some));
        for overlay in all {
            let is_chosen = overlay == facts.overlay;
            if ui.selectable_label(is_chosen, name(overlay)).clicked() {
                wishes.overlay = Some(overlay);
            }
        }
    });
    if let Some(overlay) = facts.overlay.filter(|overlay| !overlay.scale().is_empty()) {
        show_scale(ui, overlay.scale());
    }
    if let Some(figures) = facts.figures {
        ui.label(figures);
    }
}

/// The colours of a heat map and their meaning.
fn show_scale(ui: &mut egui::Ui, marks: &[(f64, &str)]) {
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
    for (share, text) in marks {
        painter.text(
            egui::pos2(at(*share as f32), area.bottom()),
            egui::Align2::CENTER_BOTTOM,
            text,
            egui::FontId::proportional(11.0),
            ui.visuals().text_color(),
        );
    }
}

/// Controls of the lenses.
fn show_lenses(ui: &mut egui::Ui, facts: &Facts<'_>, wishes: &mut Wishes) {
    let lenses = facts.lenses.regions();
    let Some(lens) = lenses.get(facts.lenses.active()) else {
        return;
    };
    ui.separator();
    ui.label(format!(
        "lens {} of {}: {:.2} times as large",
        facts.lenses.active() + 1,
        lenses.len(),
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
        wishes.lens = Some((shape, transition));
    }
    ui.horizontal(|ui| {
        if ui.button("Remove").clicked() {
            wishes.action = Some(Action::RemoveLens);
        }
        let mut tints = facts.tints;
        if ui.checkbox(&mut tints, "transition in colour").changed() {
            wishes.action = Some(Action::Tint);
        }
    });
}

fn show_player(ui: &mut egui::Ui, animations: &[AnimationInfo], chosen: usize, player: &Player, wishes: &mut Wishes) {
    let name = |index: usize| {
        let name = animations.get(index).and_then(|a| a.name.clone());
        name.unwrap_or_else(|| format!("animation {index}"))
    };
    if animations.len() > 1 {
        egui::ComboBox::from_id_salt("animation").selected_text(name(chosen)).show_ui(ui, |ui| {
            for index in 0..animations.len() {
                if ui.selectable_label(index == chosen, name(index)).clicked() {
                    wishes.animation = Some(index);
                }
            }
        });
    }
    ui.horizontal(|ui| {
        let label = if player.is_playing() { "Pause" } else { "Play" };
        wishes.toggles_play |= ui.button(label).clicked();
        if ui.button("Slower").clicked() {
            wishes.speed_steps -= 1;
        }
        if ui.button("Faster").clicked() {
            wishes.speed_steps += 1;
        }
        ui.label(format!("x {}", player.speed()));
    });
    let mut time = player.time();
    let slider = egui::Slider::new(&mut time, 0.0..=player.duration()).suffix(" s");
    if ui.add(slider).changed() {
        wishes.time = Some(time);
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
fn show_figures(ui: &mut egui::Ui, picture: &PictureFacts<'_>) {
    let statistics = picture.statistics;
    match picture.shown {
        Some(1) => ui.label("one sample a pixel"),
        Some(samples) => ui.label(format!("{samples} samples a pixel")),
        None if picture.is_prepared => ui.label("being refined"),
        None => ui.label("kernels are compiled"),
    };
    let [width, height] = picture.look.settings.size.map(f64::from);
    if picture.look.method() == MethodKind::Superpixel {
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

fn show_notes(ctx: &egui::Context, facts: &Facts<'_>) {
    if facts.notes.is_empty() && facts.loading.is_none() {
        return;
    }
    // What is behind the notes can be dragged through them.
    let area = overlay("notes", egui::Align2::LEFT_BOTTOM).interactable(false);
    area.show(ctx, |ui| {
        ui.set_max_width(0.7 * ctx.content_rect().width());
        if let Some(loading) = &facts.loading {
            ui.label(format!("Loading {}: {}", loading.name, loading.step));
            let waited = format!("{} s; Esc stops it", loading.since.as_secs());
            ui.add(egui::ProgressBar::new(loading.share).text(waited).desired_width(240.0));
            ctx.request_repaint_after(Duration::from_millis(250));
        }
        for note in facts.notes {
            if note.is_error {
                ui.colored_label(ERROR, &note.text);
            } else {
                ui.label(&note.text);
            }
        }
    });
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

//! What lies over the picture: the panel, notes, and the list of keys.

use super::command::detection_name;
use super::keys;
use super::look::{Look, method_name};
use super::notes::Note;
use super::player::Player;
use gpc::camera::zoom::{Shape, Transition, ZoomRegion};
use gpc::output::AovKind;
use gpc::render::{Detection, Method, Statistics};
use gpc::sampling::Pattern;
use gpc::scene::AnimationInfo;
use std::time::Duration;

/// What there is to tell.
pub struct Facts<'a> {
    pub notes: &'a [Note],
    /// Name of what is being loaded, and for how long.
    pub loading: Option<(&'a str, Duration)>,
    pub shows_keys: bool,
    pub shows_panel: bool,
    /// Column of the split in pixels.
    pub split: Option<u32>,
    pub lens: Option<ZoomRegion>,
    /// What pixels hold beside their colours, where that is seen.
    pub attribute: Option<AovKind>,
    pub scene: Option<SceneFacts<'a>>,
    pub pictures: Vec<PictureFacts<'a>>,
}

/// What is known of the scene.
pub struct SceneFacts<'a> {
    pub name: String,
    pub triangles: u64,
    /// Where it moves: the animations, which of them is played, and its time.
    pub motion: Option<(&'a [AnimationInfo], usize, &'a Player)>,
}

/// What is known of a picture.
pub struct PictureFacts<'a> {
    pub look: &'a Look,
    /// Samples of what is seen, where all of it has as many.
    pub shown: Option<u32>,
    pub statistics: &'a Statistics,
}

/// What the user changed in the panel.
#[derive(Default)]
pub struct Wishes {
    /// How a picture is antialiased, by the picture's index.
    pub look: Option<(usize, Look)>,
    pub lens: Option<ZoomRegion>,
    /// What to see of pixels: their colours, or something beside.
    pub attribute: Option<Option<AovKind>>,
    /// Moment of the animation in seconds.
    pub time: Option<f64>,
    /// Index of the animation.
    pub animation: Option<usize>,
    /// To play or pause.
    pub toggles_play: bool,
    /// Steps of the speed.
    pub speed_steps: i32,
}

const ERROR: egui::Color32 = egui::Color32::from_rgb(255, 140, 130);
/// Thresholds that the panel offers.
const MOST_CONTRAST: u8 = 64;

/// Lays everything out.
pub fn show(ctx: &egui::Context, facts: &Facts<'_>) -> Wishes {
    let mut wishes = Wishes::default();
    if let Some(column) = facts.split {
        show_split(ctx, column);
    }
    if let Some(scene) = facts.scene.as_ref().filter(|_| facts.shows_panel) {
        show_panel(ctx, scene, facts, &mut wishes);
    }
    show_notes(ctx, facts);
    if facts.shows_keys {
        show_keys(ctx);
    }
    wishes
}

fn show_panel(ctx: &egui::Context, scene: &SceneFacts<'_>, facts: &Facts<'_>, wishes: &mut Wishes) {
    egui::Window::new("panel")
        .title_bar(false)
        .resizable(false)
        .default_pos([8.0, 8.0])
        .show(ctx, |ui| {
            ui.strong(&scene.name);
            ui.label(format!("{} triangles", scene.triangles));
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
            ui.separator();
            show_cover(ui, facts, wishes);
            ui.weak("H lists the keys, P hides this");
        });
}

/// Changes what is seen in the stead of the frames.
fn show_cover(ui: &mut egui::Ui, facts: &Facts<'_>, wishes: &mut Wishes) {
    let name = |attribute: Option<AovKind>| attribute.map_or("colours", AovKind::name);
    egui::ComboBox::from_label("shown")
        .selected_text(name(facts.attribute))
        .show_ui(ui, |ui| {
            let all = std::iter::once(None).chain(AovKind::ALL.map(Some));
            for attribute in all {
                let is_chosen = attribute == facts.attribute;
                if ui.selectable_label(is_chosen, name(attribute)).clicked() {
                    wishes.attribute = Some(attribute);
                }
            }
        });
    let Some(mut lens) = facts.lens else {
        return;
    };
    ui.label(format!(
        "lens: {:.2} times as large",
        1.0 / lens.multiplicity
    ));
    ui.horizontal(|ui| {
        ui.selectable_value(&mut lens.shape, Shape::Circle, "circle");
        ui.selectable_value(&mut lens.shape, Shape::Rectangle, "rectangle");
    });
    ui.horizontal(|ui| {
        ui.selectable_value(&mut lens.transition, Transition::Linear, "linear");
        ui.selectable_value(&mut lens.transition, Transition::Smooth, "smooth");
    });
    if Some(lens) != facts.lens {
        wishes.lens = Some(lens);
    }
}

fn show_player(
    ui: &mut egui::Ui,
    animations: &[AnimationInfo],
    chosen: usize,
    player: &Player,
    wishes: &mut Wishes,
) {
    let name = |index: usize| {
        let name = animations.get(index).and_then(|a| a.name.clone());
        name.unwrap_or_else(|| format!("animation {index}"))
    };
    if animations.len() > 1 {
        egui::ComboBox::from_id_salt("animation")
            .selected_text(name(chosen))
            .show_ui(ui, |ui| {
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

/// Changes how a picture is antialiased.
fn edit(ui: &mut egui::Ui, look: &mut Look) {
    ui.horizontal(|ui| {
        for method in [Method::Superpixel, Method::None, Method::Msaa, Method::Ssaa] {
            let is_chosen = look.settings.method == method;
            if ui
                .selectable_label(is_chosen, method_name(method))
                .clicked()
                && !is_chosen
            {
                look.set_method(method);
            }
        }
    });
    if look.settings.method == Method::None {
        return;
    }
    egui::ComboBox::from_label("samples")
        .selected_text(look.settings.samples.to_string())
        .show_ui(ui, |ui| {
            for samples in (0..=10).map(|exponent| 1 << exponent) {
                // A device has most of these.
                let is_common = look.settings.method == Method::Msaa && samples <= 8;
                if is_common || look.can_have(samples) {
                    ui.selectable_value(&mut look.settings.samples, samples, samples.to_string());
                }
            }
        });
    if look.settings.method != Method::Superpixel {
        return;
    }
    ui.horizontal(|ui| {
        ui.label("contrast");
        let mut contrast = look.contrast_at(look.settings.samples);
        if ui
            .add(egui::Slider::new(&mut contrast, 0..=MOST_CONTRAST))
            .changed()
        {
            look.contrast = Some(contrast);
        }
        if look.contrast.is_some() && ui.button("default").clicked() {
            look.contrast = None;
        }
    });
    ui.horizontal(|ui| {
        ui.label("detect");
        for detection in [Detection::Contrast, Detection::Edges, Detection::Exact] {
            let name = detection_name(detection);
            ui.selectable_value(&mut look.settings.detection, detection, name);
        }
    });
    ui.horizontal(|ui| {
        ui.label("pattern");
        for (pattern, name) in [
            (Pattern::Sobol, "sobol"),
            (Pattern::Lattice, "lattice"),
            (Pattern::Korobov, "korobov"),
            (Pattern::Grid, "grid"),
        ] {
            if pattern.offsets(look.settings.samples).is_ok() {
                ui.selectable_value(&mut look.settings.pattern, pattern, name);
            }
        }
    });
}

/// Says what the picture took.
fn show_figures(ui: &mut egui::Ui, picture: &PictureFacts<'_>) {
    let statistics = picture.statistics;
    match picture.shown {
        Some(samples) => ui.label(format!("{samples} samples a pixel")),
        None => ui.label("being refined"),
    };
    let [width, height] = picture.look.settings.size.map(f64::from);
    if picture.look.settings.method == Method::Superpixel {
        let share = 100.0 * statistics.superpixels as f64 / (width * height).max(1.0);
        ui.label(format!(
            "{} superpixels, {share:.1} %",
            statistics.superpixels
        ));
    }
    ui.label(format!(
        "{:.1} ms on the device, {} MiB",
        statistics.gpu_ms(),
        statistics.memory_bytes >> 20
    ));
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
    ctx.layer_painter(egui::LayerId::background())
        .vline(x, height, line);
}

fn show_notes(ctx: &egui::Context, facts: &Facts<'_>) {
    if facts.notes.is_empty() && facts.loading.is_none() {
        return;
    }
    overlay("notes", egui::Align2::LEFT_BOTTOM).show(ctx, |ui| {
        ui.set_max_width(0.7 * ctx.content_rect().width());
        if let Some((name, since)) = facts.loading {
            ui.label(format!(
                "Loading {name}: {} s. Esc stops it.",
                since.as_secs()
            ));
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
    overlay("keys", egui::Align2::CENTER_CENTER).show(ctx, |ui| {
        egui::ScrollArea::vertical().show(ui, |ui| {
            egui::Grid::new("list of keys")
                .striped(true)
                .show(ui, |ui| {
                    for (label, does) in keys::list().chain(keys::MOUSE) {
                        ui.strong(label);
                        ui.label(does);
                        ui.end_row();
                    }
                });
        });
    });
}

/// A window without a title or a handle.
fn overlay(id: &'static str, anchor: egui::Align2) -> egui::Window<'static> {
    let margin = egui::vec2(8.0, 8.0) * -anchor.to_sign();
    egui::Window::new(id)
        .title_bar(false)
        .resizable(false)
        .anchor(anchor, margin)
}

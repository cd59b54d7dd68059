//! What lies over the picture: notes, the list of keys, and the state of things.

use super::keys;
use super::notes::Note;
use std::time::Duration;

/// What there is to tell.
pub struct Facts<'a> {
    pub notes: &'a [Note],
    /// Name of what is being loaded, and for how long.
    pub loading: Option<(&'a str, Duration)>,
    pub shows_keys: bool,
    /// Column of the split in pixels.
    pub split: Option<u32>,
}

const ERROR: egui::Color32 = egui::Color32::from_rgb(255, 140, 130);

/// Lays everything out.
pub fn show(ctx: &egui::Context, facts: &Facts<'_>) {
    if let Some(column) = facts.split {
        show_split(ctx, column);
    }
    show_notes(ctx, facts);
    if facts.shows_keys {
        show_keys(ctx);
    }
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

//! Bars of the time that each pass takes.

use super::{escape, short};
use crate::cli::bench::results::{Row, SceneResults};
use gpc::bench::PassCost;
use gpc::render::{MethodKind, PassTime};
use std::fmt::Write;

const WIDTH: f64 = 1120.0;
const LEFT: f64 = 118.0;
const RIGHT: f64 = 90.0;
const STEP: f64 = 26.0;
const THICKNESS: f64 = 18.0;
/// Number of colours in `style.css`.
const COLORS: usize = 10;
/// Share of the longest bar below which a pass is drawn as one of the others.
const LEAST: f64 = 0.012;

/// Draws a bar for one sample a pixel and one for each number of samples of the superpixels. Supersampling is left
/// out: its bar would dwarf the others.
pub fn chart(scene: &SceneResults) -> String {
    let shown = |row: &&Row| matches!(row.method, MethodKind::None | MethodKind::Superpixel);
    let rows: Vec<&Row> = scene.rows.iter().filter(shown).collect();
    let longest = rows.iter().map(|row| row.cost.gpu_ms.median).fold(0.0, f64::max);
    let passes = large_passes(&rows, longest);
    let scale = (WIDTH - LEFT - RIGHT) / longest.max(f64::MIN_POSITIVE);
    let mut svg = format!(
        "<svg class=\"bars\" viewBox=\"0 0 {WIDTH} {}\" role=\"img\" aria-label=\"time by pass\">",
        STEP * rows.len() as f64 + 4.0
    );
    for (index, row) in rows.iter().enumerate() {
        let top = STEP * index as f64 + 4.0;
        let baseline = top + 13.5;
        let name = if row.method == MethodKind::None {
            "one sample".to_owned()
        } else {
            format!("{} {}", row.method, row.samples)
        };
        let _ = write!(svg, "<text x=\"{:.1}\" y=\"{baseline:.1}\" text-anchor=\"end\">{name}</text>", LEFT - 8.0);
        let mut left = LEFT;
        for (pass, ms) in segments(row, &passes) {
            let width = ms * scale;
            let _ = write!(
                svg,
                "<rect class=\"{}\" x=\"{left:.2}\" y=\"{top:.1}\" width=\"{width:.2}\" height=\"{THICKNESS}\">\
                 <title>{}: {} ms</title></rect>",
                class(&passes, pass),
                escape(pass),
                short(ms)
            );
            left += width;
        }
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{baseline:.1}\">{} ms</text>",
            left + 7.0,
            short(row.cost.gpu_ms.median)
        );
    }
    svg.push_str("</svg>\n<p class=\"legend\">");
    for pass in passes.iter().copied().chain([OTHER]) {
        let _ = write!(svg, "<span><i class=\"{}\"></i>{}</span>", class(&passes, pass), escape(pass));
    }
    svg.push_str("</p>\n");
    svg
}

const OTHER: &str = "other";

/// The passes of a row that are part of its time.
fn timed(row: &Row) -> impl Iterator<Item = &PassCost> {
    let passes = row.cost.passes.iter();
    passes.filter(|pass| !PassTime::is_output(pass.pass))
}

/// The passes that get a segment of their own, in the order in which they run.
fn large_passes(rows: &[&Row], longest: f64) -> Vec<&'static str> {
    let mut sizes: Vec<(&str, f64)> = Vec::new();
    for pass in rows.iter().flat_map(|row| timed(row)) {
        match sizes.iter_mut().find(|(name, _)| *name == pass.pass) {
            Some((_, most)) => *most = most.max(pass.ms.median),
            None => sizes.push((pass.pass, pass.ms.median)),
        }
    }
    let mut ranked: Vec<f64> = sizes.iter().map(|(_, most)| *most).collect();
    ranked.sort_by(|a, b| b.total_cmp(a));
    let least = ranked.get(COLORS).copied().unwrap_or(0.0).max(LEAST * longest);
    sizes.into_iter().filter(|(_, most)| *most > least).map(|(name, _)| name).collect()
}

/// A row's passes in order; the small ones are summed up at the end.
fn segments(row: &Row, passes: &[&'static str]) -> Vec<(&'static str, f64)> {
    let mut segments: Vec<_> =
        timed(row).filter(|pass| passes.contains(&pass.pass)).map(|pass| (pass.pass, pass.ms.median)).collect();
    let drawn: f64 = segments.iter().map(|(_, ms)| ms).sum();
    let all: f64 = timed(row).map(|pass| pass.ms.median).sum();
    segments.push((OTHER, (all - drawn).max(0.0)));
    segments
}

fn class(passes: &[&str], pass: &str) -> String {
    passes.iter().position(|known| *known == pass).map_or_else(|| "other".to_owned(), |index| format!("p{index}"))
}

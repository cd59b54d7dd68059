//! The chart of error against time, both on logarithmic axes.

use super::axis::{self, Axis, points};
use super::short;
use crate::cli::bench::METHODS;
use crate::cli::bench::front::{self, front, time};
use crate::cli::bench::results::{Row, SceneResults};
use gpc::render::MethodKind;
use std::fmt::Write;

const WIDTH: f64 = 660.0;
const HEIGHT: f64 = 640.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 44.0;

/// A place on the chart.
type ChartPoint = (f64, f64);

/// An error against the reference: its name and its values.
pub struct Measure {
    name: &'static str,
    of: fn(&Row) -> f64,
}

pub const RMSE: Measure = Measure { name: "RMSE", of: front::error };
pub const FLIP: Measure = Measure { name: "FLIP", of: |row| row.accuracy.flip };

/// Draws the chart of a scene. Rows with an error or a time of zero are left out: a logarithmic axis has no place for
/// them.
pub fn chart(scene: &SceneResults, measure: &Measure) -> String {
    let error = measure.of;
    let drawn: Vec<&Row> = scene.rows.iter().filter(|row| error(row) > 0.0 && time(row) > 0.0).collect();
    if drawn.is_empty() {
        return "<p class=\"note\">No image differs from the truth.</p>".to_owned();
    }
    let x = Axis::logarithmic(drawn.iter().map(|row| time(row)), LEFT, WIDTH - RIGHT);
    let y = Axis::logarithmic(drawn.iter().map(|row| error(row)), HEIGHT - BOTTOM, TOP);
    let place = |row: &Row| (x.place(time(row)), y.place(error(row)));

    let mut svg = format!("<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"error against time\">");
    let frame = axis::PlotArea { left: LEFT, right: WIDTH - RIGHT, top: TOP, bottom: HEIGHT - BOTTOM };
    let names = ["time of a frame on the device, ms", measure.name];
    axis::grid(&mut svg, &frame, [&x, &y], names);
    let front: Vec<ChartPoint> = front(drawn.iter().copied(), error).into_iter().map(place).collect();
    let _ = write!(svg, "<polyline class=\"front\" points=\"{}\"/>", points(&front));
    let mut at = LEFT;
    for method in METHODS {
        let rows: Vec<&Row> = drawn.iter().filter(|row| row.method == method).copied().collect();
        if rows.is_empty() {
            continue;
        }
        let line: Vec<ChartPoint> = rows.iter().map(|row| place(row)).collect();
        let _ = write!(svg, "<g class=\"{method}\"><polyline points=\"{}\"/>", points(&line));
        for (row, (x, y)) in rows.iter().zip(&line) {
            mark(&mut svg, row, measure, *x, *y);
        }
        at = axis::legend(&mut svg, at, &method.to_string());
        svg.push_str("</g>");
    }
    let _ = writeln!(
        svg,
        "<line class=\"front\" x1=\"{:.1}\" x2=\"{:.1}\" y1=\"16\" y2=\"16\"/>\
         <text x=\"{:.1}\" y=\"20\">Pareto front</text></svg>",
        at,
        at + 26.0,
        at + 36.0
    );
    svg
}

fn mark(svg: &mut String, row: &Row, measure: &Measure, x: f64, y: f64) {
    let words =
        format!("{} {}: {} ms, {} {:.5}", row.method, row.samples, short(time(row)), measure.name, (measure.of)(row));
    axis::mark(svg, (x, y), &words);
    // Curves fall to the right, and superpixels lie left of the other methods.
    let (dx, dy, anchor) = match row.method {
        MethodKind::None => (0.0, -10.0, "middle"),
        MethodKind::Superpixel => (-8.0, 13.0, "end"),
        _ => (8.0, -6.0, "start"),
    };
    if row.method != MethodKind::None {
        let _ = write!(
            svg,
            "<text class=\"count\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{}</text>",
            x + dx,
            y + dy,
            row.samples
        );
    }
}

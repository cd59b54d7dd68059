//! The chart of error against time, both on logarithmic axes.

use super::short;
use crate::cli::bench::results::{Row, SceneResults};
use crate::cli::render::Antialiasing;
use std::fmt::Write;

const WIDTH: f64 = 660.0;
const HEIGHT: f64 = 640.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 44.0;

/// A logarithmic axis on a length of the chart.
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// An axis around positive values, with room at both ends.
    fn around(values: impl Iterator<Item = f64> + Clone, from: f64, to: f64) -> Self {
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(0.0, f64::max).max(low);
        Self {
            low: low / 1.5,
            high: high * 1.5,
            from,
            to,
        }
    }

    fn place(&self, value: f64) -> f64 {
        let share = (value / self.low).ln() / (self.high / self.low).ln();
        self.from + share * (self.to - self.from)
    }

    /// Powers of ten, and steps between them where there are few.
    fn ticks(&self) -> Vec<f64> {
        let decades = (self.high / self.low).log10();
        let steps: &[f64] = match decades {
            d if d > 4.0 => &[1.0],
            d if d > 1.8 => &[1.0, 3.0],
            _ => &[1.0, 2.0, 5.0],
        };
        let first = self.low.log10().floor() as i32;
        let last = self.high.log10().ceil() as i32;
        (first..=last)
            .flat_map(|power| steps.iter().map(move |step| step * 10_f64.powi(power)))
            .filter(|value| (self.low..=self.high).contains(value))
            .collect()
    }
}

/// A place on the chart.
type Place = (f64, f64);

/// Draws the chart of a scene. Rows without error or time have no place on it.
pub fn chart(scene: &SceneResults) -> String {
    let drawn: Vec<&Row> = scene
        .rows
        .iter()
        .filter(|row| error(row) > 0.0 && time(row) > 0.0)
        .collect();
    if drawn.is_empty() {
        return "<p class=\"note\">No image differs from the reference.</p>".to_owned();
    }
    let x = Axis::around(drawn.iter().map(|row| time(row)), LEFT, WIDTH - RIGHT);
    let y = Axis::around(drawn.iter().map(|row| error(row)), HEIGHT - BOTTOM, TOP);
    let place = |row: &Row| (x.place(time(row)), y.place(error(row)));

    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"error against time\">"
    );
    grid(&mut svg, &x, &y);
    let front: Vec<Place> = front(&drawn).into_iter().map(place).collect();
    let _ = write!(
        svg,
        "<polyline class=\"front\" points=\"{}\"/>",
        points(&front)
    );
    let mut at = LEFT;
    for method in Antialiasing::ALL {
        let rows: Vec<&Row> = drawn
            .iter()
            .filter(|row| row.method == method)
            .copied()
            .collect();
        if rows.is_empty() {
            continue;
        }
        let line: Vec<Place> = rows.iter().map(|row| place(row)).collect();
        let _ = write!(
            svg,
            "<g class=\"{method}\"><polyline points=\"{}\"/>",
            points(&line)
        );
        for (row, (x, y)) in rows.iter().zip(&line) {
            mark(&mut svg, row, *x, *y);
        }
        let _ = write!(
            svg,
            "<circle cx=\"{:.1}\" cy=\"16\" r=\"4.5\"/><text x=\"{:.1}\" y=\"20\">{method}</text></g>",
            at + 5.0,
            at + 15.0
        );
        at += 34.0 + 7.2 * method.to_string().len() as f64;
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

fn time(row: &Row) -> f64 {
    row.cost.gpu_ms.median
}

fn error(row: &Row) -> f64 {
    row.accuracy.rmse
}

/// The rows that none beats in both time and error, by time.
fn front<'a>(rows: &[&'a Row]) -> Vec<&'a Row> {
    let mut sorted = rows.to_vec();
    sorted.sort_by(|a, b| {
        time(a)
            .total_cmp(&time(b))
            .then(error(a).total_cmp(&error(b)))
    });
    let mut least = f64::INFINITY;
    sorted.retain(|row| {
        let better = error(row) < least;
        least = least.min(error(row));
        better
    });
    sorted
}

fn points(places: &[Place]) -> String {
    let points: Vec<_> = places
        .iter()
        .map(|(x, y)| format!("{x:.1},{y:.1}"))
        .collect();
    points.join(" ")
}

fn mark(svg: &mut String, row: &Row, x: f64, y: f64) {
    let _ = write!(
        svg,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\"><title>{} {}: {} ms, RMSE {:.5}</title></circle>",
        row.method,
        row.samples,
        short(time(row)),
        error(row)
    );
    // Curves fall to the right, and superpixels lie left of the others.
    let (dx, dy, anchor) = match row.method {
        Antialiasing::None => (0.0, -10.0, "middle"),
        Antialiasing::Superpixel => (-8.0, 13.0, "end"),
        Antialiasing::Msaa | Antialiasing::Ssaa => (8.0, -6.0, "start"),
    };
    if row.method != Antialiasing::None {
        let _ = write!(
            svg,
            "<text class=\"count\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{}</text>",
            x + dx,
            y + dy,
            row.samples
        );
    }
}

fn grid(svg: &mut String, x: &Axis, y: &Axis) {
    let (right, bottom) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
    for value in x.ticks() {
        let at = x.place(value);
        let _ = write!(
            svg,
            "<line class=\"grid\" x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{TOP}\" y2=\"{bottom}\"/>\
             <text class=\"tick\" x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{value}</text>",
            bottom + 16.0
        );
    }
    for value in y.ticks() {
        let at = y.place(value);
        let digits = (-value.log10().floor()).max(0.0) as usize;
        let _ = write!(
            svg,
            "<line class=\"grid\" x1=\"{LEFT}\" x2=\"{right}\" y1=\"{at:.1}\" y2=\"{at:.1}\"/>\
             <text class=\"tick\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{value:.digits$}</text>",
            LEFT - 7.0,
            at + 4.0
        );
    }
    let _ = write!(
        svg,
        "<text class=\"axis\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">time of a frame on the device, ms</text>\
         <text class=\"axis\" transform=\"translate(14 {:.1}) rotate(-90)\" text-anchor=\"middle\">RMSE</text>",
        0.5 * (LEFT + right),
        HEIGHT - 8.0,
        0.5 * (TOP + bottom)
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_spans_its_values_in_order() {
        let axis = Axis::around([0.02, 3.0, 0.5].into_iter(), 0.0, 100.0);
        let places = [0.02, 0.5, 3.0].map(|value| axis.place(value));
        assert!(
            places.is_sorted() && places[0] > 0.0 && places[2] < 100.0,
            "{places:?}"
        );
    }

    #[test]
    fn ticks_are_few_and_within() {
        let axis = Axis::around([0.01, 0.09].into_iter(), 0.0, 1.0);
        assert_eq!(axis.ticks(), [0.01, 0.02, 0.05, 0.1]);
        let wide = Axis::around([1.0, 100_000.0].into_iter(), 0.0, 1.0);
        assert_eq!(
            wide.ticks(),
            [1.0, 10.0, 100.0, 1_000.0, 10_000.0, 100_000.0]
        );
    }
}

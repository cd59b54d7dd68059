//! Axes of charts, and the grid between them.

use std::fmt::Write;

/// An axis: maps values to a length of the chart.
pub struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
    logarithmic: bool,
}

/// Place of a chart's axes, in the picture's units.
pub struct PlotArea {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

impl Axis {
    /// A logarithmic axis that holds positive values, with a margin at both ends.
    pub fn logarithmic(values: impl Iterator<Item = f64> + Clone, from: f64, to: f64) -> Self {
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(0.0, f64::max).max(low);
        Self { low: low / 1.5, high: high * 1.5, from, to, logarithmic: true }
    }

    /// A linear axis from 0 to the greatest of the values.
    pub fn linear(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        Self { low: 0.0, high: values.fold(0.0, f64::max).max(f64::MIN_POSITIVE), from, to, logarithmic: false }
    }

    /// Place of a value on the axis.
    pub fn place(&self, value: f64) -> f64 {
        let share = if self.logarithmic {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        };
        self.from + share * (self.to - self.from)
    }

    /// Values to label: powers of ten, with steps between them where these are few; the quarters of a linear axis.
    fn ticks(&self) -> Vec<f64> {
        if !self.logarithmic {
            return (0..=4).map(|step| f64::from(step) * 0.25 * self.high).collect();
        }
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

/// Draws the grid lines, their values and the names of the axes.
pub fn grid(svg: &mut String, frame: &PlotArea, [x, y]: [&Axis; 2], [across, up]: [&str; 2]) {
    let PlotArea { left, right, top, bottom } = frame;
    for value in x.ticks() {
        let at = x.place(value);
        let _ = write!(
            svg,
            "<line class=\"grid\" x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{top}\" y2=\"{bottom}\"/>\
             <text class=\"tick\" x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            bottom + 16.0,
            name(value)
        );
    }
    for value in y.ticks() {
        let at = y.place(value);
        let _ = write!(
            svg,
            "<line class=\"grid\" x1=\"{left}\" x2=\"{right}\" y1=\"{at:.1}\" y2=\"{at:.1}\"/>\
             <text class=\"tick\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            left - 7.0,
            at + 4.0,
            name(value)
        );
    }
    let _ = write!(
        svg,
        "<text class=\"axis\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{across}</text>\
         <text class=\"axis\" transform=\"translate(14 {:.1}) rotate(-90)\" text-anchor=\"middle\">{up}</text>",
        0.5 * (left + right),
        bottom + 36.0,
        0.5 * (top + bottom)
    );
}

/// The label of a tick.
fn name(value: f64) -> String {
    if value >= 1e5 {
        format!("{value:e}")
    } else if value == 0.0 || value >= 1.0 {
        value.to_string()
    } else {
        let digits = (-value.log10().floor()).max(0.0) as usize;
        format!("{value:.digits$}")
    }
}

/// The `points` attribute of a polyline.
pub fn points(places: &[(f64, f64)]) -> String {
    let points: Vec<_> = places.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
    points.join(" ")
}

/// Draws a point whose tooltip is `words`.
pub fn mark(svg: &mut String, (x, y): (f64, f64), words: &str) {
    let _ = write!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\"><title>{words}</title></circle>");
}

/// Draws a method's mark and name above a chart; returns the place of the next legend.
pub fn legend(svg: &mut String, at: f64, name: &str) -> f64 {
    let _ = write!(
        svg,
        "<circle cx=\"{:.1}\" cy=\"16\" r=\"4.5\"/><text x=\"{:.1}\" y=\"20\">{name}</text>",
        at + 5.0,
        at + 15.0
    );
    at + 34.0 + 7.2 * name.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_spans_its_values_in_order() {
        let axis = Axis::logarithmic([0.02, 3.0, 0.5].into_iter(), 0.0, 100.0);
        let places = [0.02, 0.5, 3.0].map(|value| axis.place(value));
        assert!(places.is_sorted() && places[0] > 0.0 && places[2] < 100.0, "{places:?}");
        let axis = Axis::linear([0.0, 100.0, 25.0].into_iter(), 10.0, 50.0);
        assert_eq!([0.0, 25.0, 100.0].map(|v| axis.place(v)), [10.0, 20.0, 50.0]);
    }

    #[test]
    fn ticks_are_few_and_within() {
        let axis = Axis::logarithmic([0.01, 0.09].into_iter(), 0.0, 1.0);
        assert_eq!(axis.ticks(), [0.01, 0.02, 0.05, 0.1]);
        let wide = Axis::logarithmic([1.0, 100_000.0].into_iter(), 0.0, 1.0);
        assert_eq!(wide.ticks(), [1.0, 10.0, 100.0, 1_000.0, 10_000.0, 100_000.0]);
        assert_eq!(["1e5", "300", "0.02", "0"], [1e5, 300.0, 0.02, 0.0].map(name));
    }
}

//! Plots of the documents, as SVG.

use crate::data::{self, Measurement, Row, spread};
use plotters::coord::Shift;
use plotters::prelude::*;

const SIZE: (u32, u32) = (720, 400);
const FONT: (&str, u32) = ("sans-serif", 15);

/// Colour of a method, the same in all plots.
fn colour(method: &str) -> RGBColor {
    match method {
        "none" => RGBColor(110, 110, 110),
        "msaa" => RGBColor(60, 140, 60),
        "ssaa" => RGBColor(40, 90, 180),
        _ => RGBColor(200, 70, 30),
    }
}

fn drawn(draw: impl FnOnce(&DrawingArea<SVGBackend<'_>, Shift>)) -> String {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).unwrap();
        draw(&area);
        area.present().unwrap();
    }
    text
}

/// Points of a method over the textured scenes: median error, median time and number of samples.
fn curve(of: &Measurement, method: &str) -> Vec<(f64, f64, u32)> {
    let mut scenes = of.scenes();
    scenes.retain(|scene| of.textured(scene));
    let median = |value: &dyn Fn(&Row, &Row) -> f64, n: u32| {
        let values = scenes.iter().filter_map(|scene| {
            let (plain, row) = of.find(scene, "none", 1).zip(of.find(scene, method, n))?;
            Some((value(row, plain), *scene))
        });
        spread(values.collect()).map(|spread| spread.median)
    };
    of.samples(method)
        .into_iter()
        .filter_map(|n| {
            let time = median(&|row, plain| row.ms() / plain.ms(), n)?;
            let error = median(&|row, _| row.number("rmse"), n)?;
            Some((time, 1e5 * error, n))
        })
        .collect()
}

/// Plot of error against time of every method, as medians over the textured scenes.
pub fn error_time() -> String {
    let all = data::load("quality");
    let curves: Vec<(&str, Vec<_>)> = ["none", "msaa", "ssaa", "superpixel"]
        .into_iter()
        .filter_map(|method| {
            let points = all.iter().map(|of| curve(of, method)).find(|points| !points.is_empty())?;
            Some((method, points))
        })
        .collect();
    let points = || curves.iter().flat_map(|(_, points)| points);
    let most = |value: fn(&(f64, f64, u32)) -> f64| points().map(value).fold(f64::MIN, f64::max);
    let least = points().map(|point| point.1).fold(f64::MAX, f64::min);
    drawn(|area| {
        let mut chart = ChartBuilder::on(area)
            .margin(12)
            .x_label_area_size(46)
            .y_label_area_size(64)
            .build_cartesian_2d(
                (0.8..3.0 * most(|point| point.0)).log_scale(),
                (0.7 * least..1.5 * most(|point| point.1)).log_scale(),
            )
            .unwrap();
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .label_style(FONT)
            .x_desc("time of a frame / time of one sample a pixel (median of textured scenes)")
            .y_desc("RMSE against the truth, times 100,000")
            .x_label_formatter(&|x| format!("{x:.0}"))
            .y_label_formatter(&|y| format!("{y:.0}"))
            .draw()
            .unwrap();
        for (method, points) in &curves {
            let colour = colour(method);
            let line = points.iter().map(|(time, error, _)| (*time, *error));
            chart.draw_series(LineSeries::new(line, colour.stroke_width(2))).unwrap();
            chart
                .draw_series(points.iter().map(|(time, error, n)| {
                    EmptyElement::at((*time, *error))
                        + Circle::new((0, 0), 4, colour.filled())
                        + Text::new(label(method, *n), beside(method), FONT.into_font().color(&colour))
                }))
                .unwrap();
        }
    })
}

/// Offset of a point's label: above the upper curve, below the lower one.
fn beside(method: &str) -> (i32, i32) {
    match method {
        "superpixel" => (-112, 6),
        "msaa" => (-64, 4),
        _ => (8, -14),
    }
}

fn label(method: &str, samples: u32) -> String {
    match (method, samples) {
        ("none", _) => "one sample".to_owned(),
        _ => format!("{method} {samples}"),
    }
}

/// Plot of time against the number of triangles.
pub fn growth() -> String {
    let all = data::load("growth");
    let of = &all[0];
    let curve = |method: &str| -> Vec<(f64, f64)> {
        let rows = of.rows.iter().filter(|row| row.text("quantity") == "triangles" && row.text("method") == method);
        rows.map(|row| (row.number("value"), row.ms())).collect()
    };
    let methods = ["none", "superpixel", "ssaa"];
    let points: Vec<_> = methods.iter().flat_map(|method| curve(method)).collect();
    let least = points.iter().map(|point| point.1).fold(f64::MAX, f64::min);
    let most = points.iter().map(|point| point.1).fold(f64::MIN, f64::max);
    let largest = points.iter().map(|point| point.0).fold(f64::MIN, f64::max);
    drawn(|area| {
        let mut chart = ChartBuilder::on(area)
            .margin(12)
            .x_label_area_size(46)
            .y_label_area_size(64)
            .build_cartesian_2d((700.0..3.0 * largest).log_scale(), (0.7 * least..1.6 * most).log_scale())
            .unwrap();
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .label_style(FONT)
            .x_desc(format!("triangles in view, {} pixels, 64 samples", of.size()))
            .y_desc("milliseconds a frame")
            .x_label_formatter(&|x| crate::text::short(*x))
            .y_label_formatter(&|y| crate::text::short(*y))
            .draw()
            .unwrap();
        for method in methods {
            let colour = colour(method);
            let points = curve(method);
            chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2))).unwrap();
            if let Some(last) = points.first() {
                let name = label(method, 64);
                let text = Text::new(name, (-4, -24), FONT.into_font().color(&colour));
                let at = EmptyElement::at(*last) + Circle::new((0, 0), 4, colour.filled()) + text;
                chart.draw_series([at]).unwrap();
            }
        }
    })
}

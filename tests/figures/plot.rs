//! Plots of the documents, as SVG.

use crate::data::{self, Measurement, Row, spread};
use plotters::coord::Shift;
use plotters::prelude::*;

const SIZE: (u32, u32) = (800, 480);
const FONT: (&str, u32) = ("sans-serif", 15);

/// Colour of a method, the same in all plots.
fn colour(method: &str) -> RGBColor {
    match method {
        "none" => RGBColor(110, 110, 110),
        "msaa" => RGBColor(60, 140, 60),
        "ssaa" => RGBColor(40, 90, 180),
        "accumulate" => RGBColor(190, 150, 30),
        "rotated" => RGBColor(30, 150, 160),
        "superpixel" => RGBColor(200, 70, 30),
        _ => RGBColor(140, 60, 150),
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

/// Points of a method over some scenes, whose numbers of samples are powers of four: median time, median error and number of samples.
fn curve(of: &Measurement, scenes: &[&str], method: &str) -> Vec<(f64, f64, u32)> {
    let median = |value: &dyn Fn(&Row, &Row) -> f64, n: u32| {
        let values = scenes.iter().filter_map(|scene| {
            let (plain, row) = of.find(scene, "none", 1).zip(of.find(scene, method, n))?;
            Some((value(row, plain), *scene))
        });
        spread(values.collect()).map(|spread| spread.median)
    };
    of.samples(method)
        .into_iter()
        .filter(|n| n.is_power_of_two() && n.trailing_zeros().is_multiple_of(2))
        .filter_map(|n| {
            let time = median(&|row, plain| row.ms() / plain.ms(), n)?;
            let error = median(&|row, _| row.number("rmse"), n)?;
            Some((time, 1e5 * error, n))
        })
        .collect()
}

/// Plot of error against time of every method that was measured.
pub fn error_time() -> String {
    let front = data::front();
    let scenes = front.scenes();
    let curves: Vec<(&str, Vec<_>)> =
        front.of.methods().into_iter().map(|method| (method, curve(&front.of, &scenes, method))).collect();
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
            .x_desc(format!("time of a frame / time of one sample a pixel; medians of {}", front.title()))
            .y_desc("RMSE against the truth, times 100,000")
            .x_label_formatter(&|x| format!("{x:.0}"))
            .y_label_formatter(&|y| format!("{y:.0}"))
            .draw()
            .unwrap();
        let mut named = Vec::new();
        for (method, points) in &curves {
            let colour = colour(method);
            let line = points.iter().map(|(time, error, _)| (*time, *error));
            chart.draw_series(LineSeries::new(line.clone(), colour.stroke_width(2))).unwrap();
            chart.draw_series(line.map(|at| Circle::new(at, 4, colour.filled()))).unwrap();
            let at =
                |(time, error, n): &(f64, f64, u32)| (chart.backend_coord(&(*time, *error)), label(method, *n), colour);
            named.extend(points.iter().map(at));
        }
        names(area, &named);
    })
}

/// Writes the names of points beside them, where they cover no point, no line and no other name. A point without room around it
/// stays without a name.
fn names(area: &DrawingArea<SVGBackend<'_>, Shift>, points: &[((i32, i32), String, RGBColor)]) {
    /// Left, upper, right and lower side.
    type Area = [i32; 4];
    let meets = |a: &Area, b: &Area| a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
    let mut taken: Vec<Area> = points.iter().map(|((x, y), ..)| [x - 6, y - 6, x + 6, y + 6]).collect();
    // Places on the lines between the points of a method.
    for pair in points.windows(2).filter(|pair| pair[0].2 == pair[1].2) {
        let ((x, y), (to_x, to_y)) = (pair[0].0, pair[1].0);
        let places = (1..16).map(|step| (x + (to_x - x) * step / 16, y + (to_y - y) * step / 16));
        taken.extend(places.map(|(x, y)| [x - 3, y - 3, x + 3, y + 3]));
    }
    for &((x, y), ref name, colour) in points {
        let [wide, high] = [8 * name.len() as i32, FONT.1 as i32];
        let corners = [
            (x + 9, y - high),
            (x - 9 - wide, y),
            (x + 9, y - high / 2),
            (x - 9 - wide, y - high / 2),
            (x - wide / 2, y + 9),
        ];
        let area_at = |(left, top): (i32, i32)| [left, top, left + wide, top + high];
        let inside = [70, 12, SIZE.0 as i32 - 12, SIZE.1 as i32 - 60];
        let is_free = |corner: &&(i32, i32)| {
            let [left, top, right, bottom] = area_at(**corner);
            let fits = left >= inside[0] && top >= inside[1] && right <= inside[2] && bottom <= inside[3];
            fits && !taken.iter().any(|other| meets(other, &[left, top, right, bottom]))
        };
        let free = corners.iter().find(is_free).copied();
        if let Some(corner) = free {
            taken.push(area_at(corner));
            area.draw(&Text::new(name.clone(), corner, FONT.into_font().color(&colour))).unwrap();
        }
    }
}

fn label(method: &str, samples: u32) -> String {
    match (method, samples) {
        ("none", _) => "one sample".to_owned(),
        ("msaa", _) => format!("msaa {samples} of the CPU driver"),
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

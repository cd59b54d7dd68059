//! The section on growth: a chart and a table for each quantity.

use super::axis::{self, Axis, PlotArea, points};
use super::{escape, short, times};
use crate::cli::bench::results::{Point, ScalingCurve};
use gpc::render::MethodKind;
use std::fmt::Write;

const WIDTH: f64 = 540.0;
const HEIGHT: f64 = 400.0;
const FRAME: PlotArea = PlotArea { left: 62.0, right: WIDTH - 14.0, top: 34.0, bottom: HEIGHT - 44.0 };
const METHODS: [MethodKind; 3] = [MethodKind::None, MethodKind::Superpixel, MethodKind::Ssaa];

/// The section; empty where no growth was measured.
pub fn section(curves: &[ScalingCurve]) -> String {
    if curves.is_empty() {
        return String::new();
    }
    let charts: String = curves.iter().map(|curve| format!("<div>{}{}</div>\n", chart(curve), table(curve))).collect();
    format!(
        "<section>\n<h2>Growth</h2>\n<p class=\"note\">Time of a frame when one quantity of the scene or the image \
         grows and the others stay: a landscape of hills for triangles and megapixels, upright strips for superpixels, \
         layers before each other for depth. Superpixels and supersampling have 64 samples.</p>\n\
         <div class=\"charts\">{charts}</div>\n</section>\n"
    )
}

fn chart(curve: &ScalingCurve) -> String {
    let values = curve.points.iter().map(|point| point.value);
    // Shares begin at zero, for which a logarithmic axis has no place.
    let x = if values.clone().any(|value| value == 0.0) {
        Axis::linear(values, FRAME.left, FRAME.right)
    } else {
        Axis::logarithmic(values, FRAME.left, FRAME.right)
    };
    let all = curve.points.iter().flat_map(|point| &point.times);
    let y = Axis::logarithmic(all.map(|time| time.gpu_ms.median.max(f64::MIN_POSITIVE)), FRAME.bottom, FRAME.top);
    let name = escape(&curve.quantity);
    let mut svg = format!("<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"time against {name}\">");
    axis::grid(&mut svg, &FRAME, [&x, &y], [&name, "ms"]);
    let mut at = FRAME.left;
    for method in METHODS {
        let ms = |point: &Point| Some((point.value, point.ms(method)?));
        let seen: Vec<_> = curve.points.iter().filter_map(ms).collect();
        let places: Vec<_> =
            seen.iter().map(|(value, ms)| (x.place(*value), y.place(ms.max(f64::MIN_POSITIVE)))).collect();
        let _ = write!(svg, "<g class=\"{method}\"><polyline points=\"{}\"/>", points(&places));
        for (place, (value, ms)) in places.iter().zip(&seen) {
            let words = format!("{method} at {value}: {} ms", short(*ms));
            axis::mark(&mut svg, *place, &words);
        }
        at = axis::legend(&mut svg, at, &method.to_string());
        svg.push_str("</g>");
    }
    svg.push_str("</svg>\n");
    svg
}

fn table(curve: &ScalingCurve) -> String {
    let ratio = |point: &Point, above, below| Some(point.ms(above)? / point.ms(below)?);
    let row = |point: &Point| {
        let cells: String = METHODS
            .map(|method| point.ms(method).map_or_else(|| "–".to_owned(), short))
            .map(|text| format!("<td>{text}</td>"))
            .concat();
        format!(
            "<tr><th>{}</th><td>{}</td>{cells}<td>{}</td><td>{}</td></tr>",
            short(point.value),
            point.superpixel_fraction.map_or_else(|| "–".to_owned(), |share| format!("{:.1} %", 100.0 * share)),
            times(ratio(point, MethodKind::Superpixel, MethodKind::None)),
            times(ratio(point, MethodKind::Ssaa, MethodKind::Superpixel)),
        )
    };
    let rows = curve.points.iter().map(row);
    let notes: String = curve.notes.iter().map(|note| format!("<p class=\"note\">{}</p>", escape(note))).collect();
    let name = escape(&curve.quantity);
    super::tables::table(
        &format!(
            "<th>{name}</th><th>superpixels</th><th>none</th><th>superpixel</th><th>ssaa</th><th>of none</th>\
             <th>faster than ssaa</th>"
        ),
        rows,
        "",
    ) + &notes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::bench::results::Time;
    use gpc::bench::Spread;

    #[test]
    fn a_method_that_ends_early_has_a_shorter_line() {
        let time = |method, ms| Time { method, samples: 64, gpu_ms: Spread::of([ms]), wall_ms: Spread::of([ms]) };
        let point = |value, times| Point { value, size: [640, 360], triangles: 2, superpixel_fraction: None, times };
        let curve = ScalingCurve {
            quantity: "superpixels, %".to_owned(),
            points: vec![
                point(0.0, vec![time(MethodKind::None, 2.0), time(MethodKind::Ssaa, 8.0)]),
                point(50.0, vec![time(MethodKind::None, 3.0)]),
            ],
            notes: vec!["ssaa ends".to_owned()],
        };
        let section = section(&[curve]);
        assert_eq!(section.matches("<title>none at").count(), 2, "{section}");
        assert_eq!(section.matches("<title>ssaa at").count(), 1, "{section}");
        assert!(section.contains("ssaa ends") && !section.contains("NaN"));
    }
}

//! The section on motion: a table of errors and flicker for each scene.

use super::{escape, short, tables, times};
use crate::cli::bench::motion::MotionRatio;
use crate::cli::bench::results::SceneMotion;
use crate::cli::bench::summary::Ratio;
use gpc::bench::Motion;

/// The section; empty if no motion was measured.
pub fn section(scenes: &[SceneMotion], summary: &[MotionRatio]) -> String {
    let Some(first) = scenes.first() else {
        return String::new();
    };
    let [width, height] = first.size;
    let tables: String = scenes.iter().map(table).collect();
    format!(
        "<section>\n<h2>Motion</h2>\n<p class=\"note\">{width} × {height} pixels. <i>Pan</i>: 16 frames of the same view, \
         each moved by another fraction of a pixel. <i>Turn</i>: 16 frames a quarter of a degree apart, about what the \
         camera looks at. <i>RMSE</i> is the mean of each frame's against its own truth of 1,024 samples a pixel; \
         <i>flicker</i> the root mean square, over all pixels, of the standard deviation over time of the error. Both are \
         of values as a display shows them.</p>\n{}{tables}</section>\n",
        ratios(summary)
    )
}

fn ratios(summary: &[MotionRatio]) -> String {
    if summary.is_empty() {
        return String::new();
    }
    let cells = |ratio: &Ratio| {
        format!(
            "<td class=\"group\">{}</td><td>{}× <small>{}</small></td>",
            times(Some(ratio.median)),
            short(ratio.worst),
            escape(&ratio.worst_scene)
        )
    };
    let row = |at: &MotionRatio| format!("<tr><th>{}</th>{}{}</tr>", at.samples, cells(&at.rmse), cells(&at.flicker));
    tables::table(
        "<th>samples</th><th class=\"group\">RMSE</th><th>at worst</th><th class=\"group\">flicker</th><th>at worst</th>",
        summary.iter().map(row),
        "Superpixels over supersampling at equal numbers of samples; medians over scenes and motions.",
    )
}

fn table(scene: &SceneMotion) -> String {
    let first = scene.rows.first().map(|row| row.motion);
    let methods = scene.rows.iter().filter(|row| Some(row.motion) == first);
    let rows = methods.map(|row| {
        let cells = |motion: Motion| match scene.row(motion, row.method, row.samples) {
            Some(row) => {
                format!("<td class=\"group\">{:.5}</td><td>{:.5}</td>", row.steadiness.rmse, row.steadiness.flicker)
            }
            None => "<td class=\"group\">–</td><td>–</td>".to_owned(),
        };
        format!(
            "<tr><th class=\"name\">{}</th><td>{}</td>{}</tr>",
            row.method,
            row.samples,
            Motion::ALL.map(cells).concat()
        )
    });
    let notes: String = scene.notes.iter().map(|note| format!("<p class=\"note\">{}</p>\n", escape(note))).collect();
    let motions = Motion::ALL.map(|motion| format!("<th colspan=\"2\" class=\"group\">{motion}</th>"));
    let columns = "<th class=\"group\">RMSE</th><th>flicker</th>".repeat(Motion::ALL.len());
    let head = format!(
        "<th rowspan=\"2\" class=\"name\">method</th><th rowspan=\"2\">N</th>{}</tr><tr>{columns}",
        motions.concat()
    );
    format!("<h3>{}</h3>\n{}{notes}", escape(&scene.name), tables::table(&head, rows, ""))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::bench::motion::summarize;
    use crate::cli::bench::results::MotionRow;
    use gpc::bench::Steadiness;
    use gpc::render::MethodKind;

    #[test]
    fn superpixels_are_held_against_supersampling_of_as_many_samples() {
        let row = |motion, method, rmse| MotionRow {
            motion,
            method,
            samples: 64,
            steadiness: Steadiness { rmse, flicker: 0.5 * rmse },
        };
        let scene = SceneMotion {
            name: "a < b".to_owned(),
            textured: true,
            size: [320, 180],
            rows: vec![
                row(Motion::Pan, MethodKind::Ssaa, 0.01),
                row(Motion::Pan, MethodKind::Superpixel, 0.02),
                row(Motion::Turn, MethodKind::Ssaa, 0.01),
                row(Motion::Turn, MethodKind::Superpixel, 0.04),
            ],
            notes: Vec::new(),
        };
        let summary = summarize(std::slice::from_ref(&scene));
        let [at] = summary.as_slice() else {
            panic!("{summary:?}");
        };
        assert_eq!((at.samples, at.rmse.median, at.rmse.worst), (64, 3.0, 4.0));
        assert_eq!(at.flicker.worst_scene, "a < b, turn");
        let page = section(&[scene], &summary);
        for part in ["a &lt; b", "0.04000", "0.00500", "3.00×"] {
            assert!(page.contains(part), "{part} in {page}");
        }
        assert_eq!(section(&[], &[]), "");
    }
}

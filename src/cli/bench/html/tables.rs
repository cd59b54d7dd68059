//! Tables of the report.

use super::{escape, short, times};
use crate::cli::bench::results::{Row, SceneResults};
use crate::cli::bench::summary::{self, AtSamples};
use crate::cli::bench::table::decibels;

/// Ratios over all scenes.
pub fn summary(summary: &[AtSamples]) -> String {
    let row = |at: &AtSamples| {
        let worst = at.worst_rmse_ratio.as_ref().map_or_else(
            || "–".to_owned(),
            |(scene, ratio)| format!("{}× <small>{}</small>", short(*ratio), escape(scene)),
        );
        format!(
            "<tr><th>{}</th><td class=\"key\">{}</td><td>{}</td><td>{}</td><td>{worst}</td><td>{}</td></tr>",
            at.samples,
            times(at.speedup),
            times(at.over_none),
            times(at.rmse_ratio),
            at.removed.map_or_else(|| "–".to_owned(), percent),
        )
    };
    table(
        "<th>samples</th><th>faster than supersampling</th><th>time over one sample's</th>\
         <th>RMSE over supersampling's</th><th>at worst</th><th>error removed</th>",
        summary.iter().map(row),
        "Superpixels at equal numbers of samples; medians over the scenes.",
    )
}

/// Ratios scene by scene, with a column for each number of samples.
pub fn by_scene(scenes: &[SceneResults]) -> String {
    let counts: Vec<_> = summary::summarize(scenes)
        .iter()
        .map(|at| at.samples)
        .collect();
    let head: String = [
        "faster than supersampling",
        "time over one sample's",
        "RMSE over supersampling's",
    ]
    .iter()
    .map(|what| {
        format!(
            "<th colspan=\"{}\" class=\"group\">{what}</th>",
            counts.len()
        )
    })
    .collect();
    let numbers: String = counts
        .iter()
        .enumerate()
        .map(|(index, count)| format!("<th{}>{count}</th>", group(index)))
        .collect();
    let row = |scene: &SceneResults| {
        let cells = |ratio: fn(&SceneResults, u32) -> Option<f64>| -> String {
            let cell = |(index, count): (usize, &u32)| {
                format!("<td{}>{}</td>", group(index), times(ratio(scene, *count)))
            };
            counts.iter().enumerate().map(cell).collect()
        };
        let superpixels = scene
            .rows
            .iter()
            .map(|row| row.superpixel_fraction)
            .fold(0.0, f64::max);
        format!(
            "<tr><th class=\"name\">{}</th><td>{}</td>{}{}{}</tr>",
            escape(&scene.name),
            percent(superpixels),
            cells(summary::speedup),
            cells(summary::over_none),
            cells(summary::rmse_ratio),
        )
    };
    table(
        &format!(
            "<th rowspan=\"2\" class=\"name\">scene</th><th rowspan=\"2\">superpixels</th>{head}</tr>\
             <tr>{numbers}{numbers}{numbers}"
        ),
        scenes.iter().map(row),
        "",
    )
}

fn group(index: usize) -> &'static str {
    if index == 0 { " class=\"group\"" } else { "" }
}

/// Everything but the times of passes.
pub fn figures(scene: &SceneResults) -> String {
    let row = |row: &Row| {
        let Row { cost, accuracy, .. } = row;
        format!(
            "<tr><th class=\"name\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>\
             <td>{:.0}</td><td>{}</td><td>{}</td><td>{:.5}</td><td>{}</td><td>{:.5}</td><td>{}</td><td>{:.4}</td>\
             <td>{:.4}</td><td>{}</td><td>{:.3} %</td></tr>",
            row.method,
            row.samples,
            short(cost.gpu_ms.median),
            short(cost.gpu_ms.min),
            short(cost.gpu_ms.spread),
            cost.gpu_ms.count,
            short(cost.wall_ms.median),
            row.memory_bytes as f64 / f64::from(1 << 20),
            percent(row.superpixel_fraction),
            row.candidates,
            accuracy.rmse,
            decibels(accuracy.psnr),
            accuracy.rmse_linear,
            decibels(accuracy.psnr_linear),
            accuracy.max,
            accuracy.flip,
            percent(accuracy.removed),
            100.0 * accuracy.needless,
        )
    };
    table(
        "<th class=\"name\">method</th><th>N</th><th>ms</th><th>least</th><th>±</th><th>frames</th><th>wall ms</th>\
         <th>MiB</th><th>superpixels</th><th>candidates</th><th>RMSE</th><th>PSNR</th><th>RMSE linear</th>\
         <th>PSNR linear</th><th>max</th><th>FLIP</th><th>removed</th><th>needless</th>",
        scene.rows.iter().map(row),
        "",
    )
}

/// What is left of the error of one sample a pixel, by cause; empty where that was not measured.
pub fn left(scene: &SceneResults) -> String {
    let rows: Vec<_> = scene
        .rows
        .iter()
        .filter_map(|row| {
            let left = row.left?;
            let shares = [
                left.superpixels,
                left.below_threshold,
                left.unseen,
                left.inside,
            ];
            let cells: String = shares
                .iter()
                .map(|share| format!("<td>{:.2} %</td>", 100.0 * share))
                .collect();
            Some(format!(
                "<tr><th class=\"name\">{}</th><td>{}</td>{cells}<td>{:.2} %</td></tr>",
                row.method,
                row.samples,
                100.0 * shares.iter().sum::<f64>(),
            ))
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    let table = table(
        "<th class=\"name\">method</th><th>N</th><th>in superpixels</th><th>below the threshold</th>\
         <th>a feature no centre saw</th><th>inside one triangle</th><th>all</th>",
        rows.into_iter(),
        "Squared error by the kind of pixel that it is in, in shares of the squared error of one sample a pixel.",
    );
    format!("<h3>What is left of the error</h3>\n{table}")
}

/// Errors against the second reference; empty where that was not rendered.
pub fn texture_filtering(scene: &SceneResults) -> String {
    let Some(reference) = scene.texture_filtering else {
        return String::new();
    };
    let cells = scene.rows.iter().filter_map(|row| {
        let rmse = row.rmse_sample_footprint?;
        Some((format!("{}<br>{}", row.method, row.samples), rmse))
    });
    let (heads, values): (String, String) = [("reference".to_owned(), reference)]
        .into_iter()
        .chain(cells)
        .map(|(head, rmse)| (format!("<th>{head}</th>"), format!("<td>{rmse:.5}</td>")))
        .unzip();
    let table = table(
        &heads,
        [format!("<tr>{values}</tr>")].into_iter(),
        "RMSE against a second reference, whose texture levels follow the footprint of its samples.",
    );
    format!("<h3>What filtering textures for pixels leaves</h3>\n{table}")
}

/// Medians of the passes' times, with a column for each method and number of samples.
pub fn passes(scene: &SceneResults) -> String {
    let mut names: Vec<&str> = Vec::new();
    for pass in scene.rows.iter().flat_map(|row| &row.cost.passes) {
        if !names.contains(&pass.pass) {
            names.push(pass.pass);
        }
    }
    let head: String = scene
        .rows
        .iter()
        .map(|row| format!("<th>{}<br>{}</th>", row.method, row.samples))
        .collect();
    let line = |name: &str| {
        let cell = |row: &Row| {
            let found = row.cost.passes.iter().find(|pass| pass.pass == name);
            let text = found.map_or_else(String::new, |pass| short(pass.ms.median));
            format!("<td>{text}</td>")
        };
        let cells: String = scene.rows.iter().map(cell).collect();
        format!("<tr><th class=\"name\">{name}</th>{cells}</tr>")
    };
    let totals: String = scene
        .rows
        .iter()
        .map(|row| format!("<td>{}</td>", short(row.cost.gpu_ms.median)))
        .collect();
    table(
        &format!("<th class=\"name\">ms</th>{head}"),
        names.iter().map(|name| line(name)).chain([format!(
            "<tr class=\"total\"><th class=\"name\">all</th>{totals}</tr>"
        )]),
        "",
    )
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// A table of rows of cells.
pub fn table(head: &str, rows: impl Iterator<Item = String>, caption: &str) -> String {
    let rows: Vec<_> = rows.collect();
    let caption = if caption.is_empty() {
        String::new()
    } else {
        format!("<caption>{caption}</caption>")
    };
    format!(
        "<div class=\"wide\"><table>{caption}<thead><tr>{head}</tr></thead>\n<tbody>\n{}\n</tbody></table></div>\n",
        rows.join("\n")
    )
}

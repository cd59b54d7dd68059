//! Tables of the report.

use super::{anchor, escape, short, times};
use crate::cli::bench::front::{TARGETS, time_to_error};
use crate::cli::bench::results::{Row, SceneResults};
use crate::cli::bench::summary::{self, AtSamples, Ratio, Summary, TimeToMatch};
use crate::cli::bench::table::{decibels, share, within};

/// Table of the ratios over all scenes that have textures, or all that have none.
pub fn summary(summary: &Summary) -> String {
    let ratio = |ratio: &Option<Ratio>, class: &str| match ratio {
        None => "<td>–</td><td>–</td>".to_owned(),
        Some(ratio) => format!(
            "<td{class}>{}</td><td>{}× <small>{}</small></td>",
            times(Some(ratio.median)),
            short(ratio.worst),
            escape(&ratio.worst_scene)
        ),
    };
    let row = |at: &AtSamples| {
        format!(
            "<tr><th>{}</th>{}{}{}<td>{}</td><td class=\"key\">{}</td><td>{}</td></tr>",
            at.samples,
            ratio(&at.rmse_ratio, " class=\"key\""),
            ratio(&at.flip_ratio, ""),
            ratio(&at.geometry_ratio, ""),
            at.removed.map_or_else(|| "–".to_owned(), percent),
            times(at.speedup),
            times(at.over_none),
        )
    };
    table(
        "<th>samples</th><th>RMSE over supersampling's</th><th>at worst</th><th>FLIP</th><th>at worst</th>\
         <th>RMSE of geometry alone</th><th>at worst</th><th>error removed</th><th>faster than supersampling</th>\
         <th>time over one sample's</th>",
        summary.at.iter().map(row),
        "Superpixels beside supersampling of as many samples; medians of the scenes.",
    )
}

/// Table of the time in which superpixels reach the error of supersampling; empty if that was not measured.
pub fn reach(summary: &Summary) -> String {
    let row = |reach: &TimeToMatch| {
        let never = reach.scenes.iter().filter(|(_, share)| share.is_none());
        format!(
            "<tr><th>{}</th><td class=\"key\">{}</td><td>{} of {}</td></tr>",
            reach.samples,
            share(reach.share),
            never.count(),
            reach.scenes.len()
        )
    };
    if summary.reach.is_empty() {
        return String::new();
    }
    table(
        "<th>samples</th><th>share of its time</th><th>never</th>",
        summary.reach.iter().map(row),
        "The share of supersampling's time in which superpixels reach its error, along their curve; medians of the scenes.",
    )
}

/// A function that writes one cell: a figure of a scene at a number of samples.
type Cell = fn(&SceneResults, u32) -> Option<String>;

/// Table of figures: a row for each scene, a column for each number of samples.
pub fn by_scene(scenes: &[&SceneResults]) -> String {
    let counts = summary::counts(scenes.iter().copied());
    let figures: [(&str, &[u32], Cell); 5] = [
        ("RMSE over supersampling's", &counts, |scene, samples| {
            summary::rmse_ratio(scene, samples).map(|ratio| times(Some(ratio)))
        }),
        ("of geometry alone", &counts, |scene, samples| {
            summary::geometry_ratio(scene, samples).map(|ratio| times(Some(ratio)))
        }),
        ("faster than supersampling", &counts, |scene, samples| {
            summary::speedup(scene, samples).map(|ratio| times(Some(ratio)))
        }),
        ("time over one sample's", &counts, |scene, samples| {
            summary::over_none(scene, samples).map(|ratio| times(Some(ratio)))
        }),
        ("its error in a share of its time", &TARGETS, |scene, samples| time_to_error(scene, samples).map(share)),
    ];
    // Figures that were not measured are left out.
    let figures: Vec<_> = figures
        .iter()
        .filter(|(_, counts, cell)| {
            let mut each = scenes.iter().flat_map(|s| counts.iter().map(move |c| (s, c)));
            each.any(|(scene, count)| cell(scene, *count).is_some())
        })
        .collect();
    let head: String = figures
        .iter()
        .map(|(what, counts, _)| format!("<th colspan=\"{}\" class=\"group\">{what}</th>", counts.len()))
        .collect();
    let numbers: String = figures
        .iter()
        .flat_map(|(_, counts, _)| counts.iter().enumerate())
        .map(|(index, count)| format!("<th{}>{count}</th>", group(index)))
        .collect();
    let row = |scene: &&SceneResults| {
        let cells: String = figures
            .iter()
            .flat_map(|(_, counts, cell)| {
                counts.iter().enumerate().map(|(index, count)| {
                    let text = cell(scene, *count).unwrap_or_else(|| "–".to_owned());
                    format!("<td{}>{text}</td>", group(index))
                })
            })
            .collect();
        let superpixels = scene.rows.iter().map(|row| row.superpixel_fraction).fold(0.0, f64::max);
        let most = summary::most_of_what_is_left(scene)
            .map_or_else(String::new, |(cause, share)| format!("{cause}, {}", percent(share)));
        format!(
            "<tr><th class=\"name\"><a href=\"#{}\">{}</a></th><td>{}</td>{cells}<td class=\"name\">{most}</td></tr>",
            anchor(&scene.name),
            escape(&scene.name),
            percent(superpixels),
        )
    };
    table(
        &format!(
            "<th rowspan=\"2\" class=\"name\">scene</th><th rowspan=\"2\">superpixels</th>{head}\
             <th rowspan=\"2\" class=\"name\">most of what is left</th></tr><tr>{numbers}"
        ),
        scenes.iter().map(row),
        "",
    )
}

fn group(index: usize) -> &'static str {
    if index == 0 { " class=\"group\"" } else { "" }
}

/// Table of all figures except the times of passes.
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

/// Table of the error that is left, split by cause, as shares of the error of one sample a pixel; empty if that was
/// not measured.
pub fn left(scene: &SceneResults) -> String {
    let rows: Vec<_> = scene
        .rows
        .iter()
        .filter_map(|row| {
            let left = row.left?;
            let faults = row.left_within.as_ref().map(within);
            let faults = faults.map_or([None; 5], |faults| faults.map(Some));
            let [edges, texture, light, inside_texture, inside_light] = faults;
            let shares = [
                Some(left.superpixels),
                edges,
                texture,
                light,
                Some(left.below_threshold),
                Some(left.unseen),
                Some(left.inside),
                inside_texture,
                inside_light,
                Some(left.superpixels + left.below_threshold + left.unseen + left.inside),
            ];
            let cells: String = shares
                .iter()
                .map(|share| match share {
                    Some(share) => format!("<td>{:.2} %</td>", 100.0 * share),
                    None => "<td></td>".to_owned(),
                })
                .collect();
            Some(format!("<tr><th class=\"name\">{}</th><td>{}</td>{cells}</tr>", row.method, row.samples,))
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    let table = table(
        "<th class=\"name\">method</th><th>N</th><th>in superpixels</th><th>edges</th><th>texture</th><th>light</th>\
         <th>below the threshold</th><th>a feature no centre saw</th><th>amid one triangle</th><th>texture</th>\
         <th>light</th><th>all</th>",
        rows.into_iter(),
        "Squared error by the kind of pixel that it is in, in shares of the squared error of one sample a pixel.",
    );
    format!("<h3>What is left of the error</h3>\n{table}")
}

/// Table of the errors of geometry alone; empty if they were not measured.
pub fn geometry(scene: &SceneResults) -> String {
    let rows: Vec<_> = scene
        .rows
        .iter()
        .filter_map(|row| {
            let geometry = row.geometry?;
            Some(format!(
                "<tr><th class=\"name\">{}</th><td>{}</td><td>{:.5}</td><td>{}</td><td>{:.4}</td><td>{}</td></tr>",
                row.method,
                row.samples,
                geometry.rmse,
                decibels(geometry.psnr),
                geometry.flip,
                percent(geometry.removed),
            ))
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    let table = table(
        "<th class=\"name\">method</th><th>N</th><th>RMSE</th><th>PSNR</th><th>FLIP</th><th>removed</th>",
        rows.into_iter(),
        "Textures read for a whole pixel, in the methods and in a reference of their own.",
    );
    format!("<h3>Geometry alone</h3>\n{table}")
}

/// Table of the passes' median times, with a column for each method and number of samples.
pub fn passes(scene: &SceneResults) -> String {
    let mut names: Vec<&str> = Vec::new();
    for pass in scene.rows.iter().flat_map(|row| &row.cost.passes) {
        if !names.contains(&pass.pass) {
            names.push(pass.pass);
        }
    }
    let head: String = scene.rows.iter().map(|row| format!("<th>{}<br>{}</th>", row.method, row.samples)).collect();
    let line = |name: &str| {
        let cell = |row: &Row| {
            let found = row.cost.passes.iter().find(|pass| pass.pass == name);
            let text = found.map_or_else(String::new, |pass| short(pass.ms.median));
            format!("<td>{text}</td>")
        };
        let cells: String = scene.rows.iter().map(cell).collect();
        format!("<tr><th class=\"name\">{name}</th>{cells}</tr>")
    };
    let totals: String = scene.rows.iter().map(|row| format!("<td>{}</td>", short(row.cost.gpu_ms.median))).collect();
    table(
        &format!("<th class=\"name\">ms</th>{head}"),
        names
            .iter()
            .map(|name| line(name))
            .chain([format!("<tr class=\"total\"><th class=\"name\">all but copy</th>{totals}</tr>")]),
        "",
    )
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// A table with the header `head` and these rows.
pub fn table(head: &str, rows: impl Iterator<Item = String>, caption: &str) -> String {
    let rows: Vec<_> = rows.collect();
    let caption = if caption.is_empty() { String::new() } else { format!("<caption>{caption}</caption>") };
    format!(
        "<div class=\"wide\"><table>{caption}<thead><tr>{head}</tr></thead>\n<tbody>\n{}\n</tbody></table></div>\n",
        rows.join("\n")
    )
}

//! The section of one scene.

use super::{anchor, bars, curves, escape, tables, thousands};
use crate::cli::bench::gallery::{Gallery, Part, Version};
use crate::cli::bench::results::SceneResults;

/// Curves, pictures, enlarged parts and tables of a scene.
pub fn section(scene: &SceneResults, gallery: &Gallery) -> String {
    let notes: String = scene.notes.iter().map(|note| format!("; {note}")).collect();
    let overview: String = gallery.overview.iter().map(|v| figure("", v)).collect();
    let parts: String = gallery.parts.iter().map(part).collect();
    format!(
        "<section id=\"{anchor}\">\n<h2>{name}</h2>\n<p class=\"note\">{triangles} triangles{notes}</p>\n\
         <div class=\"two\"><div>{curves}</div><div class=\"overview\">{overview}</div></div>\n{parts}\
         {left}{geometry}<h3>Where the time goes</h3>\n{bars}\
         <details><summary>FLIP against time</summary><div class=\"two\"><div>{flip}</div></div></details>\n\
         <details><summary>Figures</summary>{figures}</details>\n\
         <details><summary>Time by pass</summary>{passes}</details>\n</section>\n",
        anchor = anchor(&scene.name),
        name = escape(&scene.name),
        triangles = thousands(scene.triangles),
        notes = escape(&notes),
        curves = curves::chart(scene, &curves::RMSE),
        flip = curves::chart(scene, &curves::FLIP),
        left = tables::left(scene),
        geometry = tables::geometry(scene),
        bars = bars::chart(scene),
        figures = tables::figures(scene),
        passes = tables::passes(scene),
    )
}

fn part(part: &Part) -> String {
    let [x, y] = part.window.low;
    let versions: String = part.versions.iter().map(|v| figure(" class=\"part\"", v)).collect();
    format!(
        "<h3>{} <small>{} × {} pixels at ({x}, {y})</small></h3>\n<div class=\"parts\">{versions}</div>\n",
        escape(&part.title),
        part.window.size[0],
        part.window.size[1]
    )
}

fn figure(class: &str, version: &Version) -> String {
    let Version { caption, data } = version;
    format!("<figure{class}><img alt=\"{caption}\" src=\"{data}\"><figcaption>{caption}</figcaption></figure>")
}

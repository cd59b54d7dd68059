//! Results as text: for the terminal and as CSV.

use super::csv;
use super::results::{Row, SceneResults};
use super::summary::{Ratio, Summary};
use crate::cli::print;
use gpc::bench::Within;
use std::fmt::Write;

/// Prints the figures of a scene.
pub fn print(scene: &SceneResults) -> anyhow::Result<()> {
    let reference = scene.reference_seconds.map_or_else(String::new, |s| format!(", reference rendered in {s:.0} s"));
    print::line(&format!("\n{}: {} triangles{reference}", scene.name, scene.triangles))?;
    for note in &scene.notes {
        print::line(&format!("  {note}"))?;
    }
    print::line(
        "  method       N    GPU ms  spread  frames   wall ms     MiB  superpx     RMSE    PSNR     max    FLIP  removed  needless",
    )?;
    for row in &scene.rows {
        print::line(&format!("  {}", line(row)))?;
    }
    print_left(scene)?;
    print_geometry(scene)
}

/// Prints the error that is left, by cause.
fn print_left(scene: &SceneResults) -> anyhow::Result<()> {
    let rows = scene.rows.iter().filter_map(|row| Some((row, row.left?)));
    for (index, (row, left)) in rows.enumerate() {
        if index == 0 {
            print::line("  left of one sample's squared error:")?;
            print::line(
                "  method       N  in superpixels (edges, texture, light)  below threshold   unseen  one triangle (texture, light)",
            )?;
        }
        let shares = |faults: &[f64]| {
            let shares: Vec<_> = faults.iter().map(|share| format!("{:.2}", 100.0 * share)).collect();
            format!("({})", shares.join(", "))
        };
        let [superpixels, inside] = match row.left_within.as_ref().map(within) {
            Some(faults) => [shares(&faults[..3]), shares(&faults[3..])],
            None => [const { String::new() }; 2],
        };
        print::line(&format!(
            "  {:<10} {:>4} {:>7.2} % {:>29} {:>14.2} % {:>6.2} % {:>7.2} % {:>20}",
            row.method.to_string(),
            row.samples,
            100.0 * left.superpixels,
            superpixels,
            100.0 * left.below_threshold,
            100.0 * left.unseen,
            100.0 * left.inside,
            inside,
        ))?;
    }
    Ok(())
}

/// Prints the errors of geometry alone.
fn print_geometry(scene: &SceneResults) -> anyhow::Result<()> {
    let rows = scene.rows.iter().filter_map(|row| Some((row, row.geometry?)));
    for (index, (row, geometry)) in rows.enumerate() {
        if index == 0 {
            print::line("  geometry alone, textures read for a whole pixel in all:")?;
            print::line("  method       N     RMSE    PSNR    FLIP  removed")?;
        }
        print::line(&format!(
            "  {:<10} {:>4} {:>8.5} {:>7} {:>7.4} {:>6.1} %",
            row.method.to_string(),
            row.samples,
            geometry.rmse,
            decibels(geometry.psnr),
            geometry.flip,
            100.0 * geometry.removed,
        ))?;
    }
    Ok(())
}

fn line(row: &Row) -> String {
    let Row { cost, accuracy, .. } = row;
    format!(
        "{:<10} {:>4} {:>9.1} {:>7.1} {:>7} {:>9.1} {:>7.0} {:>6.1} % {:>8.5} {:>7} {:>7.4} {:>7.4} {:>6.1} % {:>7.3} %",
        row.method.to_string(),
        row.samples,
        cost.gpu_ms.median,
        cost.gpu_ms.spread,
        cost.gpu_ms.count,
        cost.wall_ms.median,
        row.memory_bytes as f64 / f64::from(1 << 20),
        100.0 * row.superpixel_fraction,
        accuracy.rmse,
        decibels(accuracy.psnr),
        accuracy.max,
        accuracy.flip,
        100.0 * accuracy.removed,
        100.0 * accuracy.needless,
    )
}

/// Prints the ratios over all scenes.
pub fn print_summary(summary: &[Summary]) -> anyhow::Result<()> {
    for of in summary {
        print::line(&format!("\nsuperpixel, medians of {}:", of.about()))?;
        print::line(
            "     N  scenes  RMSE over ssaa's  worst   FLIP  worst  geometry alone  worst  removed  ssaa/superpixel  superpixel/none",
        )?;
        for at in &of.at {
            let median = |ratio: &Option<Ratio>| times(ratio.as_ref().map(|ratio| ratio.median));
            let worst = |ratio: &Option<Ratio>| times(ratio.as_ref().map(|ratio| ratio.worst));
            print::line(&format!(
                "  {:>4}  {:>6}  {:>16}  {:>5}  {:>5}  {:>5}  {:>14}  {:>5}  {:>7}  {:>15}  {:>15}",
                at.samples,
                at.scenes,
                median(&at.rmse_ratio),
                worst(&at.rmse_ratio),
                median(&at.flip_ratio),
                worst(&at.flip_ratio),
                median(&at.geometry_ratio),
                worst(&at.geometry_ratio),
                at.removed.map_or_else(|| "-".to_owned(), |share| format!("{:.1} %", 100.0 * share)),
                times(at.speedup),
                times(at.over_none),
            ))?;
        }
        for reach in &of.reach {
            let never = reach.scenes.iter().filter(|(_, share)| share.is_none());
            print::line(&format!(
                "  share of its time until ssaa {}'s error: {} (never on {} of {})",
                reach.samples,
                share(reach.share),
                never.count(),
                reach.scenes.len(),
            ))?;
        }
    }
    Ok(())
}

/// A ratio of times as text, or "never".
pub fn share(share: Option<f64>) -> String {
    share.map_or_else(|| "never".to_owned(), |share| format!("{:.1} %", 100.0 * share))
}

fn times(ratio: Option<f64>) -> String {
    ratio.map_or_else(|| "-".to_owned(), |ratio| format!("{ratio:.2}"))
}

/// Decibels as text, or "inf" for identical images.
pub fn decibels(psnr: Option<f64>) -> String {
    psnr.map_or_else(|| "inf".to_owned(), |psnr| format!("{psnr:.2}"))
}

const COLUMNS: &str = concat!(
    "scene,triangles,textured,surface_fraction,method,samples,frames,",
    csv::time_columns!(),
    ",memory_bytes,superpixel_fraction,candidates,rmse_linear,psnr_linear,rmse,psnr,max,flip,removed,needless,left_superpixels,left_below_threshold,left_unseen,left_inside,left_superpixel_edges,left_superpixel_texture,left_superpixel_light,left_inside_texture,left_inside_light,geometry_rmse,geometry_flip"
);

/// Table of all rows of all scenes as CSV, without the times of passes (RFC 4180, but with bare line feeds).
pub fn csv(scenes: &[SceneResults]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for scene in scenes {
        for row in &scene.rows {
            let Row { cost, accuracy, .. } = row;
            // Writing to a string can't fail.
            let _ = writeln!(
                text,
                "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}",
                csv::quoted(&scene.name),
                scene.triangles,
                scene.textured,
                scene.surface_fraction,
                row.method,
                row.samples,
                cost.gpu_ms.count,
                csv::times(&cost.gpu_ms, &cost.wall_ms),
                row.memory_bytes,
                row.superpixel_fraction,
                row.candidates,
                accuracy.rmse_linear,
                decibels(accuracy.psnr_linear),
                accuracy.rmse,
                decibels(accuracy.psnr),
                accuracy.max,
                accuracy.flip,
                accuracy.removed,
                accuracy.needless,
                left(row),
                left_within(row),
                optional(row.geometry.map(|geometry| geometry.rmse)),
                optional(row.geometry.map(|geometry| geometry.flip)),
            );
        }
    }
    text
}

/// The four shares of the error that is left, by cause, as cells of a CSV; empty cells if they were not measured.
fn left(row: &Row) -> String {
    let shares = row.left.map(|left| [left.superpixels, left.below_threshold, left.unseen, left.inside]);
    let shares = shares.map_or([None; 4], |shares| shares.map(Some));
    shares.map(optional).join(",")
}

/// The five shares of the error that is left, by fault, as cells of a CSV; empty cells if they were not measured.
fn left_within(row: &Row) -> String {
    let shares = row.left_within.as_ref().map(within);
    let shares = shares.map_or([None; 5], |shares| shares.map(Some));
    shares.map(optional).join(",")
}

/// Shares in the order of the CSV: in superpixels by edges, texture and light, then in pixels of one triangle by
/// texture and light.
pub fn within(within: &Within) -> [f64; 5] {
    [
        within.superpixel_edges,
        within.superpixel_texture,
        within.superpixel_light,
        within.inside_texture,
        within.inside_light,
    ]
}

/// A number as text, or an empty cell.
fn optional(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

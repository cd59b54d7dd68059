//! The most important figure: how fast superpixels reach the error of supersampling.

use crate::data::{self, Measurement, Row, Spread, spread};
use crate::text::{Table, cells, grouped, short};

/// Time in which superpixels reach the RMSE of supersampling with `samples` samples, over the time of supersampling. Of the
/// numbers of samples that reach it, the fastest counts; the share is 1 if none does.
fn share(of: &Measurement, scene: &str, samples: u32) -> Option<f64> {
    let target = of.find(scene, "ssaa", samples)?;
    let tried = of.samples("superpixel");
    let rows = tried
        .iter()
        .filter_map(|n| of.find(scene, "superpixel", *n));
    let reached = rows.filter(|row| row.number("rmse") <= target.number("rmse"));
    let fastest = reached.map(Row::ms).fold(f64::INFINITY, f64::min);
    Some((fastest / target.ms()).min(1.0))
}

/// The share of each scene.
pub fn shares<'a>(of: &'a Measurement, scenes: &[&'a str], samples: u32) -> Option<Spread<'a>> {
    let share = |scene: &&'a str| Some((share(of, scene, samples)?, *scene));
    spread(scenes.iter().filter_map(share).collect())
}

/// Table of the shares, scene by scene and in the median.
pub fn table() -> String {
    let mut text = String::new();
    for of in &data::load("quality") {
        let samples = of.samples("superpixel");
        if samples.is_empty() {
            continue;
        }
        let mut head = cells(&["scene"]);
        head.extend(samples.iter().map(|n| grouped(u64::from(*n))));
        let mut table = Table::new(&head);
        let mut scenes = of.scenes();
        for scene in &scenes {
            let mut row = cells(&[*scene]);
            row.extend(
                samples
                    .iter()
                    .map(|n| share(of, scene, *n).map_or_else(String::new, percent)),
            );
            table.row(&row);
        }
        scenes.retain(|scene| of.textured(scene));
        let mut row = vec![format!(
            "**{} textured scenes, median (worst)**",
            scenes.len()
        )];
        row.extend(samples.iter().map(|n| {
            let shares = shares(of, &scenes, *n);
            shares.map_or_else(String::new, |s| {
                format!("{} ({})", percent(s.median), percent(s.worst.0))
            })
        }));
        table.row(&row);
        text += &format!("{}, {}:\n\n{}\n", of.source(), of.size(), table.finish());
    }
    text
}

fn percent(share: f64) -> String {
    format!("{} %", short(100.0 * share))
}

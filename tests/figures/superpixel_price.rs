//! The price of a superpixel, relative to that of a pixel of supersampling.

use crate::data::{self, Measurement, Row, spread};
use crate::text::{Table, cells, grouped, short};

/// Time that a frame takes longer than one of one sample a pixel, for each superpixel; over the time of supersampling with as many
/// samples for each pixel that holds a surface.
fn price(of: &Measurement, scene: &str, samples: u32) -> Option<f64> {
    let fine = of.find(scene, "superpixel", samples)?;
    let plain = of.find(scene, "none", 1)?;
    let brute = of.find(scene, "ssaa", samples)?;
    let superpixel = (fine.ms() - plain.ms()) / fine.number("superpixel_fraction");
    let pixel = brute.ms() / fine.number("surface_fraction");
    Some(superpixel / pixel)
}

/// Table of the prices, scene by scene and in the median.
pub fn table() -> String {
    let mut text = String::new();
    for of in &data::load("quality") {
        let samples = of.samples("superpixel");
        if samples.is_empty() || !of.rows.iter().all(|row| row.has("surface_fraction")) {
            continue;
        }
        let mut head = cells(&["scene", "surfaces"]);
        head.extend(samples.iter().map(|n| grouped(u64::from(*n))));
        let mut table = Table::new(&head);
        let mut scenes = of.scenes();
        let share = |row: &Row| format!("{:.0} %", 100.0 * row.number("surface_fraction"));
        for scene in &scenes {
            let plain = of.find(scene, "none", 1);
            let mut row = vec![(*scene).to_owned(), plain.map_or_else(String::new, share)];
            row.extend(
                samples
                    .iter()
                    .map(|n| price(of, scene, *n).map_or_else(String::new, short)),
            );
            table.row(&row);
        }
        scenes.retain(|scene| of.textured(scene));
        let mut row = vec![
            format!("**{} textured scenes, median (worst)**", scenes.len()),
            String::new(),
        ];
        row.extend(samples.iter().map(|n| {
            let prices = scenes
                .iter()
                .filter_map(|scene| Some((price(of, scene, *n)?, *scene)))
                .collect();
            spread(prices).map_or_else(String::new, |s| {
                format!("{} ({})", short(s.median), short(s.worst.0))
            })
        }));
        table.row(&row);
        text += &format!("{}, {}:\n\n{}\n", of.source(), of.size(), table.finish());
    }
    text
}

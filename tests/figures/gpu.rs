//! Times that the library adds to a frame on GPUs, pass by pass.

use crate::data::{self, Measurement, Row, spread};
use crate::text::{Table, cells, grouped, short};

/// Rows of `gpu-*.csv` that are no part of what the library adds: sums of others, and what a host's frame has anyway or does not
/// have at all.
const NOT_ADDED: [&str; 4] = ["total", "raster", "encode", "copy"];

/// Table of what superpixels add to the frame, driver by driver.
pub fn table() -> String {
    let mut text = String::new();
    for of in &data::load("gpu") {
        let samples = [64, 1024];
        let mut head = cells(&["scene", "superpixels"]);
        for n in &samples {
            let n = grouped(u64::from(*n));
            head.push(format!("{n} samples: added, ms"));
            head.push("`sample`, ms".to_owned());
            head.push("`sample`, ns a superpixel".to_owned());
        }
        let mut table = Table::new(&head);
        for scene in of.scenes() {
            let fraction = of.find(scene, "superpixel", samples[0]);
            let fraction = fraction.map_or(0.0, |row| row.number("superpixel_fraction"));
            let mut row = vec![scene.to_owned(), format!("{:.1} %", 100.0 * fraction)];
            for n in &samples {
                let values = added(of, scene, *n);
                row.extend(values.map_or_else(|| [""; 3].map(str::to_owned), |v| v.map(short)));
            }
            table.row(&row);
        }
        let mut row = cells(&["**median (worst)**", ""]);
        for n in &samples {
            let of_scene = |scene| Some((added(of, scene, *n)?, scene));
            let all: Vec<_> = of.scenes().into_iter().filter_map(of_scene).collect();
            row.extend([0, 1, 2].map(|column| {
                let values = all.iter().map(|(values, scene)| (values[column], *scene));
                let of_column = spread(values.collect());
                of_column.map_or_else(String::new, |s| format!("{} ({})", short(s.median), short(s.worst.0)))
            }));
        }
        table.row(&row);
        text += &format!("{}, {}:\n\n{}\n", of.source(), of.size(), table.finish());
    }
    text
}

/// Milliseconds that the library adds to a scene, those of the passes that sample, and nanoseconds of these for each superpixel.
/// `None` if the scene was not measured.
fn added(of: &Measurement, scene: &str, samples: u32) -> Option<[f64; 3]> {
    let is_shown = |row: &&Row| row.scene() == scene && row.text("method") == "superpixel" && row.samples() == samples;
    let passes: Vec<&Row> =
        of.rows.iter().filter(is_shown).filter(|row| !NOT_ADDED.contains(&row.text("pass"))).collect();
    let pixels: f64 = (of.head("size").split('x')).map(|side| side.parse::<f64>().unwrap()).product();
    let superpixels = passes.first()?.number("superpixel_fraction") * pixels;
    let all = passes.iter().map(|row| row.ms()).sum();
    let sampling = passes.iter().filter(|row| row.text("pass").starts_with("sample"));
    let sampling: f64 = sampling.map(|row| row.ms()).sum();
    Some([all, sampling, 1e6 * sampling / superpixels.max(1.0)])
}

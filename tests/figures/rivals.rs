//! Comparisons with other renderers: coverage by Mitsuba 3, and images a second from Python.

use crate::data::{self, Measurement, Row};
use crate::text::{Table, cells, error, grouped, short};

/// Value of a column for a scene and a renderer, with a number of samples.
fn value(of: &Measurement, scene: &str, renderer: &str, samples: u32, column: &str) -> f64 {
    let is_it = |row: &&Row| row.scene() == scene && row.text("renderer") == renderer && row.samples() == samples;
    let row = of.rows.iter().find(is_it).unwrap_or_else(|| panic!("no {renderer} with {samples} samples of {scene}"));
    row.number(column)
}

/// Table of scenes: errors of alpha at each number of samples, and what the truth is off by.
pub fn alpha() -> String {
    const SAMPLES: [u32; 3] = [64, 256, 1024];
    const RENDERERS: [(&str, &str); 3] = [("superpixel", "superpixel"), ("ssaa", "`ssaa`"), ("mitsuba", "Mitsuba")];
    let mut text = String::new();
    for of in &data::load("alpha") {
        let mut head = cells(&["scene", "pixels with an edge"]);
        for samples in SAMPLES {
            let name = grouped(samples.into());
            head.extend(RENDERERS.map(|(_, renderer)| format!("{name}: {renderer}")));
        }
        head.push("truth".to_owned());
        let mut table = Table::new(&head);
        for scene in of.scenes() {
            let truths: Vec<&Row> =
                of.rows.iter().filter(|row| row.scene() == scene && row.text("renderer") == "truth").collect();
            let [truth] = truths.as_slice() else {
                panic!("{} truths of {scene}", truths.len());
            };
            let mut row = vec![scene.to_owned(), grouped(truth.number("edge_pixels") as u64)];
            for samples in SAMPLES {
                row.extend(RENDERERS.map(|(renderer, _)| error(value(of, scene, renderer, samples, "rmse"))));
            }
            row.push(error(truth.number("rmse")));
            table.row(&row);
        }
        let size = of.size();
        text += &format!("{}; Mitsuba {}, {size}:\n\n{}\n", of.source(), of.head("mitsuba"), table.finish());
    }
    text
}

/// Table of renderers: images a second of each scene.
pub fn python() -> String {
    let mut text = String::new();
    for of in &data::load("python") {
        let mut renderers: Vec<&str> = Vec::new();
        for row in &of.rows {
            if !renderers.contains(&row.text("renderer")) {
                renderers.push(row.text("renderer"));
            }
        }
        let mut head = cells(&["images a second"]);
        head.extend(of.scenes().iter().map(|scene| (*scene).to_owned()));
        let mut table = Table::new(&head);
        for renderer in renderers {
            let mut row = cells(&[renderer]);
            for scene in of.scenes() {
                let found = of.rows.iter().find(|row| row.scene() == scene && row.text("renderer") == renderer);
                let found = found.unwrap_or_else(|| panic!("no {renderer} of {scene}"));
                row.push(short(found.number("images_per_second")));
            }
            table.row(&row);
        }
        let (size, versions) = (of.size(), of.head("versions"));
        text += &format!("{}; {versions}; {} views, {size}:\n\n{}\n", of.source(), of.head("views"), table.finish());
    }
    text
}

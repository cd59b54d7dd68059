//! Tables of a value by scene and number of samples, with the median over the textured scenes.

use crate::data::{self, Measurement, Spread, spread};
use crate::text::{Table, cells, grouped};

/// Value of a scene with a number of samples; `None` if it was not measured.
type Value = fn(&Measurement, &str, u32) -> Option<f64>;

/// Heading of a further column, and its text for a scene.
type Column = (&'static str, fn(&Measurement, &str) -> String);

/// A table for each measurement of quality. `write` turns a value into text; `further` columns stand before the values.
pub fn tables(further: &[Column], value: Value, write: fn(f64) -> String) -> String {
    let all = data::load("quality");
    let with_superpixels = all.iter().filter(|of| !of.samples("superpixel").is_empty());
    let tables = with_superpixels.map(|of| table(of, further, value, write));
    tables.collect()
}

/// Median and worst of the values of some scenes; `None` if no value was measured.
pub fn spread_of<'a>(value: Value, of: &Measurement, scenes: &[&'a str], samples: u32) -> Option<Spread<'a>> {
    let measured = |scene: &&'a str| Some((value(of, scene, samples)?, *scene));
    spread(scenes.iter().filter_map(measured).collect())
}

fn table(of: &Measurement, further: &[Column], value: Value, write: fn(f64) -> String) -> String {
    let samples = of.compared_samples();
    let mut head = cells(&["scene"]);
    head.extend(further.iter().map(|(name, _)| (*name).to_owned()));
    head.extend(samples.iter().map(|n| grouped(u64::from(*n))));
    let mut table = Table::new(&head);
    let mut scenes = of.scenes();
    for scene in &scenes {
        let mut row = cells(&[*scene]);
        row.extend(further.iter().map(|(_, text)| text(of, scene)));
        let values = samples.iter().map(|n| value(of, scene, *n));
        row.extend(values.map(|value| value.map_or_else(String::new, write)));
        table.row(&row);
    }
    scenes.retain(|scene| of.textured(scene));
    let mut row = vec![format!("**{} textured scenes, median (worst)**", scenes.len())];
    row.extend(further.iter().map(|_| String::new()));
    row.extend(samples.iter().map(|n| {
        spread_of(value, of, &scenes, *n)
            .map_or_else(String::new, |s| format!("{} ({})", write(s.median), write(s.worst.0)))
    }));
    table.row(&row);
    format!("{}, {}:\n\n{}\n", of.source(), of.size(), table.finish())
}

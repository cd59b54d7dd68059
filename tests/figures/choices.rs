//! Error and time of superpixels with other values of an option.

use crate::data::{self, Measurement, Row, spread};
use crate::text::{Table, cells, error};

/// Row of a scene with a value of an option.
fn find<'a>(of: &'a Measurement, scene: &str, option: &str, value: &str) -> Option<&'a Row> {
    of.rows.iter().find(|row| row.scene() == scene && row.text("option") == option && row.text("value") == value)
}

/// Table of the values of an option: medians over textured scenes. Times are those of the fastest frames, which other programs
/// disturb least. They are divided by those with the value `default`.
fn table(option: &str, default: &str) -> String {
    let mut text = String::new();
    for of in &data::load("choices") {
        let mut values: Vec<&str> = Vec::new();
        for row in of.rows.iter().filter(|row| row.text("option") == option) {
            if !values.contains(&row.text("value")) {
                values.push(row.text("value"));
            }
        }
        let mut scenes = of.scenes();
        scenes.retain(|scene| of.textured(scene));
        let name = format!("`--{option}`");
        let head = ["superpixels", "time", "RMSE", "FLIP"];
        let mut table = Table::new(&cells(&[&[name.as_str()][..], &head].concat()));
        for value in values {
            let over = |column: &dyn Fn(&Row, &Row) -> f64| {
                let values = scenes.iter().filter_map(|scene| {
                    let row = find(of, scene, option, value)?;
                    Some((column(row, find(of, scene, option, default)?), *scene))
                });
                let spread = spread(values.collect());
                let spread = spread.unwrap_or_else(|| panic!("no {option} {value}"));
                spread.median
            };
            let share = over(&|row, _| row.number("superpixel_fraction"));
            let time = over(&|row, default| row.number("gpu_ms_min") / default.number("gpu_ms_min"));
            let rmse = over(&|row, _| row.number("rmse"));
            let flip = over(&|row, _| row.number("flip"));
            let name = if value == default { format!("**{value}**") } else { value.to_owned() };
            table.row(&[name, format!("{:.1} %", 100.0 * share), format!("{time:.2}"), error(rmse), error(flip)]);
        }
        text += &format!("{}:\n\n{}\n", of.source(), table.finish());
    }
    text
}

pub fn contrast() -> String {
    table("contrast", "6")
}

pub fn shading() -> String {
    table("shading", "part")
}

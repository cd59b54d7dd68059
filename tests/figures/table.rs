//! Tables of the documents.

use crate::data::{self, Measurement, Row, Spread, spread};
use crate::text::{Table, cells, error, grouped, short};
use crate::time_to_error;

/// Column of a quality file.
type Column = fn(&Row) -> f64;

const RMSE: Column = |row| row.number("rmse");
const FLIP: Column = |row| row.number("flip");
const MS: Column = |row| row.ms();

/// Ratios of a column between two methods, over all scenes that were measured with both.
fn ratios<'a>(
    of: &'a Measurement,
    scenes: &[&'a str],
    column: Column,
    (above, above_samples): (&str, u32),
    (below, below_samples): (&str, u32),
) -> Option<Spread<'a>> {
    let ratio = |scene: &&'a str| {
        let above = of.find(scene, above, above_samples)?;
        let below = of.find(scene, below, below_samples)?;
        Some((column(above) / column(below), *scene))
    };
    spread(scenes.iter().filter_map(ratio).collect())
}

/// Median of a column over scenes.
fn median(of: &Measurement, scenes: &[&str], column: Column, method: &str, samples: u32) -> Option<f64> {
    let value = |scene: &&str| Some((column(of.find(scene, method, samples)?), ""));
    Some(spread(scenes.iter().filter_map(value).collect())?.median)
}

fn textured(of: &Measurement) -> Vec<&str> {
    let mut scenes = of.scenes();
    scenes.retain(|scene| of.textured(scene));
    scenes
}

fn with_worst(spread: Option<Spread<'_>>) -> String {
    spread.map_or_else(String::new, |s| format!("{} ({})", short(s.median), short(s.worst.0)))
}

fn or_none(value: Option<f64>, write: fn(f64) -> String) -> String {
    value.map_or_else(String::new, write)
}

/// Measurement that the documents use for errors: the first one with superpixels.
fn quality(all: &[Measurement]) -> &Measurement {
    let found = all.iter().find(|of| !of.samples("superpixel").is_empty());
    found.expect("docs/bench/quality-*.csv has no superpixels")
}

/// Table of the README: the time of superpixels beside that of one sample, and beside that of supersampling with the same error.
pub fn readme() -> String {
    let front = data::front();
    let (of, scenes) = (&front.of, front.scenes());
    let samples: Vec<u32> = of.compared_samples().into_iter().filter(|n| *n >= 16).collect();
    let mut head = cells(&["median (worst)"]);
    head.extend(samples.iter().map(|n| format!("N = {}", grouped(u64::from(*n)))));
    let mut table = Table::new(&head);
    let mut line = |name: &str, value: &dyn Fn(u32) -> String| {
        let mut row = cells(&[name]);
        row.extend(samples.iter().map(|n| value(*n)));
        table.row(&row);
    };
    line("time with `--samples N` / time with one sample a pixel", &|n| {
        with_worst(ratios(of, &scenes, MS, ("superpixel", n), ("none", 1)))
    });
    line("time to the RMSE of supersampling with N samples / its time", &|n| {
        with_worst(time_to_error::shares(of, &scenes, n))
    });
    format!("{}; {}:\n\n{}", front.title(), of.source(), table.finish())
}

/// The parts of the picture of the README, and the time that each method takes for it.
pub fn picture() -> String {
    let all = data::load("picture");
    let of = &all[0];
    let ms = |method: &str, samples| of.find("fence", method, samples).map_or_else(String::new, |row| short(row.ms()));
    let image = |file: &str, alt: &str| format!("![{alt}](docs/pictures/front-{file}.png)");
    let mut table = Table::new(&[
        format!("one sample a pixel: {} ms", ms("none", 1)),
        format!("supersampling, 4 samples: {} ms", ms("ssaa", 4)),
        format!("`gpc`, `--samples 64`: {} ms", ms("superpixel", 64)),
    ]);
    table.row(&[
        image("none", "The mesh of the fence as rings and dots that are not there"),
        image("ssaa", "The mesh with stripes that are not there"),
        image("superpixel", "The mesh as an even veil, which is denser far away"),
    ]);
    format!(
        "{}\nSupersampling with 64 samples takes {} ms. Driver: {}.",
        table.finish(),
        ms("ssaa", 64),
        of.head("driver")
    )
}

/// Table of error and time of both methods at every number of samples at which both were measured, and of the others.
pub fn choosing() -> String {
    let all = data::load("quality");
    let of = quality(&all);
    let scenes = textured(of);
    let mut table = Table::new(&cells(&[
        "samples",
        "time: superpixel (worst)",
        "`ssaa` (worst)",
        "RMSE: superpixel",
        "`ssaa`",
        "FLIP: superpixel",
        "`ssaa`",
        "RMSE / RMSE of `ssaa` (worst)",
        "FLIP / FLIP of `ssaa` (worst)",
    ]));
    let time = |method, n| with_worst(ratios(of, &scenes, MS, (method, n), ("none", 1)));
    let typical = |column, method, n| or_none(median(of, &scenes, column, method, n), error);
    for n in of.compared_samples() {
        let over = |column| with_worst(ratios(of, &scenes, column, ("superpixel", n), ("ssaa", n)));
        let both = ["superpixel", "ssaa"];
        let times = both.map(|method| time(method, n));
        let [rmse, flip] = [RMSE, FLIP].map(|column| both.map(|method| typical(column, method, n)));
        let mut row = vec![grouped(u64::from(n))];
        row.extend([times, rmse, flip].concat());
        row.extend([over(RMSE), over(FLIP)]);
        table.row(&row);
    }
    let other = |method, n| {
        let [rmse, flip] = [typical(RMSE, method, n), typical(FLIP, method, n)];
        format!("time {}, RMSE {rmse}, FLIP {flip}", time(method, n))
    };
    format!(
        "{}:\n\n{}\nOne sample a pixel (`none`): {}. `msaa` with 4 samples, of this driver: {}.",
        of.source(),
        table.finish(),
        other("none", 1),
        other("msaa", 4)
    )
}

/// Table of the scenes on which each method is better.
pub fn exceptions() -> String {
    let all = data::load("quality");
    let of = quality(&all);
    let scenes = of.scenes();
    let mut table = Table::new(&cells(&[
        "samples",
        "`ssaa` is faster on",
        "`ssaa` has the smaller RMSE on",
        "`ssaa` has the smaller FLIP on",
        "superpixels with a quarter of the samples are faster and have the smaller RMSE on",
    ]));
    for n in of.compared_samples() {
        let count = |is_better: &dyn Fn(&str) -> bool| {
            let better: Vec<&str> = scenes.iter().copied().filter(|scene| is_better(scene)).collect();
            let names =
                if (1..=3).contains(&better.len()) { format!(": {}", better.join(", ")) } else { String::new() };
            format!("{} of {}{names}", better.len(), scenes.len())
        };
        let less = |column: Column, scene: &str, left: (&str, u32), right: (&str, u32)| {
            let [left, right] = [left, right].map(|(method, n)| of.find(scene, method, n).map(column));
            left.zip(right).is_some_and(|(left, right)| left < right)
        };
        let better = |column| count(&|scene| less(column, scene, ("ssaa", n), ("superpixel", n)));
        let quarter = |scene: &str| {
            let less = |column| less(column, scene, ("superpixel", n / 4), ("ssaa", n));
            less(MS) && less(RMSE)
        };
        let quarter = if of.samples("superpixel").contains(&(n / 4)) { count(&quarter) } else { String::new() };
        table.row(&[grouped(u64::from(n)), better(MS), better(RMSE), better(FLIP), quarter]);
    }
    format!("All {} scenes; {}:\n\n{}", scenes.len(), of.source(), table.finish())
}

/// Table of error and time, scene by scene.
pub fn quality_by_scene() -> String {
    let mut text = String::new();
    for of in &data::load("quality") {
        text += &format!("{}, {}.\n\n", of.source(), of.size());
        for n in of.compared_samples() {
            let mut table = Table::new(&cells(&[
                "scene",
                "superpixels",
                "one sample, ms",
                "superpixel, ms",
                "`ssaa`, ms",
                "RMSE",
                "`ssaa`",
                "FLIP",
                "`ssaa`",
            ]));
            for scene in of.scenes() {
                let Some((fine, brute)) = of.find(scene, "superpixel", n).zip(of.find(scene, "ssaa", n)) else {
                    continue;
                };
                let plain = of.find(scene, "none", 1).map(MS);
                table.row(&[
                    scene.to_owned(),
                    format!("{:.1} %", 100.0 * fine.number("superpixel_fraction")),
                    or_none(plain, short),
                    short(fine.ms()),
                    short(brute.ms()),
                    error(RMSE(fine)),
                    error(RMSE(brute)),
                    error(FLIP(fine)),
                    error(FLIP(brute)),
                ]);
            }
            text += &format!("**{} samples**\n\n{}\n", grouped(u64::from(n)), table.finish());
        }
        for n in of.samples("msaa") {
            let mut table = Table::new(&cells(&[
                "scene",
                "one sample, ms",
                "`msaa`, ms",
                "RMSE of one sample",
                "`msaa`",
                "FLIP of one sample",
                "`msaa`",
            ]));
            for scene in of.scenes() {
                if let Some((plain, multi)) = of.find(scene, "none", 1).zip(of.find(scene, "msaa", n)) {
                    table.row(&[
                        scene.to_owned(),
                        short(plain.ms()),
                        short(multi.ms()),
                        error(RMSE(plain)),
                        error(RMSE(multi)),
                        error(FLIP(plain)),
                        error(FLIP(multi)),
                    ]);
                }
            }
            text += &format!("**`msaa`, {n} samples**\n\n{}\n", table.finish());
        }
    }
    text
}

/// Table of times of larger images, driver by driver.
pub fn speed() -> String {
    let mut text = String::new();
    for of in &data::load("speed") {
        let samples = of.samples("superpixel");
        let mut head = cells(&["scene", "one sample, ms"]);
        for n in &samples {
            let n = grouped(u64::from(*n));
            head.extend([format!("{n} samples, ms"), "/ one sample".to_owned(), "`ssaa` / it".to_owned()]);
        }
        let mut table = Table::new(&head);
        for scene in of.scenes() {
            let Some(plain) = of.find(scene, "none", 1) else {
                continue;
            };
            let mut row = vec![scene.to_owned(), short(plain.ms())];
            for n in &samples {
                let fine = of.find(scene, "superpixel", *n).map(MS);
                let brute = of.find(scene, "ssaa", *n).map(MS);
                row.push(or_none(fine, short));
                row.push(or_none(fine.map(|ms| ms / plain.ms()), short));
                row.push(or_none(fine.zip(brute).map(|(fine, brute)| brute / fine), short));
            }
            table.row(&row);
        }
        let scenes = of.scenes();
        let mut row = cells(&["**median**", ""]);
        for n in &samples {
            let over = |above, below| ratios(of, &scenes, MS, above, below).map(|spread| spread.median);
            row.push(String::new());
            row.push(or_none(over(("superpixel", *n), ("none", 1)), short));
            row.push(or_none(over(("ssaa", *n), ("superpixel", *n)), short));
        }
        table.row(&row);
        text += &format!("{}, {}:\n\n{}\n", of.source(), of.size(), table.finish());
    }
    text
}

/// Table of errors and flicker while the camera moves.
pub fn motion() -> String {
    let mut text = String::new();
    for of in &data::load("motion") {
        let samples = of.samples("superpixel");
        let mut head = cells(&["scene", "motion"]);
        for n in &samples {
            head.extend([format!("error, {n} samples"), "flicker".to_owned()]);
        }
        let mut table = Table::new(&head);
        for scene in of.scenes() {
            for motion in ["pan", "turn"] {
                let find = |method: &str, n: u32| {
                    of.rows.iter().find(|row| {
                        row.scene() == scene
                            && row.text("motion") == motion
                            && row.text("method") == method
                            && row.samples() == n
                    })
                };
                let mut row = cells(&[scene, motion]);
                for n in &samples {
                    for column in ["rmse", "flicker"] {
                        let pair = find("superpixel", *n).zip(find("ssaa", *n));
                        let ratio = pair.map(|(fine, brute)| fine.number(column) / brute.number(column));
                        row.push(or_none(ratio, |ratio| format!("{ratio:.2}")));
                    }
                }
                table.row(&row);
            }
        }
        text += &format!("{}, {}:\n\n{}\n", of.source(), of.size(), table.finish());
    }
    text
}

/// Table of the time per sample of the camera's variants.
pub fn variants() -> String {
    let mut text = String::new();
    for of in &data::load("variants") {
        let mut table =
            Table::new(&cells(&["scene", "variant", "device, ns", "/ raster", "by the clock, ns", "/ raster"]));
        for row in &of.rows {
            table.row(&[
                row.scene().to_owned(),
                row.text("variant").to_owned(),
                short(row.number("gpu_ns")),
                short(row.number("gpu_ratio")),
                short(row.number("wall_ns")),
                short(row.number("wall_ratio")),
            ]);
        }
        text += &format!("{}, {}:\n\n{}\n", of.source(), of.size(), table.finish());
    }
    text
}

/// Table of time against the size of scenes and images.
pub fn growth() -> String {
    let mut text = String::new();
    for of in &data::load("growth") {
        let mut table = Table::new(&cells(&["quantity", "value", "one sample, ms", "superpixel, ms", "`ssaa`, ms"]));
        let mut seen = Vec::new();
        for row in &of.rows {
            let key = (row.text("quantity"), row.text("value"));
            if seen.contains(&key) {
                continue;
            }
            seen.push(key);
            let ms = |method: &str| {
                let same = |other: &&Row| {
                    (other.text("quantity"), other.text("value")) == key && other.text("method") == method
                };
                or_none(of.rows.iter().find(same).map(MS), short)
            };
            let (quantity, value) = (key.0, row.number("value"));
            table.row(&[quantity.to_owned(), short(value), ms("none"), ms("superpixel"), ms("ssaa")]);
        }
        text += &format!("{}, {} where pixels do not grow:\n\n{}\n", of.source(), of.size(), table.finish());
    }
    text
}

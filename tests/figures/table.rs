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

fn with_worst(spread: Option<Spread<'_>>) -> String {
    spread.map_or_else(String::new, |s| format!("{} ({})", short(s.median), short(s.worst.0)))
}

fn or_none(value: Option<f64>, write: fn(f64) -> String) -> String {
    value.map_or_else(String::new, write)
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
    line("time / time of one sample a pixel", &|n| with_worst(ratios(of, &scenes, MS, ("superpixel", n), ("none", 1))));
    line("time / time of supersampling with N samples, at equal RMSE", &|n| {
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
    let [rest, driver, note] = [ms("ssaa", 64), of.head("driver").to_owned(), of.note()];
    format!("{}\nSupersampling with 64 samples takes {rest} ms. Driver: {driver}{note}.", table.finish())
}

/// Table of error and time of both methods at every number of samples at which both were measured, and of the others.
pub fn choosing() -> String {
    let front = data::thumbnails();
    let (of, scenes) = (&front.of, front.scenes());
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
        "{}; {}:\n\n{}\nOne sample a pixel (`none`): {}. `msaa` with 4 samples, of this driver: {}.",
        front.title(),
        of.source(),
        table.finish(),
        other("none", 1),
        other("msaa", 4)
    )
}

/// Table of the scenes on which each method is better.
pub fn exceptions() -> String {
    let of = &data::thumbnails().of;
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
    format!("{} scenes, {} pixels; {}:\n\n{}", scenes.len(), of.size(), of.source(), table.finish())
}

/// Number of samples of the tables by scene.
const SHOWN: u32 = 64;

/// Heads of the columns that [`cost`] fills.
const COST: [&str; 5] = ["scene", "superpixels", "one sample, ms", "superpixel, ms", "`ssaa`, ms"];

/// A scene, its share of superpixels, and the times of one sample, of superpixels and of `ssaa`.
fn cost(scene: &str, plain: Option<&Row>, fine: &Row, brute: &Row) -> [String; 5] {
    [
        scene.to_owned(),
        format!("{:.1} %", 100.0 * fine.number("superpixel_fraction")),
        or_none(plain.map(MS), short),
        short(fine.ms()),
        short(brute.ms()),
    ]
}

/// Table of error and time, scene by scene: of views that fill the frame, and of objects in small images.
pub fn quality_by_scene() -> String {
    let mut text = String::new();
    for of in data::load("views").iter().chain(&data::load("quality")) {
        let errors = ["RMSE", "`ssaa`", "FLIP", "`ssaa`", "time / time of `ssaa`, at equal RMSE"];
        let mut table = Table::new(&cells(&[COST, errors].concat()));
        for scene in of.scenes() {
            let Some((fine, brute)) = of.find(scene, "superpixel", SHOWN).zip(of.find(scene, "ssaa", SHOWN)) else {
                continue;
            };
            let errors = [
                error(RMSE(fine)),
                error(RMSE(brute)),
                error(FLIP(fine)),
                error(FLIP(brute)),
                or_none(time_to_error::share(of, scene, SHOWN), short),
            ];
            table.row(&[cost(scene, of.find(scene, "none", 1), fine, brute), errors].concat());
        }
        text += &format!("{}, {}, {SHOWN} samples:\n\n{}\n", of.source(), of.size(), table.finish());
    }
    text
}

/// Table of the time and the error of superpixels in views that fill the frame, at every number of samples.
pub fn views() -> String {
    let mut text = String::new();
    for of in &data::load("views") {
        let scenes = of.scenes();
        let mut table = Table::new(&cells(&[
            "samples",
            "views",
            "time / one sample",
            "`ssaa`",
            "RMSE / RMSE of `ssaa`",
            "FLIP / FLIP of `ssaa`",
            "RMSE / brute force's, at equal time",
            "FLIP / brute force's, at equal time",
            "time / time of `ssaa`, at equal RMSE",
        ]));
        for n in of.compared_samples() {
            let at_equal_time = |column| {
                let ratios = scenes.iter().filter_map(|scene| time_to_error::at_equal_time(of, scene, n, column));
                with_worst(spread(ratios.map(|ratio| (ratio, "")).collect()))
            };
            let over_none = |method| with_worst(ratios(of, &scenes, MS, (method, n), ("none", 1)));
            let over_brute = |column| with_worst(ratios(of, &scenes, column, ("superpixel", n), ("ssaa", n)));
            let count = scenes.iter().filter(|scene| of.find(scene, "ssaa", n).is_some()).count();
            table.row(&[
                grouped(u64::from(n)),
                count.to_string(),
                over_none("superpixel"),
                over_none("ssaa"),
                over_brute(RMSE),
                over_brute(FLIP),
                at_equal_time(RMSE),
                at_equal_time(FLIP),
                with_worst(time_to_error::shares(of, &scenes, n)),
            ]);
        }
        text += &format!("{}, {}, median (worst):\n\n{}\n", of.source(), of.size(), table.finish());
    }
    text
}

/// Table of one view at every number of samples.
pub fn many() -> String {
    let all = data::load("many");
    let of = &all[0];
    let scene = of.scenes()[0];
    let mut table = Table::new(&cells(&[
        "samples",
        "superpixels",
        "superpixel, ms",
        "/ one sample",
        "`ssaa`, ms",
        "/ superpixel",
        "RMSE",
        "`ssaa`",
        "FLIP",
        "`ssaa`",
    ]));
    let plain = of.find(scene, "none", 1).expect("the view was measured with one sample");
    for n in of.compared_samples() {
        let Some((fine, brute)) = of.find(scene, "superpixel", n).zip(of.find(scene, "ssaa", n)) else {
            continue;
        };
        table.row(&[
            grouped(u64::from(n)),
            format!("{:.1} %", 100.0 * fine.number("superpixel_fraction")),
            short(fine.ms()),
            short(fine.ms() / plain.ms()),
            short(brute.ms()),
            short(brute.ms() / fine.ms()),
            error(RMSE(fine)),
            error(RMSE(brute)),
            error(FLIP(fine)),
            error(FLIP(brute)),
        ]);
    }
    let one = short(plain.ms());
    format!("{}; {scene}, {}, one sample {one} ms:\n\n{}", of.source(), of.size(), table.finish())
}

/// Table of the time and the memory of the largest images.
pub fn large() -> String {
    let all = data::load("large");
    let of = &all[0];
    let memory = ["one sample, MB", "superpixel, MB", "`ssaa`, MB"];
    let mut table = Table::new(&cells(&[&COST[..], &memory].concat()));
    for scene in of.scenes() {
        let found = [("none", 1), ("superpixel", SHOWN), ("ssaa", SHOWN)].map(|(method, n)| of.find(scene, method, n));
        let [Some(plain), Some(fine), Some(brute)] = found else {
            continue;
        };
        let memory = [plain, fine, brute].map(|row| short(row.number("memory_bytes") / 1e6));
        table.row(&[&cost(scene, Some(plain), fine, brute)[..], &memory].concat());
    }
    format!("{}, {}, {SHOWN} samples:\n\n{}", of.source(), of.size(), table.finish())
}

/// Table of times of larger images.
pub fn speed() -> String {
    let all = data::load("speed");
    let of = &all[0];
    let samples = [64, 1024];
    let mut head = cells(&["scene", "one sample, ms"]);
    for n in samples {
        let n = grouped(u64::from(n));
        head.extend([
            format!("superpixel, {n} samples, ms"),
            "/ one sample".to_owned(),
            format!("`ssaa`, {n} samples, ms"),
            "/ superpixel".to_owned(),
        ]);
    }
    let mut table = Table::new(&head);
    let scenes = of.scenes();
    for scene in &scenes {
        let Some(plain) = of.find(scene, "none", 1).map(MS) else {
            continue;
        };
        let mut row = vec![(*scene).to_owned(), short(plain)];
        for n in samples {
            let [fine, brute] = ["superpixel", "ssaa"].map(|method| of.find(scene, method, n).map(MS));
            row.push(or_none(fine, short));
            row.push(or_none(fine.map(|ms| ms / plain), short));
            row.push(or_none(brute, short));
            row.push(or_none(fine.zip(brute).map(|(fine, brute)| brute / fine), short));
        }
        table.row(&row);
    }
    let mut row = cells(&["**median**", ""]);
    for n in samples {
        let over = |above, below| or_none(ratios(of, &scenes, MS, above, below).map(|spread| spread.median), short);
        row.extend([
            String::new(),
            over(("superpixel", n), ("none", 1)),
            String::new(),
            over(("ssaa", n), ("superpixel", n)),
        ]);
    }
    table.row(&row);
    format!("{}, {}:\n\n{}", of.source(), of.size(), table.finish())
}

/// Table of errors and flicker while the camera moves, over all scenes and motions.
pub fn motion() -> String {
    let mut text = String::new();
    for of in &data::load("motion") {
        let mut table = Table::new(&cells(&["samples", "error / error of `ssaa`", "flicker / flicker of `ssaa`"]));
        for n in of.samples("superpixel") {
            let ratio = |column: &str| {
                let fine = of.rows.iter().filter(|row| row.text("method") == "superpixel" && row.samples() == n);
                let of_row = |row: &'_ Row| {
                    let same = |other: &&Row| {
                        let is_same = |column| other.text(column) == row.text(column);
                        other.text("method") == "ssaa" && ["scene", "motion", "samples"].into_iter().all(is_same)
                    };
                    Some((row.number(column) / of.rows.iter().find(same)?.number(column), ""))
                };
                with_worst(spread(fine.filter_map(of_row).collect()))
            };
            table.row(&[n.to_string(), ratio("rmse"), ratio("flicker")]);
        }
        text += &format!("{} scenes, {}; {}:\n\n{}\n", of.scenes().len(), of.size(), of.source(), table.finish());
    }
    text
}

/// Table of the time per sample of the camera's variants, over all scenes.
pub fn variants() -> String {
    let mut text = String::new();
    for of in &data::load("variants") {
        let mut table = Table::new(&cells(&["variant", "time on the device / raster", "wall time / raster"]));
        let mut variants: Vec<&str> = of.rows.iter().map(|row| row.text("variant")).collect();
        variants.truncate(
            variants.iter().skip(1).position(|name| *name == variants[0]).map_or(variants.len(), |at| at + 1),
        );
        for variant in variants {
            let rows = || of.rows.iter().filter(|row| row.text("variant") == variant);
            let ratio = |column: &str| with_worst(spread(rows().map(|row| (row.number(column), "")).collect()));
            table.row(&[variant.to_owned(), ratio("gpu_ratio"), ratio("wall_ratio")]);
        }
        text += &format!("{} scenes, {}; {}:\n\n{}\n", of.scenes().len(), of.size(), of.source(), table.finish());
    }
    text
}

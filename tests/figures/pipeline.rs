//! Drawing of the passes of a frame, and their names in a line, made from the passes that the library records.

use crate::passes;

/// What a pass does, in two short lines under its name.
const PURPOSES: [(&str, [&str; 2]); 16] = [
    ("filter", ["triangles that may", "cover a centre"]),
    ("raster", ["triangle ID", "and depth"]),
    ("spans", ["pixels in order", "of material"]),
    ("shade", ["colour at the", "pixel's centre"]),
    ("thin", ["triangles that", "miss all centres"]),
    ("detect", ["does a neighbour", "contrast?"]),
    ("cull", ["triangles that", "touch a superpixel"]),
    ("bin", ["triangles of", "each tile"]),
    ("tally", ["what tiles", "need"]),
    ("schedule", ["as many tiles", "as fit"]),
    ("enlist", ["memory of", "these tiles"]),
    ("setup", ["edges and", "depth planes"]),
    ("sample", ["nearest triangle", "of each sample"]),
    ("sort", ["samples in order", "of material"]),
    ("resolve", ["mean of the", "colours"]),
    ("grow", ["neighbours that", "now contrast"]),
];

/// What `shade` does the second time.
const SHADE_AGAIN: [&str; 2] = ["colour of the", "visible samples"];

/// Width and height of a box, and the distance between the left or upper sides of two.
const BOX: [i32; 2] = [112, 34];
const STEP: [i32; 2] = [154, 104];

/// Number of boxes in a row.
const COLUMNS: usize = 6;

/// Passes of a frame up to the first growth, each once in a row: those for every pixel, and those for superpixels.
fn parts() -> [Vec<&'static str>; 2] {
    let mut names: Vec<&'static str> = Vec::new();
    for pass in passes::of_frame("checker") {
        // Special kernels of `sample` belong to it, and `arguments` only computes the sizes of dispatches.
        let name = match pass.name {
            name if name.starts_with("sample_") => "sample",
            name => name.trim_end_matches("_fragment"),
        };
        if name != "arguments" && names.last() != Some(&name) {
            names.push(name);
        }
    }
    let place = |wanted: &str| names.iter().position(|name| *name == wanted).unwrap();
    let (detect, grow) = (place("detect"), place("grow"));
    let superpixels = names[detect + 1..=grow].to_vec();
    names.truncate(detect + 1);
    [names, superpixels]
}

/// Names of the passes, for the documentation of the crate.
pub fn in_short() -> String {
    let [pixels, superpixels] = parts().map(|part| part.join(" ─▶ "));
    format!("```text\nevery pixel:       {pixels}\nsuperpixels alone: {superpixels}\n```")
}

/// Drawing of the passes.
pub fn draw() -> String {
    let [pixels, superpixels] = parts();
    let rows = |part: &[&str]| part.len().div_ceil(COLUMNS) as i32;
    let first_row = |row: i32| 52 + STEP[1] * row;
    let (above, below) = (rows(&pixels), rows(&superpixels));
    let second = first_row(above) + 72;
    let height = second + STEP[1] * below + 58;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 960 {height}\" font-family=\"sans-serif\" font-size=\"14\">\n\
         <title>The passes of a frame</title>\n\
         <defs><marker id=\"tip\" markerWidth=\"8\" markerHeight=\"8\" refX=\"7\" refY=\"4\" orient=\"auto\">\
         <path d=\"M0 0 8 4 0 8z\" fill=\"#444\"/></marker></defs>\n\
         <rect width=\"960\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    svg += &panel("Every pixel, one sample", "#e8f0f8", [10, STEP[1] * above + 38]);
    let title = "Superpixels alone";
    svg += &panel(title, "#f8efe4", [second - 42, STEP[1] * below + 86]);
    let place = |top: i32, index: usize| {
        let [column, row] = [index % COLUMNS, index / COLUMNS].map(|at| at as i32);
        [26 + STEP[0] * column, top + STEP[1] * row]
    };
    for (top, part) in [(first_row(0), &pixels), (second, &superpixels)] {
        for (index, name) in part.iter().enumerate() {
            let purpose = match (*name, top == second) {
                ("shade", true) => SHADE_AGAIN,
                _ => {
                    let known = PURPOSES.iter().find(|(known, _)| known == name);
                    known.unwrap_or_else(|| panic!("say what {name} does in PURPOSES")).1
                }
            };
            let [x, y] = place(top, index);
            svg += &pass(name, purpose, [x, y]);
            if index + 1 < part.len() {
                svg += &arrow(&between([x, y], place(top, index + 1)), false);
            }
        }
    }
    // From the last pass of every pixel to the first of superpixels.
    let [x, y] = place(first_row(0), pixels.len() - 1);
    let [to_x, to_y] = place(second, 0);
    let middle = second - 54;
    let (from, to) = (x + BOX[0] / 2, to_x + BOX[0] / 2);
    svg += &arrow(&format!("M{from} {}V{middle}H{to}V{}", y + 76, to_y - 2), false);
    svg += &label("mask of superpixels", [480, middle - 6]);
    // Rounds, and the passes that run again after a growth.
    let find = |wanted: &str| superpixels.iter().position(|name| *name == wanted);
    let bottom = second + STEP[1] * below;
    // The path to `schedule` runs outside of the path to `cull`.
    let turns = [
        ("grow", "cull", "the superpixels that growth added", 0),
        ("resolve", "schedule", "the next round, if not all tiles fit", 1),
    ];
    for (last, first, why, number) in turns {
        let [x, y] = place(second, find(last).unwrap());
        let [to_x, to_y] = place(second, find(first).unwrap());
        let down = bottom - 14 + 26 * number;
        let path = format!(
            "M{} {}V{down}H{}V{}H{}V{}",
            x + BOX[0] / 2,
            y + 76,
            21 - 7 * number,
            to_y - 9 - 9 * number,
            to_x + BOX[0] / 2 - 12,
            to_y - 2,
        );
        svg += &arrow(&path, true);
        svg += &label(why, [210, down + 15]);
    }
    svg + "</svg>\n"
}

/// A coloured area with a title; its upper side and its height.
fn panel(title: &str, color: &str, [y, height]: [i32; 2]) -> String {
    let line = y + 22;
    format!(
        "<rect x=\"10\" y=\"{y}\" width=\"940\" height=\"{height}\" rx=\"8\" fill=\"{color}\"/>\n\
         <text x=\"936\" y=\"{line}\" text-anchor=\"end\" fill=\"#333\" font-weight=\"bold\">{title}</text>\n"
    )
}

/// The box of a pass, with its upper left corner.
fn pass(name: &str, purpose: [&str; 2], [x, y]: [i32; 2]) -> String {
    let [width, height] = BOX;
    let (middle, line) = (x + width / 2, y + 22);
    let mut svg = format!(
        "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" rx=\"4\" fill=\"#fff\" stroke=\"#444\"/>\n\
         <text x=\"{middle}\" y=\"{line}\" text-anchor=\"middle\">{name}</text>\n"
    );
    for (number, text) in (0..).zip(purpose) {
        let line = y + 52 + 15 * number;
        svg += &format!(
            "<text x=\"{middle}\" y=\"{line}\" text-anchor=\"middle\" font-size=\"11\" fill=\"#555\">{text}</text>\n"
        );
    }
    svg
}

/// Path from a box to the next one, which may begin the next row.
fn between([x, y]: [i32; 2], [to_x, to_y]: [i32; 2]) -> String {
    let [width, height] = BOX;
    let (from, across) = (x + width, y + height / 2);
    if y == to_y {
        return format!("M{from} {across}H{}", to_x - 2);
    }
    let (right, above) = (from + 14, to_y - 14);
    let to = to_x + width / 2;
    format!("M{from} {across}H{right}V{above}H{to}V{}", to_y - 2)
}

fn arrow(path: &str, dashed: bool) -> String {
    let dashes = if dashed { " stroke-dasharray=\"5 4\"" } else { "" };
    format!(
        "<path d=\"{path}\" fill=\"none\" stroke=\"#444\" stroke-width=\"1.5\" marker-end=\"url(#tip)\"{dashes}/>\n"
    )
}

fn label(text: &str, [x, y]: [i32; 2]) -> String {
    format!("<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\" font-size=\"12\" fill=\"#333\">{text}</text>\n")
}

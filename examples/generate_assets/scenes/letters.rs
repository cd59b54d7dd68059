//! A chart of raised letters. Each line is smaller than the one above it, down to strokes of a fraction of a pixel.

use super::glb::{Builder, Placement};
use super::glyphs::{self, ADVANCE, CAPITAL};
use super::mesh::Mesh;
use glam::{DVec3, dvec3};
use std::collections::BTreeMap;

/// Lines from the top: text, and height of the letters in metres.
const LINES: [(&str, f64); 10] = [
    ("GPC", 0.36),
    ("PINHOLE CAMERA", 0.15),
    ("SAMPLES WHERE IT ALIASES", 0.095),
    ("THE QUICK BROWN FOX JUMPS OVER", 0.075),
    ("THE LAZY DOG 0123456789 AND RUNS", 0.058),
    ("A SUPERPIXEL HOLDS UP TO 1024 SAMPLES", 0.044),
    ("SPHINX OF BLACK QUARTZ JUDGE MY VOW", 0.032),
    ("EACH STROKE HERE IS THINNER THAN A PIXEL", 0.02),
    ("AND HERE ABOUT HALF AS WIDE AS A PIXEL", 0.0105),
    ("PACK MY BOX WITH FIVE DOZEN LIQUOR JUGS.", 0.0075),
];
/// Height of the upper edge of the first line.
const TOP: f64 = 1.8;

/// Builds the scene.
pub fn build() -> Vec<u8> {
    let mut file = Builder::default();
    board(&mut file);
    let red = file.paint("vermilion", [206, 74, 52], 0.5);
    let ink = file.paint("ink", [38, 50, 70], 0.6);
    let mut surfaces = BTreeMap::new();
    let mut meshes = BTreeMap::new();
    let mut baseline = TOP;
    for (number, (text, height)) in LINES.into_iter().enumerate() {
        let scale = height / CAPITAL;
        let material = if number == 0 { red } else { ink };
        let width = (text.len() as f64 * ADVANCE - (ADVANCE - 4.0)) * scale;
        baseline -= height;
        for (i, glyph) in text.chars().enumerate() {
            if glyph == ' ' {
                continue;
            }
            let surface = *surfaces.entry(glyph).or_insert_with(|| file.surface(&glyphs::solid(glyph)));
            let mesh = *meshes.entry((glyph, material)).or_insert_with(|| file.mesh(&[(surface, material)]));
            let place = dvec3(-width / 2.0 + i as f64 * ADVANCE * scale, baseline, 0.0);
            file.place(mesh, Placement { scale: DVec3::splat(scale), ..Placement::at(place) });
        }
        baseline -= height * 0.55 + 0.012;
    }
    file.daylight();
    file.perspective("reader", dvec3(0.62, 1.25, 2.85), dvec3(0.02, 1.12, 0.0), 40.0);
    file.orthographic("front", dvec3(0.0, 1.12, 6.0), dvec3(0.0, 1.12, 0.0), 2.0);
    file.finish("Letters")
}

/// The board behind the letters, its frame, and the easel that carries it.
fn board(file: &mut Builder) {
    let paper = file.paint("paper", [243, 236, 222], 0.9);
    let wood = file.paint("wood", [164, 118, 78], 0.7);
    let [left, right, bottom, top] = [-1.24, 1.24, 0.32, 1.92];
    let mut sheet = Mesh::default();
    sheet.cuboid(dvec3(left, bottom, -0.04), dvec3(right, top, 0.0));
    let mut frame = Mesh::default();
    for x in [left - 0.04, right] {
        frame.cuboid(dvec3(x, bottom - 0.04, -0.06), dvec3(x + 0.04, top + 0.04, 0.03));
    }
    for y in [bottom - 0.04, top] {
        frame.cuboid(dvec3(left, y, -0.06), dvec3(right, y + 0.04, 0.03));
    }
    for [foot, head] in [[-1.0, -0.25], [1.0, 0.25]] {
        frame.tube(&[dvec3(foot, -0.2, -0.1), dvec3(head, 2.4, -0.1)], [0.03, 0.02], 8);
    }
    for (mesh, material) in [(sheet, paper), (frame, wood)] {
        let surface = file.surface(&mesh);
        let mesh = file.mesh(&[(surface, material)]);
        file.place(mesh, Placement::at(DVec3::ZERO));
    }
}

//! A stroke font: capitals and digits as paths on a grid of 4 by 6, extruded.

use super::mesh::Mesh;
use glam::{DVec2, dvec2};

/// Height of a capital in the font's units.
pub const CAPITAL: f64 = 6.0;
/// Distance between the origins of consecutive letters.
pub const ADVANCE: f64 = 5.9;
const STROKE: f64 = 0.78;
const DEPTH: f64 = 0.9;

/// Strokes of a glyph: `M x,y` starts a stroke, `L x,y` is a line, `Q x,y x,y` a quadratic curve.
fn strokes(glyph: char) -> &'static str {
    match glyph {
        'A' => "M0,0 L2,6 L4,0 M.8,2 L3.2,2",
        'B' => "M0,0 L0,6 L2,6 Q3.7,6 3.7,4.6 Q3.7,3.2 2,3.2 L0,3.2 M2,3.2 Q4,3.2 4,1.6 Q4,0 2,0 L0,0",
        'C' => "M4,4.6 Q3.6,6 2,6 Q0,6 0,3 Q0,0 2,0 Q3.6,0 4,1.4",
        'D' => "M0,0 L0,6 L1.4,6 Q4,6 4,3 Q4,0 1.4,0 L0,0",
        'E' => "M4,6 L0,6 L0,0 L4,0 M0,3.1 L3.2,3.1",
        'F' => "M4,6 L0,6 L0,0 M0,3.1 L3.2,3.1",
        'G' => "M4,4.6 Q3.6,6 2,6 Q0,6 0,3 Q0,0 2,0 Q4,0 4,2.6 L2.4,2.6",
        'H' => "M0,0 L0,6 M4,0 L4,6 M0,3.1 L4,3.1",
        'I' => "M2,0 L2,6 M.9,6 L3.1,6 M.9,0 L3.1,0",
        'J' => "M3.4,6 L3.4,1.6 Q3.4,0 1.8,0 Q.3,0 .2,1.5",
        'K' => "M0,0 L0,6 M4,6 L0,2.4 M1.3,3.5 L4,0",
        'L' => "M0,6 L0,0 L3.8,0",
        'M' => "M0,0 L0,6 L2,2.4 L4,6 L4,0",
        'N' => "M0,0 L0,6 L4,0 L4,6",
        'O' => "M2,0 Q0,0 0,3 Q0,6 2,6 Q4,6 4,3 Q4,0 2,0",
        'P' => "M0,0 L0,6 L2.1,6 Q4,6 4,4.4 Q4,2.8 2.1,2.8 L0,2.8",
        'Q' => "M2,0 Q0,0 0,3 Q0,6 2,6 Q4,6 4,3 Q4,0 2,0 M2.5,1.6 L4.2,-.5",
        'R' => "M0,0 L0,6 L2.1,6 Q4,6 4,4.4 Q4,2.8 2.1,2.8 L0,2.8 M2,2.8 L4,0",
        'S' => "M3.8,4.8 Q3.4,6 2,6 Q.2,6 .2,4.5 Q.2,3.4 2,3.1 Q4,2.8 4,1.5 Q4,0 2,0 Q.4,0 .1,1.3",
        'T' => "M2,0 L2,6 M0,6 L4,6",
        'U' => "M0,6 L0,2 Q0,0 2,0 Q4,0 4,2 L4,6",
        'V' => "M0,6 L2,0 L4,6",
        'W' => "M0,6 L1,0 L2,4 L3,0 L4,6",
        'X' => "M0,0 L4,6 M0,6 L4,0",
        'Y' => "M0,6 L2,2.9 L4,6 M2,2.9 L2,0",
        'Z' => "M0,6 L4,6 L0,0 L4,0",
        '0' => "M2,0 Q.2,0 .2,3 Q.2,6 2,6 Q3.8,6 3.8,3 Q3.8,0 2,0 M1.2,1.6 L2.8,4.4",
        '1' => "M.7,4.6 L2,6 L2,0 M.7,0 L3.3,0",
        '2' => "M.2,4.6 Q.5,6 2,6 Q3.8,6 3.8,4.4 Q3.8,3.2 2.4,2.2 L.2,0 L4,0",
        '3' => "M.2,6 L3.8,6 L1.8,3.6 Q4,3.6 4,1.8 Q4,0 2,0 Q.4,0 .1,1.3",
        '4' => "M3,0 L3,6 L0,1.8 L4,1.8",
        '5' => "M3.7,6 L.5,6 L.3,3.3 Q1,3.8 2,3.8 Q4,3.8 4,1.9 Q4,0 2,0 Q.5,0 .1,1.2",
        '6' => "M3.5,5.4 Q2.8,6 2.2,6 Q.2,6 .2,2.4 Q.2,0 2.1,0 Q4,0 4,1.8 Q4,3.6 2.1,3.6 Q.6,3.6 .2,2.2",
        '7' => "M0,6 L4,6 L1.4,0",
        '8' => {
            "M2,3.2 Q.4,3.2 .4,4.6 Q.4,6 2,6 Q3.6,6 3.6,4.6 Q3.6,3.2 2,3.2 Q0,3.2 0,1.6 Q0,0 2,0 Q4,0 4,1.6 Q4,3.2 2,3.2"
        }
        '9' => "M.5,.6 Q1.2,0 1.8,0 Q3.8,0 3.8,3.6 Q3.8,6 1.9,6 Q0,6 0,4.2 Q0,2.4 1.9,2.4 Q3.4,2.4 3.8,3.8",
        '.' => "M1.8,.2 L2.3,.2",
        other => panic!("the font has no {other:?}"),
    }
}

/// A glyph extruded from z = 0 towards +z, with its origin at the lower left.
pub fn solid(glyph: char) -> Mesh {
    let mut mesh = Mesh::default();
    for line in polylines(strokes(glyph)) {
        ribbon(&mut mesh, &line);
    }
    mesh
}

fn polylines(path: &str) -> Vec<Vec<DVec2>> {
    let point = |text: &str| {
        let (x, y) = text.split_once(',').expect("a point is x,y");
        let number = |t: &str| t.parse::<f64>().expect("a coordinate is a number");
        dvec2(number(x), number(y))
    };
    let mut lines: Vec<Vec<DVec2>> = Vec::new();
    let mut words = path.split(' ');
    while let Some(word) = words.next() {
        let (command, first) = word.split_at(1);
        let first = point(first);
        match command {
            "M" => lines.push(vec![first]),
            _ => {
                let line = lines.last_mut().expect("a path starts with M");
                let start = line[line.len() - 1];
                if command == "L" {
                    line.push(first);
                } else {
                    let end = point(words.next().expect("a curve has two points"));
                    line.extend((1..=5).map(|step| {
                        let t = f64::from(step) / 5.0;
                        start.lerp(first, t).lerp(first.lerp(end, t), t)
                    }));
                }
            }
        }
    }
    lines
}

/// A band along a polyline with mitred corners: front face, sides and ends.
fn ribbon(mesh: &mut Mesh, line: &[DVec2]) {
    let last = line.len() - 1;
    let closed = line[0].distance(line[last]) < 1e-9;
    let direction = |i: usize| (line[i + 1] - line[i]).normalize();
    let mitre = |i: usize| {
        let (before, after) = match i {
            0 if closed => (direction(last - 1), direction(0)),
            0 => (direction(0), direction(0)),
            i if i == last && closed => (direction(last - 1), direction(0)),
            i if i == last => (direction(last - 1), direction(last - 1)),
            i => (direction(i - 1), direction(i)),
        };
        let across = (before.perp() + after.perp()).normalize();
        // The mitre of a sharp corner is limited to twice the width.
        across * (STROKE / 2.0 / across.dot(after.perp()).max(0.5))
    };
    let edges: Vec<_> = (0..=last).map(|i| (line[i] + mitre(i), line[i] - mitre(i))).collect();
    let wall = |mesh: &mut Mesh, a: DVec2, b: DVec2| {
        mesh.polygon(&[a.extend(0.0), b.extend(0.0), b.extend(DEPTH), a.extend(DEPTH)]);
    };
    for pair in edges.windows(2) {
        let [(left, right), (next_left, next_right)] = [pair[0], pair[1]];
        mesh.polygon(&[right, next_right, next_left, left].map(|p| p.extend(DEPTH)));
        wall(mesh, right, next_right);
        wall(mesh, next_left, left);
    }
    if !closed {
        wall(mesh, edges[0].0, edges[0].1);
        wall(mesh, edges[last].1, edges[last].0);
    }
}

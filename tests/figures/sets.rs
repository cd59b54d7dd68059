//! Drawing of the camera's sampling sets.

use plotters::prelude::*;
use std::collections::HashSet;

/// Side of a panel, and distance between panels, which leaves room for their names.
const SIDE: i32 = 130;
const GAP: i32 = 14;
const NAME: i32 = 26;
/// Number of pixels along a panel's side.
const PIXELS: i32 = 8;

/// A place of 0 to 1 in a panel.
type Place = (f64, f64);

/// Quasi-random numbers of 0 to 1 (the additive recurrence of the plastic number).
fn scattered(count: u32) -> impl Iterator<Item = Place> {
    (0..count).map(|index| {
        let index = f64::from(index) + 0.5;
        ((index * 0.754_877_666).fract(), (index * 0.569_840_291).fract())
    })
}

fn centres() -> impl Iterator<Item = (i32, i32)> {
    (0..PIXELS * PIXELS).map(|index| (index % PIXELS, index / PIXELS))
}

fn in_pixel((x, y): (i32, i32), (u, v): Place) -> Place {
    let side = f64::from(PIXELS);
    ((f64::from(x) + u) / side, (f64::from(y) + v) / side)
}

/// Planar set: one location in the middle of each pixel.
fn planar() -> Vec<Place> {
    centres().map(|pixel| in_pixel(pixel, (0.5, 0.5))).collect()
}

/// Superpixel set: several locations in the pixels that an edge crosses.
fn superpixel() -> Vec<Place> {
    let crossed = |(x, y): (i32, i32)| (x + 2 * y - 10).abs() <= 1;
    let many = |pixel| scattered(9).map(move |place| in_pixel(pixel, place)).collect::<Vec<_>>();
    centres().flat_map(|pixel| if crossed(pixel) { many(pixel) } else { vec![in_pixel(pixel, (0.5, 0.5))] }).collect()
}

/// Number of cells along a panel's side in the offset set.
const CELLS: i32 = 18;

/// Offset set: locations that crowd around a focus, at most one in each cell of a grid.
fn offset() -> Vec<Place> {
    let focus = (0.6, 0.45);
    let crowded = (0..CELLS * CELLS).map(|index| {
        let place = |number: i32| (f64::from(number) + 0.5) / f64::from(CELLS);
        let (du, dv) = (place(index % CELLS) - focus.0, place(index / CELLS) - focus.1);
        // Outside of the focus, distances are stretched.
        let stretched = (du.hypot(dv) / 0.3).max(1.0).powf(1.6);
        (focus.0 + du * stretched, focus.1 + dv * stretched)
    });
    let mut taken = HashSet::new();
    let is_inside = |place: f64| (0.0..1.0).contains(&place);
    crowded.filter(|(u, v)| is_inside(*u) && is_inside(*v) && taken.insert(cell((*u, *v)))).collect()
}

/// Cell of the offset set's grid in which a place lies.
fn cell((u, v): Place) -> [i32; 2] {
    [u, v].map(|t| (t * f64::from(CELLS)) as i32)
}

#[test]
fn a_cell_of_the_offset_set_has_at_most_one_location() {
    let cells: Vec<_> = offset().into_iter().map(cell).collect();
    let different: HashSet<_> = cells.iter().collect();
    assert_eq!(different.len(), cells.len());
    assert!(cells.len() > 60, "{} locations", cells.len());
}

fn no_pattern() -> Vec<Place> {
    scattered(64).collect()
}

/// Rig: directions from a centre, seen by five pinholes; the faces of an unfolded cube.
fn rig() -> Vec<Place> {
    let third = 1.0 / 3.0;
    let faces = [(1, 0), (0, 1), (1, 1), (2, 1), (1, 2)];
    faces
        .iter()
        .flat_map(|(x, y)| {
            (0..16).map(move |index| {
                let (u, v) = (f64::from(index % 4) + 0.5, f64::from(index / 4) + 0.5);
                (third * (f64::from(*x) + u / 4.0), third * (f64::from(*y) + v / 4.0))
            })
        })
        .collect()
}

/// SVG of the five sets, side by side.
pub fn draw() -> String {
    let panels: [(&str, Vec<Place>); 5] = [
        ("planar", planar()),
        ("superpixel", superpixel()),
        ("offset", offset()),
        ("no pattern", no_pattern()),
        ("rig", rig()),
    ];
    let width = panels.len() as i32 * (SIDE + GAP) + GAP;
    let height = SIDE + NAME + 2 * GAP;
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, (width as u32, height as u32)).into_drawing_area();
        area.fill(&WHITE).unwrap();
        for (index, (name, places)) in panels.iter().enumerate() {
            let left = GAP + index as i32 * (SIDE + GAP);
            let lines = RGBColor(205, 205, 205);
            let cells = match *name {
                "rig" => 3,
                "offset" => CELLS,
                _ => PIXELS,
            };
            if *name != "no pattern" {
                for line in 0..=cells {
                    let at = SIDE * line / cells;
                    area.draw(&PathElement::new([(left + at, GAP), (left + at, GAP + SIDE)], lines)).unwrap();
                    area.draw(&PathElement::new([(left, GAP + at), (left + SIDE, GAP + at)], lines)).unwrap();
                }
            } else {
                area.draw(&Rectangle::new([(left, GAP), (left + SIDE, GAP + SIDE)], lines)).unwrap();
            }
            for (u, v) in places {
                let pixel = |t: f64| (t * f64::from(SIDE)).round() as i32;
                let dot = Circle::new((left + pixel(*u), GAP + pixel(*v)), 2, RGBColor(200, 70, 30).filled());
                area.draw(&dot).unwrap();
            }
            let font = ("sans-serif", 16).into_font();
            area.draw(&Text::new(*name, (left, GAP + SIDE + 8), font)).unwrap();
        }
        area.present().unwrap();
    }
    text
}

//! The text form of STL. Its words may have any case and stand in any lines.

use glam::DVec3;

use super::{
    polygon::Triangulator,
    shape::{Drawing, FileObject, linear, origin_of, plain},
    stl::CONTRARY,
    text::{BOM, Lines, broken, no_number, number, text},
};
use crate::scene::error::{Fault, Warnings};

/// A solid of a file.
#[derive(Default)]
struct Solid {
    name: Option<String>,
    corners: Vec<DVec3>,
    /// End of each facet among the corners.
    ends: Vec<usize>,
    /// Linear colour of each facet; `None` for none.
    colors: Vec<Option<[f32; 3]>>,
}

/// State of reading a file.
#[derive(Default)]
struct Reader {
    solids: Vec<Solid>,
    solid: Solid,
    normal: Option<DVec3>,
    /// Colour of the following facets of the solid.
    color: Option<[f32; 3]>,
    contrary: usize,
}

/// Reads the solids of a text file.
pub fn read(bytes: &[u8], warnings: &mut Warnings) -> Result<Drawing, Fault> {
    let mut reader = Reader::default();
    let mut bytes = bytes.strip_prefix(BOM).unwrap_or(bytes);
    // Programs that write blocks fill the last one with zeros.
    while let Some(rest) = bytes.strip_suffix(b"\0") {
        bytes = rest;
    }
    for (index, line) in Lines(bytes).enumerate() {
        reader.add(line, warnings).map_err(|reason| broken("STL", format!("line {}", index + 1), &reason))?;
    }
    let open = reader.open();
    if open > 0 {
        reader.solid.corners.truncate(reader.solid.corners.len() - open);
        let has_facets = reader.solids.iter().chain([&reader.solid]).any(|s| !s.ends.is_empty());
        let end = Lines(bytes).count();
        if !has_facets {
            return Err(broken("STL", format!("line {end}"), "it ends within its first facet"));
        }
        let reason = "the file ends within a facet, which is left out";
        warnings.push(&Fault::new(format!("line {end}"), reason));
    }
    reader.end_solid();
    if reader.solids.is_empty() {
        return Err(broken("STL", "line 1", "it has no facets"));
    }
    warnings.leave_out(CONTRARY, reader.contrary, "");
    draw(&reader.solids, warnings)
}

impl Reader {
    /// Number of corners of a facet that has not ended.
    fn open(&self) -> usize {
        self.solid.corners.len() - self.solid.ends.last().copied().unwrap_or_default()
    }

    /// Adds the words of a line. The error is a reason without the place.
    fn add(&mut self, line: &[u8], warnings: &mut Warnings) -> Result<(), String> {
        let mut rest = line;
        while let Some((word, after)) = next(rest) {
            rest = after;
            let is = |expected: &[u8]| word.eq_ignore_ascii_case(expected);
            if is(b"vertex") {
                let (corner, after) = vector(rest)?;
                self.solid.corners.push(corner);
                rest = after;
            } else if is(b"facet") || is(b"outer") || is(b"endloop") || is(b"end") {
                // Some programs leave out the words around the loop of a facet.
                self.end_facet();
            } else if is(b"normal") {
                // A normal that is not there, or no number, is as good as none.
                if let Ok((normal, after)) = vector(rest) {
                    self.normal = Some(normal);
                    rest = after;
                } else {
                    rest = before(rest, &[b"outer"]);
                }
            } else if is(b"endfacet") {
                self.end_facet();
                let following = before(rest, &[b"facet", b"end", b"endsolid"]);
                let behind = rest[..rest.len() - following.len()].trim_ascii();
                let count = usize::from(!behind.is_empty());
                warnings.leave_out("words behind endfacet", count, &text(behind));
                rest = following;
            } else if is(b"solid") {
                let name = rest;
                rest = before(rest, &[b"facet"]);
                let name = text(&name[..name.len() - rest.len()]);
                self.end_solid();
                self.solid.name = Some(name.trim().to_owned()).filter(|name| !name.is_empty());
            } else if is(b"endsolid") {
                self.end_facet();
                self.end_solid();
                rest = before(rest, &[b"solid", b"facet"]);
            } else if is(b"color") {
                // ANSA writes a colour before the facets of a solid.
                let (color, after) = vector(rest)?;
                self.color = Some(color.to_array().map(linear));
                rest = after;
            } else if !is(b"loop") {
                let shown = text(&word[..word.len().min(24)]);
                warnings.leave_out("words that are not of the format", 1, &shown);
            }
        }
        Ok(())
    }

    fn end_facet(&mut self) {
        let open = self.open();
        if open == 0 {
            return;
        }
        let normal = self.normal.take();
        let end = self.solid.corners.len();
        if let ([a, b, c, ..], Some(normal)) = (&self.solid.corners[end - open..], normal) {
            self.contrary += usize::from((*b - *a).cross(*c - *a).dot(normal) < 0.0);
        }
        self.solid.ends.push(end);
        self.solid.colors.push(self.color);
    }

    /// Ends a solid, unless it has no facets.
    fn end_solid(&mut self) {
        let solid = std::mem::take(&mut self.solid);
        self.color = None;
        if !solid.ends.is_empty() {
            self.solids.push(solid);
        }
    }
}

/// The first word of a line, and the rest.
fn next(line: &[u8]) -> Option<(&[u8], &[u8])> {
    let line = line.trim_ascii_start();
    let end = line.iter().position(u8::is_ascii_whitespace);
    let split = line.split_at(end.unwrap_or(line.len()));
    Some(split).filter(|(word, _)| !word.is_empty())
}

/// The three numbers at the beginning of a line, and the rest.
fn vector(line: &[u8]) -> Result<(DVec3, &[u8]), String> {
    let (mut vector, mut rest) = (DVec3::ZERO, line);
    for axis in 0..3 {
        let (word, after) = next(rest).ok_or("3 numbers are needed in a line")?;
        vector[axis] = number(word).ok_or_else(|| no_number(word))?;
        rest = after;
    }
    Ok((vector, rest))
}

/// The rest of a line from the first of the keywords on; empty if it has none.
fn before<'l>(line: &'l [u8], keywords: &[&[u8]]) -> &'l [u8] {
    let mut rest = line;
    while let Some((word, after)) = next(rest) {
        if keywords.iter().any(|keyword| word.eq_ignore_ascii_case(keyword)) {
            return rest;
        }
        rest = after;
    }
    &[]
}

fn draw(solids: &[Solid], warnings: &mut Warnings) -> Result<Drawing, Fault> {
    let corners = || solids.iter().flat_map(|solid| &solid.corners).copied();
    let origin = origin_of(corners());
    let mut material = plain();
    let has_colors = solids.iter().any(|s| s.colors.iter().any(Option::is_some));
    let grey = [material.base_color[0]; 3];
    if has_colors {
        material.base_color = [1.0; 4];
    }
    let mut drawing = Drawing { origin, materials: vec![material], ..Drawing::default() };
    let mut triangulator = Triangulator::default();
    for solid in solids {
        let local = |corner: &DVec3| (*corner - origin).as_vec3().to_array();
        let mut shape = FileObject {
            name: solid.name.clone(),
            positions: solid.corners.iter().map(local).collect(),
            ..FileObject::default()
        };
        triangulator.add_all(&solid.ends, None, &mut shape);
        if has_colors {
            for (&end, color) in solid.ends.iter().zip(&solid.colors) {
                let [r, g, b] = color.unwrap_or(grey);
                shape.colors.resize(end, [r, g, b, 1.0]);
            }
        }
        drawing.shapes.push(shape);
    }
    triangulator.report("facets", warnings)?;
    Ok(drawing)
}

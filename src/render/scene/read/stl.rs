//! STL: triangles, in binary or text form. Normals are not used, because they follow from the corners.

use super::{
    foreign,
    shape::{Drawing, FileObject, plain},
    stl_text,
    text::{BOM, broken, words},
};
use crate::scene::{
    error::{Fault, Warnings},
    read::shape::linear,
};
use glam::Vec3;

/// Numbers of bytes of the header, the count and one triangle of a binary file.
const HEADER: usize = 80;
const COUNT: usize = 4;
const TRIANGLE: usize = 50;

/// Whether `bytes` are an STL file by their content.
pub fn is_stl(bytes: &[u8]) -> bool {
    is_text(bytes) || is_exact(bytes) || is_plausible(bytes)
}

/// Whether a file that is in no other format is an STL file by its name.
pub fn is_named(bytes: &[u8], file: &str) -> bool {
    let is_stl = file.to_ascii_lowercase().ends_with(".stl");
    is_stl && !bytes.trim_ascii_start().starts_with(b"{") && foreign::hint(bytes).is_none()
}

/// Number of triangles that a binary file states.
fn stated(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER..HEADER + COUNT)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(count)).ok()
}

/// Whether the size of a file agrees with the number of triangles that it states as a binary file. The first word does
/// not tell, because many binary files also start with "solid".
fn is_exact(bytes: &[u8]) -> bool {
    stated(bytes).is_some_and(|count| bytes.len() == HEADER + COUNT + count * TRIANGLE)
}

/// Whether a binary file whose size does not agree holds triangles nevertheless: their normals have a length of 0 or 1.
/// Programs add bytes behind the triangles, or state no number.
fn is_plausible(bytes: &[u8]) -> bool {
    const TESTED: usize = 100;
    let Some(count) = stated(bytes).filter(|_| !is_exact(bytes)) else {
        return false;
    };
    let room = bytes.len() - HEADER - COUNT;
    let is_whole = if count == 0 { room.is_multiple_of(TRIANGLE) } else { count <= room / TRIANGLE };
    let tested = facets(bytes).take(TESTED);
    let is_normal = |facet: &[u8; TRIANGLE]| {
        let [normal, corners @ ..] = vectors(facet);
        let length = normal.length();
        let is_corner = |corner: &Vec3| corner.is_finite() && corner.abs().max_element() < 1e15;
        (length == 0.0 || (length - 1.0).abs() < 0.01) && corners.iter().all(is_corner)
    };
    let has_corners = |facet: &[u8; TRIANGLE]| vectors(facet)[1..].iter().any(|p| *p != Vec3::ZERO);
    is_whole && tested.clone().all(is_normal) && tested.clone().any(has_corners)
}

/// Whether a file is text: it begins with "solid", in any case, and has a facet or its corners.
fn is_text(bytes: &[u8]) -> bool {
    let is = |word: &[u8], expected: &[u8]| word.eq_ignore_ascii_case(expected);
    let mut words = words(bytes.strip_prefix(BOM).unwrap_or(bytes));
    words.next().is_some_and(|word| is(word, b"solid"))
        && words.take(1000).any(|word| is(word, b"facet") || is(word, b"vertex"))
        && !is_exact(bytes)
}

/// Complete triangles of a binary file.
fn facets(bytes: &[u8]) -> impl Iterator<Item = &[u8; TRIANGLE]> + Clone {
    bytes[HEADER + COUNT..].as_chunks().0.iter()
}

/// Normal and corners of a triangle.
fn vectors(facet: &[u8; TRIANGLE]) -> [Vec3; 4] {
    let (numbers, _): (&[[u8; 4]], _) = facet.as_chunks();
    let number = |index: usize| f32::from_le_bytes(numbers[index]);
    [0, 3, 6, 9].map(|at| Vec3::new(number(at), number(at + 1), number(at + 2)))
}

/// Reads an STL file.
pub fn read(bytes: &[u8], warnings: &mut Warnings) -> Result<Drawing, Fault> {
    if is_text(bytes) || stated(bytes).is_none() || !bytes.contains(&0) {
        stl_text::read(bytes, warnings)
    } else {
        read_binary(bytes, warnings)
    }
}

fn read_binary(bytes: &[u8], warnings: &mut Warnings) -> Result<Drawing, Fault> {
    let whole = (bytes.len() - HEADER - COUNT) / TRIANGLE;
    let stated = stated(bytes).unwrap_or_default();
    let count = if stated == 0 { whole } else { stated.min(whole) };
    if stated > 0 && whole == 0 {
        let reason = format!(
            "it has no text of the format, and as a binary file it states {stated} triangles and has {} bytes",
            bytes.len()
        );
        return Err(broken("STL", "triangles", &reason));
    }
    if count != stated {
        let reason = format!("the file states {stated} triangles, and the {count} that it has are read");
        warnings.push(&Fault::new("triangles", reason));
    }
    let rest = bytes.len() - HEADER - COUNT - count * TRIANGLE;
    warnings.leave_out("bytes behind the triangles", rest, "");

    let colors = FacetColors::new(&bytes[..HEADER]);
    if find(&bytes[..HEADER], b"MATERIAL=").is_some() {
        warnings.leave_out("materials of the header", 1, "MATERIAL");
    }
    let mut shape = FileObject::default();
    let mut contrary = 0;
    let mut unused = 0;
    let attributes = |facet: &[u8; TRIANGLE]| u16::from_le_bytes([facet[48], facet[49]]);
    let has_colors = facets(bytes).take(count).any(|r| colors.of(attributes(r)).is_some());
    shape.positions.reserve(3 * count);
    for facet in facets(bytes).take(count) {
        let [normal, a, b, c] = vectors(facet);
        contrary += usize::from((b - a).cross(c - a).dot(normal) < 0.0);
        shape.positions.extend([a, b, c].map(|corner| corner.to_array()));
        let attributes = attributes(facet);
        let color = colors.of(attributes);
        unused += usize::from(color.is_none() && attributes != 0);
        if has_colors {
            let [r, g, b] = color.unwrap_or([plain().base_color[0]; 3]);
            shape.colors.extend([[r, g, b, 1.0]; 3]);
        }
    }
    shape.triangles = separate(count);
    warnings.leave_out(CONTRARY, contrary, "");
    warnings.leave_out("attributes of triangles", unused, "");
    let mut material = plain();
    if has_colors {
        material.base_color = [1.0; 4];
    }
    Ok(Drawing { shapes: vec![shape], materials: vec![material], ..Drawing::default() })
}

/// What [`Warnings::leave_out`] calls normals that tell another side of a triangle than its corners.
pub const CONTRARY: &str = "normals that contradict the order of the corners";

/// Triangles with vertices of their own.
fn separate(count: usize) -> Vec<[u32; 3]> {
    (0..count as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect()
}

/// Colours in the attributes of triangles, of which there are two conventions.
struct FacetColors {
    /// Colour of triangles without their own: the header's, in files of Magics.
    header: Option<[f32; 3]>,
}

impl FacetColors {
    fn new(header: &[u8]) -> Self {
        let color = find(header, b"COLOR=").and_then(|at| header.get(at..at + 3));
        let linear = |code: &u8| linear(f64::from(*code) / 255.0);
        Self { header: color.map(|codes| [linear(&codes[0]), linear(&codes[1]), linear(&codes[2])]) }
    }

    /// Linear colour of a triangle. In files of Magics, the highest bit stands for the header's colour, and red has the
    /// lowest bits. In those of VisCAM, the highest bit stands for a colour, and blue has the lowest bits.
    fn of(&self, attributes: u16) -> Option<[f32; 3]> {
        let part = |shift: u32| linear(f64::from((attributes >> shift) & 31) / 31.0);
        match (self.header, attributes >> 15) {
            (Some(header), 1) => Some(header),
            (Some(_), _) => Some([part(0), part(5), part(10)]),
            (None, 1) => Some([part(10), part(5), part(0)]),
            (None, _) => None,
        }
    }
}

/// Index of the first byte behind `word`.
fn find(bytes: &[u8], word: &[u8]) -> Option<usize> {
    let at = bytes.windows(word.len()).position(|window| window == word);
    at.map(|at| at + word.len())
}

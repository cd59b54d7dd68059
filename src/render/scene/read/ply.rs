//! PLY: polygons, triangle strips and edges, with normals and colours of vertices. A file without polygons, strips and
//! edges shows its vertices as points.

use std::io::Cursor;

use glam::DVec3;
use ply_rs_bw::{
    parser::{Parser, Reader},
    ply::{ElementDef, Header, Property, PropertyAccess, PropertyAccessResult},
};

use super::shape::{Drawing, FileObject, linear, plain};
use crate::scene::{
    Loaded, SceneError,
    error::{Fault, Warnings},
};

/// Whether `bytes` are a PLY file.
pub fn is_ply(bytes: &[u8]) -> bool {
    bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r")
}

/// Reads a PLY file.
pub fn read(bytes: &[u8], file: &str) -> Result<Loaded, SceneError> {
    let mut warnings = Warnings::new(file);
    let drawing = decode(bytes, &mut warnings).map_err(|fault| fault.into_error(file))?;
    drawing.into_scene("PLY", file, warnings)
}

fn decode(bytes: &[u8], warnings: &mut Warnings) -> Result<Drawing, Fault> {
    let broken = |error: ply_rs_bw::parser::ParseError| {
        let place = error
            .line()
            .map_or("header".to_owned(), |line| format!("line {line}"));
        Fault::new(
            place,
            format!("the PLY file is broken: {error}; export it again"),
        )
    };
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = Parser::<PlyVertex>::new()
        .read_header(&mut reader)
        .map_err(broken)?;
    let (mut vertices, mut edges) = (Vec::new(), Vec::new());
    let (mut faces, mut strips) = (Vec::new(), Vec::new());
    for (name, element) in &header.elements {
        check(element, bytes.len())?;
        match name.as_str() {
            "vertex" => {
                vertices = elements::<PlyVertex>(&mut reader, element, &header).map_err(broken)?
            }
            "face" => faces = elements::<PlyFace>(&mut reader, element, &header).map_err(broken)?,
            "tristrips" => {
                strips = elements::<Strip>(&mut reader, element, &header).map_err(broken)?
            }
            "edge" => edges = elements::<PlyEdge>(&mut reader, element, &header).map_err(broken)?,
            _ => drop(elements::<SkippedElement>(&mut reader, element, &header).map_err(broken)?),
        }
    }
    let triangles = triangles(&faces, &strips, warnings);
    Ok(draw(&vertices, triangles, &edges, &header))
}

/// Fails if an element claims more entries than the file can hold, with at least a byte for each.
fn check(element: &ElementDef, bytes: usize) -> Result<(), Fault> {
    let ElementDef {
        name,
        count,
        properties,
        ..
    } = element;
    let place = format!("element {name}");
    if *count > 0 && properties.is_empty() {
        return Err(Fault::new(place, "has no properties"));
    }
    if *count > bytes {
        let reason = format!("claims {count} elements, but the file has {bytes} bytes");
        return Err(Fault::new(place, reason));
    }
    Ok(())
}

fn elements<E: PropertyAccess>(
    reader: &mut Reader<Cursor<&[u8]>>,
    element: &ElementDef,
    header: &Header,
) -> Result<Vec<E>, ply_rs_bw::parser::ParseError> {
    Parser::<E>::new().read_payload_for_element(reader, element, header)
}

/// Triangles of polygons, as fans, and of strips, in which every other triangle has two vertices exchanged.
fn triangles(faces: &[PlyFace], strips: &[Strip], warnings: &mut Warnings) -> Vec<[u32; 3]> {
    let (mut triangles, mut short) = (Vec::new(), 0);
    for PlyFace { indices } in faces {
        match indices.as_slice() {
            [first, rest @ ..] if rest.len() >= 2 => {
                triangles.extend(rest.windows(2).map(|edge| [*first, edge[0], edge[1]]));
            }
            _ => short += 1,
        }
    }
    if short > 0 {
        let reason =
            format!("{short} faces have a negative index or fewer than 3 and are left out");
        warnings.push(&Fault::new("element face", reason));
    }
    let strips = strips.iter().flat_map(|strip| &strip.parts);
    triangles.extend(strips.flat_map(|strip| {
        let corners = strip.as_slice().windows(3).enumerate();
        corners.map(|(i, c)| match i % 2 {
            0 => [c[0], c[1], c[2]],
            _ => [c[1], c[0], c[2]],
        })
    }));
    triangles
}

fn draw(
    vertices: &[PlyVertex],
    triangles: Vec<[u32; 3]>,
    edges: &[PlyEdge],
    header: &Header,
) -> Drawing {
    let has = |names: &[&str]| {
        let element = header.elements.get("vertex");
        let has = |name: &&str| element.is_some_and(|e| e.properties.contains_key(*name));
        names.iter().all(has)
    };
    let finite = |v: &&PlyVertex| v.position.is_finite();
    let origin = vertices
        .iter()
        .find(finite)
        .map_or(DVec3::ZERO, |v| v.position);
    // Vertices that are not connected are drawn as points.
    let is_cloud = triangles.is_empty() && edges.is_empty();
    let points = if is_cloud { vertices.len() as u32 } else { 0 };
    let stream = |present: bool| if present { vertices } else { &[] }.iter();
    let colored =
        has(&["red", "green", "blue"]) || has(&["diffuse_red", "diffuse_green", "diffuse_blue"]);
    let mut material = plain();
    if colored {
        material.base_color = [1.0; 4];
    }
    let shape = FileObject {
        triangles,
        lines: edges.iter().map(|edge| edge.ends).collect(),
        points: (0..points).collect(),
        positions: vertices
            .iter()
            .map(|v| (v.position - origin).as_vec3().to_array())
            .collect(),
        normals: stream(has(&["nx", "ny", "nz"])).map(|v| v.normal).collect(),
        colors: stream(colored).map(|v| v.color).collect(),
        ..FileObject::default()
    };
    Drawing {
        shapes: vec![shape],
        origin,
        materials: vec![material],
        ..Drawing::default()
    }
}

/// A vertex that is being read.
struct PlyVertex {
    position: DVec3,
    normal: [f32; 3],
    color: [f32; 4],
}

impl PropertyAccess for PlyVertex {
    fn new() -> Self {
        Self {
            position: DVec3::ZERO,
            normal: [0.0; 3],
            color: [1.0; 4],
        }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Some((value, most)) = number(&property) else {
            return PropertyAccessResult::Ignored;
        };
        match name {
            "x" => self.position.x = value,
            "y" => self.position.y = value,
            "z" => self.position.z = value,
            "nx" => self.normal[0] = value as f32,
            "ny" => self.normal[1] = value as f32,
            "nz" => self.normal[2] = value as f32,
            "red" | "diffuse_red" => self.color[0] = linear(value / most),
            "green" | "diffuse_green" => self.color[1] = linear(value / most),
            "blue" | "diffuse_blue" => self.color[2] = linear(value / most),
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

/// Value of a scalar, and the value that stands for 1 in a colour of this type.
fn number(property: &Property) -> Option<(f64, f64)> {
    Some(match *property {
        Property::Char(x) => (x.into(), 127.0),
        Property::UChar(x) => (x.into(), 255.0),
        Property::Short(x) => (x.into(), 32_767.0),
        Property::UShort(x) => (x.into(), 65_535.0),
        Property::Int(x) => (x.into(), 255.0),
        Property::UInt(x) => (x.into(), 255.0),
        Property::Float(x) => (x.into(), 1.0),
        Property::Double(x) => (x, 1.0),
        _ => return None,
    })
}

/// A polygon; empty if an index is negative.
#[derive(Default)]
struct PlyFace {
    indices: Vec<u32>,
}

impl PropertyAccess for PlyFace {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !is_indices(name) {
            return PropertyAccessResult::Ignored;
        }
        self.indices = property.to_u32_list().unwrap_or_default();
        PropertyAccessResult::Set
    }
}

/// Strips of triangles in one list; a negative index ends each strip.
#[derive(Default)]
struct Strip {
    parts: Vec<Vec<u32>>,
}

impl PropertyAccess for Strip {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let (true, Property::ListInt(indices)) = (is_indices(name), property) else {
            return PropertyAccessResult::Ignored;
        };
        let parts = indices.split(|index| *index < 0);
        let whole = |part: &[i32]| part.iter().map(|index| *index as u32).collect();
        self.parts = parts.map(whole).collect();
        PropertyAccessResult::Set
    }
}

/// Whether a list holds indices of vertices.
fn is_indices(name: &str) -> bool {
    matches!(name, "vertex_indices" | "vertex_index")
}

/// Line between two vertices. An index that is not a 32-bit whole number refers to no vertex.
struct PlyEdge {
    ends: [u32; 2],
}

impl PropertyAccess for PlyEdge {
    fn new() -> Self {
        Self {
            ends: [u32::MAX; 2],
        }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let end = match name {
            "vertex1" => 0,
            "vertex2" => 1,
            _ => return PropertyAccessResult::Ignored,
        };
        let value = number(&property).map_or(-1.0, |(value, _)| value);
        let is_index = value.fract() == 0.0 && (0.0..f64::from(u32::MAX)).contains(&value);
        self.ends[end] = if is_index { value as u32 } else { u32::MAX };
        PropertyAccessResult::Set
    }
}

/// An element that is not drawn.
struct SkippedElement;

impl PropertyAccess for SkippedElement {
    fn new() -> Self {
        Self
    }
}

//! STL: triangles, in binary or text form.

use std::io::Cursor;

use crate::scene::{
    Loaded, SceneError,
    error::{Fault, Warnings},
};

use super::shape::{Drawing, FileObject, plain};

/// Numbers of bytes of the header, the count and one triangle of a binary file.
const HEADER: usize = 80;
const COUNT: usize = 4;
const TRIANGLE: usize = 50;

/// First word of a text file.
const SOLID: &[u8] = b"solid";

/// Whether `bytes` are an STL file.
pub fn is_stl(bytes: &[u8]) -> bool {
    is_binary(bytes) || is_text(bytes)
}

/// Whether a file is binary: its size agrees with the number of triangles that it states. The first word does not
/// tell, because many binary files also start with "solid".
fn is_binary(bytes: &[u8]) -> bool {
    let count = bytes
        .get(HEADER..HEADER + COUNT)
        .and_then(|count| count.try_into().ok());
    count.is_some_and(|count| {
        let size = u32::from_le_bytes(count) as usize * TRIANGLE;
        bytes.len() == HEADER + COUNT + size
    })
}

fn is_text(bytes: &[u8]) -> bool {
    let mut words = bytes.split(u8::is_ascii_whitespace);
    words.next() == Some(SOLID) && words.take(1000).any(|word| word == b"facet")
}

/// Reads an STL file.
pub fn read(bytes: &[u8], file: &str) -> Result<Loaded, SceneError> {
    // The crate distinguishes the forms by the first word alone, and expects a blank after it.
    let mut bytes = bytes.to_vec();
    if is_binary(&bytes) {
        bytes[..HEADER].fill(0);
    } else if bytes.get(SOLID.len()) != Some(&b' ') {
        bytes.insert(SOLID.len(), b' ');
    }
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).map_err(|error| {
        let reason = format!("the STL file is broken: {error}; export it again");
        Fault::new("triangles", reason).into_error(file)
    })?;
    let shape = FileObject {
        triangles: mesh
            .faces
            .iter()
            .map(|face| face.vertices.map(|v| v as u32))
            .collect(),
        positions: mesh.vertices.iter().map(|vertex| vertex.0).collect(),
        ..FileObject::default()
    };
    let drawing = Drawing {
        shapes: vec![shape],
        materials: vec![plain()],
        ..Drawing::default()
    };
    drawing.into_scene("STL", file, Warnings::new(file))
}

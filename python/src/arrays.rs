//! A mesh of arrays as a .glb file, so that it takes the way of all scenes.

use crate::error;
use gpc::output::encode_rgba;
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use serde_json::{Value, json};

/// A mesh of arrays.
pub struct Mesh {
    /// Centre of the box around the vertices, which the positions are relative to, so that large coordinates lose nothing.
    origin: [f64; 3],
    positions: Vec<f32>,
    faces: Vec<u32>,
    pub normals: Option<Vec<f32>>,
    pub uvs: Option<Vec<f32>>,
    /// Four numbers a vertex.
    pub colors: Option<Vec<f32>>,
    pub texture: Option<([u32; 2], Vec<[u8; 4]>)>,
}

/// The numbers of an array of shape (rows, columns), rounded to doubles.
fn table(array: &Bound<'_, PyAny>, name: &str, columns: &[usize]) -> PyResult<(usize, usize, Vec<f64>)> {
    let numpy = array.py().import("numpy")?;
    let array = numpy.call_method1("ascontiguousarray", (array, "float64"))?;
    let array = array.cast::<PyArrayDyn<f64>>()?;
    let (rows, found) = match *array.shape() {
        [rows, found] if columns.contains(&found) => (rows, found),
        _ => {
            let columns: Vec<_> = columns.iter().map(ToString::to_string).collect();
            let (shape, columns) = (array.shape(), columns.join(" or "));
            return Err(error::usage(format!("{name} has the shape {shape:?}; it must be (N, {columns})")));
        }
    };
    let values = array.to_vec().map_err(error::usage)?;
    if let Some(at) = values.iter().position(|value| !value.is_finite()) {
        return Err(error::usage(format!("{name}: row {} has a number that is not finite", at / found)));
    }
    Ok((rows, found, values))
}

impl Mesh {
    /// Makes a mesh of vertices (N, 3) and faces (M, 3).
    pub fn new(vertices: &Bound<'_, PyAny>, faces: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (count, _, values) = table(vertices, "vertices", &[3])?;
        let (_, _, corners) = table(faces, "faces", &[3])?;
        if count == 0 || corners.is_empty() {
            return Err(error::usage("vertices and faces must not be empty"));
        }
        let index = |(at, &corner): (usize, &f64)| {
            if corner.fract() == 0.0 && corner >= 0.0 && corner < count as f64 {
                return Ok(corner as u32);
            }
            Err(error::usage(format!("face {} has vertex {corner}, and there are {count}", at / 3)))
        };
        let faces = corners.iter().enumerate().map(index).collect::<PyResult<_>>()?;
        let mut origin = [0.0; 3];
        for (axis, centre) in origin.iter_mut().enumerate() {
            let along = values.iter().skip(axis).step_by(3).copied();
            let (low, high) =
                along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
            *centre = 0.5 * low + 0.5 * high;
        }
        let positions = values.iter().enumerate().map(|(i, x)| (x - origin[i % 3]) as f32).collect();
        Ok(Self { origin, positions, faces, normals: None, uvs: None, colors: None, texture: None })
    }

    fn check_rows(&self, rows: usize, name: &str) -> PyResult<()> {
        let vertices = self.positions.len() / 3;
        if rows != vertices {
            return Err(error::usage(format!("{name} has {rows} rows, and there are {vertices} vertices")));
        }
        Ok(())
    }

    /// A stream of normals (N, 3) or texture coordinates (N, 2).
    pub fn stream(&self, array: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f32>> {
        let (rows, _, values) = table(array, name, &[if name == "uvs" { 2 } else { 3 }])?;
        self.check_rows(rows, name)?;
        Ok(values.into_iter().map(|x| x as f32).collect())
    }

    /// Colours (N, 3 or 4), as four numbers each.
    pub fn colors(&self, array: &Bound<'_, PyAny>) -> PyResult<Vec<f32>> {
        let (rows, channels, values) = table(array, "colors", &[3, 4])?;
        self.check_rows(rows, "colors")?;
        if values.iter().any(|value| !(0.0..=1.0).contains(value)) {
            return Err(error::usage(
                "colors: all numbers must be from 0 to 1; divide codes by 255 and decode sRGB first",
            ));
        }
        let rows = values.chunks_exact(channels);
        Ok(rows
            .flat_map(|row| [row[0], row[1], row[2], row.get(3).copied().unwrap_or(1.0)])
            .map(|x| x as f32)
            .collect())
    }

    /// The mesh as a .glb file with this material.
    pub fn into_glb(self, mut material: Value) -> PyResult<Vec<u8>> {
        let mut file = Builder::default();
        let mut attributes = json!({ "POSITION": file.floats(&self.positions, 3) });
        for (name, stream, columns) in
            [("NORMAL", &self.normals, 3), ("TEXCOORD_0", &self.uvs, 2), ("COLOR_0", &self.colors, 4)]
        {
            if let Some(stream) = stream {
                attributes[name] = file.floats(stream, columns);
            }
        }
        let corners: Vec<u8> = self.faces.iter().flat_map(|corner| corner.to_le_bytes()).collect();
        let view = file.view(&corners);
        let indices = file.accessor(
            json!({ "bufferView": view, "componentType": 5125, "count": self.faces.len(), "type": "SCALAR" }),
        );
        let mut images = Vec::new();
        if let Some((size, texels)) = &self.texture {
            if self.uvs.is_none() {
                return Err(error::usage("texture: it needs uvs"));
            }
            let png = encode_rgba(*size, texels).map_err(error::usage)?;
            images.push(json!({ "bufferView": file.view(&png), "mimeType": "image/png" }));
            material["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 0 });
        }
        let opacities = self.colors.iter().flatten().skip(3).step_by(4).map(|&alpha| f64::from(alpha));
        let factor = material["pbrMetallicRoughness"]["baseColorFactor"][3].as_f64();
        let texels = self.texture.iter().flat_map(|(_, texels)| texels).map(|texel| f64::from(texel[3]) / 255.0);
        if opacities.chain(factor).chain(texels).any(|alpha| alpha < 1.0) {
            material["alphaMode"] = json!("BLEND");
        }
        let document = json!({
            "asset": { "version": "2.0" },
            "extensionsUsed": ["KHR_materials_unlit"],
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0, "translation": self.origin }],
            "meshes": [{ "primitives": [{ "attributes": attributes, "indices": indices, "material": 0 }] }],
            "materials": [material],
            "textures": images.iter().map(|_| json!({ "source": 0 })).collect::<Vec<_>>(),
            "images": images,
            "buffers": [{ "byteLength": file.bytes.len() }],
            "bufferViews": file.views,
            "accessors": file.accessors,
        });
        Ok(glb(document, file.bytes))
    }
}

/// Buffer of a file, with its views and accessors.
#[derive(Default)]
struct Builder {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Builder {
    /// Appends bytes, and returns the index of their view.
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.len() - 1
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Appends vectors of `columns` floats, and returns the index of their accessor.
    fn floats(&mut self, values: &[f32], columns: usize) -> Value {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let view = self.view(&bytes);
        let extreme =
            |axis: usize, worse: fn(f32, f32) -> f32| values.iter().skip(axis).step_by(columns).copied().reduce(worse);
        let low: Vec<_> = (0..columns).map(|axis| extreme(axis, f32::min)).collect();
        let high: Vec<_> = (0..columns).map(|axis| extreme(axis, f32::max)).collect();
        let (count, kind) = (values.len() / columns, format!("VEC{columns}"));
        let accessor = json!({
            "bufferView": view, "componentType": 5126, "count": count, "type": kind, "min": low, "max": high,
        });
        self.accessor(accessor).into()
    }
}

/// A .glb file of a document and its buffer.
fn glb(document: Value, buffer: Vec<u8>) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + text.len() + 8 + buffer.len();
    let mut file = Vec::with_capacity(length);
    file.extend(b"glTF");
    file.extend([2, length as u32].map(u32::to_le_bytes).as_flattened());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &buffer)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

//! Small glTF files made in memory.

// Each test program uses only a part of this module.
#![allow(dead_code)]

use gpc::scene::{Loaded, Pose, PoseRequest, PosedGeometry, Scene, SceneError};
use serde_json::{Value, json};

/// A glTF file that is being built, with a single buffer, the GLB's.
pub struct Builder {
    pub json: Value,
    binary: Vec<u8>,
}

impl Builder {
    pub fn new() -> Self {
        Self {
            json: json!({
                "asset": {"version": "2.0"}, "buffers": [], "bufferViews": [], "accessors": [],
                "materials": [], "meshes": [], "nodes": [], "scenes": [], "animations": [],
            }),
            binary: Vec::new(),
        }
    }

    /// Appends a value to the array `key`; returns its index.
    pub fn push(&mut self, key: &str, value: Value) -> usize {
        if self.json[key].is_null() {
            self.json[key] = json!([]);
        }
        let array = self.json[key].as_array_mut().unwrap();
        array.push(value);
        array.len() - 1
    }

    /// Appends bytes as a buffer view, with further members.
    pub fn view(&mut self, bytes: &[u8], members: Value) -> usize {
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let mut view = json!({
            "buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len(),
        });
        self.binary.extend(bytes);
        merge(&mut view, members);
        self.push("bufferViews", view)
    }

    /// Adds an accessor of `kind` over these bytes, with further members.
    pub fn accessor(&mut self, kind: &str, component: u32, bytes: &[u8], members: Value) -> usize {
        let size = match component {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
            _ => 4,
        };
        let components = match kind {
            "SCALAR" => 1,
            "MAT4" => 16,
            vector => usize::from(vector.as_bytes()[3] - b'0'),
        };
        let view = self.view(bytes, json!({}));
        let mut accessor = json!({
            "bufferView": view, "type": kind, "componentType": component,
            "count": bytes.len() / (size * components),
        });
        merge(&mut accessor, members);
        self.push("accessors", accessor)
    }

    pub fn floats<const N: usize>(&mut self, values: &[[f32; N]]) -> usize {
        let kind = match N {
            1 => "SCALAR".to_owned(),
            16 => "MAT4".to_owned(),
            n => format!("VEC{n}"),
        };
        self.accessor(&kind, 5126, &le(values), json!({}))
    }

    pub fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        self.accessor("SCALAR", 5123, &bytes, json!({}))
    }

    /// Adds a mesh of one primitive, and a node that draws it, with further members.
    pub fn node_with(&mut self, primitive: Value, members: Value) -> usize {
        let mesh = self.push("meshes", json!({"primitives": [primitive]}));
        let mut node = json!({"mesh": mesh});
        merge(&mut node, members);
        self.push("nodes", node)
    }

    /// Adds the triangle (0,0,0), (1,0,0), (0,1,0) and a node that draws it, with further members.
    pub fn triangle(&mut self, node: Value) -> usize {
        let positions = self.floats(&TRIANGLE);
        self.node_with(json!({"attributes": {"POSITION": positions}}), node)
    }

    /// Adds a texture: a 1 x 1 PNG of one colour.
    pub fn texture(&mut self, rgb: [u8; 3]) -> usize {
        let view = self.view(&png(rgb), json!({}));
        let image = self.push("images", json!({"bufferView": view, "mimeType": "image/png"}));
        self.push("textures", json!({"source": image}))
    }

    /// Adds an image: a 1 x 1 PNG with alpha.
    pub fn rgba(&mut self, texel: [u8; 4]) -> usize {
        let png = png_of(&image::RgbaImage::from_pixel(1, 1, image::Rgba(texel)));
        let view = self.view(&png, json!({}));
        let image = json!({"bufferView": view, "mimeType": "image/png"});
        self.push("images", image)
    }

    /// Adds a texture: a checker of black and white texels.
    pub fn checker(&mut self, [width, height]: [u32; 2]) -> usize {
        let texel = |x: u32, y: u32| image::Luma([if (x + y).is_multiple_of(2) { 255 } else { 0 }]);
        let view = self.view(&png_of(&image::GrayImage::from_fn(width, height, texel)), json!({}));
        let image = json!({"bufferView": view, "mimeType": "image/png"});
        let image = self.push("images", image);
        self.push("textures", json!({"source": image}))
    }

    /// Adds an animation from time 0 to 1, with a channel for each pointer: its first and its last value.
    pub fn pointers(&mut self, pointers: &[(&str, Vec<f32>)]) {
        let input = self.floats(&[[0.0], [1.0]]);
        let (mut channels, mut samplers) = (Vec::new(), Vec::new());
        for (pointer, values) in pointers {
            channels.push(json!({"sampler": samplers.len(), "target": {
                "path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": pointer}},
            }}));
            let kind = match values.len() / 2 {
                1 => "SCALAR".to_owned(),
                n => format!("VEC{n}"),
            };
            let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
            let output = self.accessor(&kind, 5126, &bytes, json!({}));
            samplers.push(json!({"input": input, "output": output}));
        }
        let animation = json!({"channels": channels, "samplers": samplers});
        self.push("animations", animation);
    }

    pub fn glb(&self) -> Vec<u8> {
        let mut document = self.json.clone();
        document["buffers"] = json!([{"byteLength": self.binary.len()}]);
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut binary = self.binary.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let mut glb = b"glTF\x02\0\0\0".to_vec();
        glb.extend(((12 + 8 + text.len() + 8 + binary.len()) as u32).to_le_bytes());
        for (chunk, kind) in [(text, b"JSON"), (binary, b"BIN\0")] {
            glb.extend((chunk.len() as u32).to_le_bytes());
            glb.extend(kind);
            glb.extend(chunk);
        }
        glb
    }

    pub fn load(&self) -> Result<Loaded, SceneError> {
        Scene::from_slice(&self.glb(), "test.glb", None)
    }

    pub fn pose(&self) -> Pose {
        self.pose_at(&PoseRequest::default())
    }

    pub fn pose_at(&self, request: &PoseRequest) -> Pose {
        self.load().unwrap().scene.pose(request).unwrap()
    }
}

pub const TRIANGLE: [[f32; 3]; 3] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]];

/// Little-endian bytes of the values.
pub fn le<const N: usize>(values: &[[f32; N]]) -> Vec<u8> {
    let numbers = values.as_flattened().iter();
    numbers.flat_map(|x| x.to_le_bytes()).collect()
}

fn merge(object: &mut Value, members: Value) {
    for (key, value) in members.as_object().unwrap() {
        object[key] = value.clone();
    }
}

pub fn png(rgb: [u8; 3]) -> Vec<u8> {
    png_of(&image::RgbImage::from_pixel(1, 1, image::Rgb(rgb)))
}

fn png_of<P>(image: &image::ImageBuffer<P, Vec<u8>>) -> Vec<u8>
where
    P: image::PixelWithColorType<Subpixel = u8>,
{
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// World positions of the corners of triangle `t`.
pub fn corners(geometry: &PosedGeometry, t: usize) -> [[f64; 3]; 3] {
    geometry.triangles[t].map(|v| {
        let relative = geometry.positions[v as usize].map(f64::from);
        (glam::DVec3::from_array(relative) + geometry.origin).to_array()
    })
}

/// Asserts that all numbers agree to 1e-6.
#[track_caller]
pub fn assert_near(found: impl AsRef<[[f64; 3]]>, expected: impl AsRef<[[f64; 3]]>) {
    let (found, expected) = (found.as_ref(), expected.as_ref());
    let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-6;
    assert!(
        found.len() == expected.len() && found.as_flattened().iter().zip(expected.as_flattened()).all(near),
        "found {found:?}, expected {expected:?}"
    );
}

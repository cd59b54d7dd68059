//! Writes binary glTF (glTF 2.0, section 4).

use super::mesh::Mesh;
use glam::{DMat3, DQuat, DVec3};
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// Accessors of a mesh's triangles, which can be used with any material.
#[derive(Clone, Copy)]
pub struct Surface {
    positions: usize,
    normals: usize,
    uvs: Option<usize>,
    indices: usize,
}

/// Place of a node.
#[derive(Clone, Copy)]
pub struct Placement {
    pub translation: DVec3,
    pub rotation: DQuat,
    pub scale: DVec3,
}

impl Placement {
    /// Placement at a point, without rotation or scale.
    pub fn at(translation: DVec3) -> Self {
        Self { translation, rotation: DQuat::IDENTITY, scale: DVec3::ONE }
    }
}

/// A glTF file that is being built. Every method that adds something returns its index.
#[derive(Default)]
pub struct Builder {
    lists: Map<String, Value>,
    lights: Vec<Value>,
    variants: Vec<&'static str>,
    environment: Option<Value>,
    extensions: BTreeSet<String>,
    binary: Vec<u8>,
}

impl Builder {
    fn push(&mut self, list: &str, value: Value) -> usize {
        let entry = self.lists.entry(list).or_insert_with(|| json!([]));
        let items = entry.as_array_mut().expect("every list is an array");
        items.push(value);
        items.len() - 1
    }

    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        let offset = self.binary.len();
        self.binary.extend_from_slice(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.push("bufferViews", view)
    }

    fn floats<const N: usize>(&mut self, values: &[[f32; N]], bounds: bool) -> usize {
        let bytes: Vec<_> = values.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(ARRAY_BUFFER));
        let mut accessor = json!({
            "bufferView": view, "componentType": FLOAT, "count": values.len(), "type": format!("VEC{N}"),
        });
        if bounds {
            let fold = |pick: fn(f32, f32) -> f32| {
                let mut all = values[0];
                for value in values {
                    all = std::array::from_fn(|i| pick(all[i], value[i]));
                }
                all.to_vec()
            };
            accessor["min"] = json!(fold(f32::min));
            accessor["max"] = json!(fold(f32::max));
        }
        self.push("accessors", accessor)
    }

    fn indices(&mut self, indices: &[u32]) -> usize {
        // 65,535 is the primitive restart value, so that it can't be an index.
        let narrow = indices.iter().all(|&i| i < u32::from(u16::MAX));
        let (bytes, kind): (Vec<_>, _) = if narrow {
            let bytes = indices.iter().flat_map(|&i| (i as u16).to_le_bytes());
            (bytes.collect(), UNSIGNED_SHORT)
        } else {
            let bytes = indices.iter().flat_map(|i| i.to_le_bytes());
            (bytes.collect(), UNSIGNED_INT)
        };
        let view = self.view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        let count = indices.len();
        self.push("accessors", json!({ "bufferView": view, "componentType": kind, "count": count, "type": "SCALAR" }))
    }

    /// Stores the vertices and indices of a mesh.
    pub fn surface(&mut self, mesh: &Mesh) -> Surface {
        let narrow = |v: &DVec3| v.as_vec3().to_array();
        let positions: Vec<_> = mesh.positions.iter().map(narrow).collect();
        let normals: Vec<_> = mesh.normals.iter().map(narrow).collect();
        let uvs: Vec<_> = mesh.uvs.iter().map(|v| v.as_vec2().to_array()).collect();
        Surface {
            positions: self.floats(&positions, true),
            normals: self.floats(&normals, false),
            uvs: (!uvs.is_empty()).then(|| self.floats(&uvs, false)),
            indices: self.indices(&mesh.indices),
        }
    }

    /// A mesh of surfaces, each with its material.
    pub fn mesh(&mut self, parts: &[(Surface, usize)]) -> usize {
        let primitives: Vec<_> = parts
            .iter()
            .map(|(surface, material)| {
                let mut attributes = json!({ "POSITION": surface.positions, "NORMAL": surface.normals });
                if let Some(uvs) = surface.uvs {
                    attributes["TEXCOORD_0"] = json!(uvs);
                }
                json!({ "attributes": attributes, "indices": surface.indices, "material": material })
            })
            .collect();
        self.push("meshes", json!({ "primitives": primitives }))
    }

    /// A mesh of a surface with a material for each variant; the first one is also the default.
    pub fn mesh_of_variants(&mut self, surface: Surface, materials: &[(&'static str, usize)]) -> usize {
        const NAME: &str = "KHR_materials_variants";
        let mesh = self.mesh(&[(surface, materials[0].1)]);
        let mut mappings = Vec::new();
        for &(name, material) in materials {
            if !self.variants.contains(&name) {
                self.variants.push(name);
            }
            let variant = self.variants.iter().position(|known| *known == name);
            mappings.push(json!({ "material": material, "variants": [variant] }));
        }
        self.lists["meshes"][mesh]["primitives"][0]["extensions"] = json!({ NAME: { "mappings": mappings } });
        self.extensions.insert(NAME.to_owned());
        mesh
    }

    /// Adds a material, given as its glTF object.
    pub fn material(&mut self, material: Value) -> usize {
        let extensions = material.get("extensions").and_then(Value::as_object);
        self.extensions.extend(extensions.into_iter().flat_map(Map::keys).cloned());
        self.push("materials", material)
    }

    /// Adds an opaque dielectric material without textures; `color` is sRGB.
    pub fn paint(&mut self, name: &str, color: [u8; 3], roughness: f64) -> usize {
        let [r, g, b] = color.map(linear);
        self.material(json!({
            "name": name,
            "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": roughness,
            },
        }))
    }

    /// Adds an image, given as an encoded PNG.
    pub fn image(&mut self, png: &[u8]) -> usize {
        let view = self.view(png, None);
        self.push("images", json!({ "bufferView": view, "mimeType": "image/png" }))
    }

    /// Sets the environment, given as its object of `EXT_lights_image_based`.
    pub fn environment(&mut self, light: Value) {
        self.environment = Some(light);
    }

    /// Adds an animation of one second. Each pointer has values at the beginning, in the middle and at the end.
    pub fn animate(&mut self, name: &str, pointers: &[(String, [Vec<f32>; 3])]) {
        let times = self.keyframes(&[vec![0.0], vec![0.5], vec![1.0]]);
        let (mut channels, mut samplers) = (Vec::new(), Vec::new());
        for (pointer, values) in pointers {
            channels.push(json!({ "sampler": samplers.len(), "target": {
                "path": "pointer", "extensions": { "KHR_animation_pointer": { "pointer": pointer } },
            } }));
            let output = self.keyframes(values);
            samplers.push(json!({ "input": times, "output": output }));
        }
        self.extensions.insert("KHR_animation_pointer".to_owned());
        self.push("animations", json!({ "name": name, "channels": channels, "samplers": samplers }));
    }

    /// Adds an accessor with values for each of three keyframes.
    fn keyframes(&mut self, values: &[Vec<f32>; 3]) -> usize {
        let bytes: Vec<_> = values.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
        let view = self.view(&bytes, None);
        let kind = match values[0].len() {
            1 => "SCALAR".to_owned(),
            n => format!("VEC{n}"),
        };
        let mut accessor = json!({
            "bufferView": view, "componentType": FLOAT, "count": values.len(), "type": kind,
        });
        if kind == "SCALAR" {
            let numbers = values.iter().flatten().copied();
            accessor["min"] = json!([numbers.clone().fold(f32::MAX, f32::min)]);
            accessor["max"] = json!([numbers.fold(f32::MIN, f32::max)]);
        }
        self.push("accessors", accessor)
    }

    /// Adds a texture, given as an encoded PNG: trilinear, and repeating if `repeat` is set, otherwise clamped.
    pub fn texture(&mut self, png: &[u8], repeat: bool) -> usize {
        let image = self.image(png);
        let wrap = if repeat { 10497 } else { 33071 };
        let sampler =
            self.push("samplers", json!({ "magFilter": 9729, "minFilter": 9987, "wrapS": wrap, "wrapT": wrap }));
        self.push("textures", json!({ "source": image, "sampler": sampler }))
    }

    /// Adds a node with a mesh to the scene.
    pub fn place(&mut self, mesh: usize, placement: Placement) {
        let mut node = json!({ "mesh": mesh });
        if placement.translation != DVec3::ZERO {
            node["translation"] = narrow(&placement.translation.to_array());
        }
        if placement.rotation != DQuat::IDENTITY {
            node["rotation"] = narrow(&placement.rotation.to_array());
        }
        if placement.scale != DVec3::ONE {
            node["scale"] = narrow(&placement.scale.to_array());
        }
        self.push("nodes", node);
    }

    /// Hides the last node.
    pub fn hide(&mut self) {
        const NAME: &str = "KHR_node_visibility";
        let nodes = self.lists["nodes"].as_array_mut();
        let last = nodes.and_then(|nodes| nodes.last_mut());
        last.expect("something was placed")["extensions"] = json!({ NAME: { "visible": false } });
        self.extensions.insert(NAME.to_owned());
    }

    fn camera(&mut self, name: &str, eye: DVec3, target: DVec3, camera: Value) {
        let camera = self.push("cameras", camera);
        self.push(
            "nodes",
            json!({
                "name": name, "camera": camera,
                "translation": narrow(&eye.to_array()), "rotation": narrow(&look(target - eye).to_array()),
            }),
        );
    }

    /// Adds a perspective camera with an infinite far plane; `fov` is its vertical field of view in degrees.
    pub fn perspective(&mut self, name: &str, eye: DVec3, target: DVec3, fov: f64) {
        let yfov = narrow(&[fov.to_radians()])[0].clone();
        self.camera(
            name,
            eye,
            target,
            json!({ "type": "perspective", "perspective": { "yfov": yfov, "znear": 0.05 } }),
        );
    }

    /// Adds an orthographic camera that sees `height` in an image of 16:9.
    pub fn orthographic(&mut self, name: &str, eye: DVec3, target: DVec3, height: f64) {
        let ymag = height / 2.0;
        self.camera(
            name,
            eye,
            target,
            json!({ "type": "orthographic", "orthographic": {
                "xmag": ymag * 16.0 / 9.0, "ymag": ymag, "znear": 0.05, "zfar": 100.0,
            } }),
        );
    }

    /// Adds a directional light along `direction`; intensity in lux.
    pub fn sun(&mut self, name: &str, direction: DVec3, color: [f64; 3], intensity: f64) {
        self.lights.push(json!({
            "name": name, "type": "directional", "color": narrow(&color), "intensity": intensity,
        }));
        let light = self.lights.len() - 1;
        self.push(
            "nodes",
            json!({
                "name": name, "rotation": narrow(&look(direction).to_array()),
                "extensions": { "KHR_lights_punctual": { "light": light } },
            }),
        );
    }

    /// Adds late-morning light: a warm sun over the right shoulder, and cool light from the sky and the ground.
    pub fn daylight(&mut self) {
        self.sun("sun", DVec3::new(-0.55, -0.75, -0.5), [1.0, 0.94, 0.84], 3.1);
        self.sun("sky", DVec3::new(0.5, -0.8, 0.3), [0.72, 0.84, 1.0], 1.15);
        self.sun("bounce", DVec3::new(0.3, 0.5, -0.8), [1.0, 0.96, 0.9], 0.6);
    }

    /// The file's bytes.
    pub fn finish(mut self, title: &str) -> Vec<u8> {
        let nodes = self.lists.get("nodes").and_then(Value::as_array);
        let roots: Vec<_> = (0..nodes.map_or(0, Vec::len)).collect();
        let document = &mut self.lists;
        document.insert(
            "asset".into(),
            json!({ "version": "2.0", "generator": "gpc generate_assets", "extras": { "title": title } }),
        );
        document.insert("scene".into(), json!(0));
        let mut scene = json!({ "name": title, "nodes": roots });
        let mut extensions = Map::new();
        if let Some(environment) = self.environment {
            const NAME: &str = "EXT_lights_image_based";
            scene["extensions"] = json!({ NAME: { "light": 0 } });
            extensions.insert(NAME.into(), json!({ "lights": [environment] }));
            self.extensions.insert(NAME.to_owned());
        }
        document.insert("scenes".into(), json!([scene]));
        document.insert("buffers".into(), json!([{ "byteLength": self.binary.len() }]));
        if !self.lights.is_empty() {
            self.extensions.insert("KHR_lights_punctual".to_owned());
            extensions.insert("KHR_lights_punctual".into(), json!({ "lights": self.lights }));
        }
        if !self.variants.is_empty() {
            let variants: Vec<_> = self.variants.iter().map(|name| json!({ "name": name })).collect();
            extensions.insert("KHR_materials_variants".into(), json!({ "variants": variants }));
        }
        if !extensions.is_empty() {
            document.insert("extensions".into(), extensions.into());
        }
        if !self.extensions.is_empty() {
            document.insert("extensionsUsed".into(), json!(self.extensions));
        }
        let mut text = Value::Object(self.lists).to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut file = Vec::with_capacity(28 + text.len() + self.binary.len());
        let word = |file: &mut Vec<u8>, value: usize| {
            file.extend((value as u32).to_le_bytes());
        };
        file.extend(b"glTF");
        word(&mut file, 2);
        word(&mut file, 28 + text.len() + self.binary.len());
        word(&mut file, text.len());
        file.extend(b"JSON");
        file.extend(text);
        word(&mut file, self.binary.len());
        file.extend(b"BIN\0");
        file.extend(self.binary);
        file
    }
}

/// Numbers rounded to seven decimals, about the precision of an f32.
fn narrow(values: &[f64]) -> Value {
    let round = |v: &f64| (v * 1e7).round() / 1e7 + 0.0;
    json!(values.iter().map(round).collect::<Vec<_>>())
}

/// Rotation that turns a node's -z axis to `direction`, with its y axis upwards.
fn look(direction: DVec3) -> DQuat {
    let back = -direction.normalize();
    let helper = if back.y.abs() > 0.999 { DVec3::X } else { DVec3::Y };
    let right = helper.cross(back).normalize();
    DQuat::from_mat3(&DMat3::from_cols(right, back.cross(right), back))
}

/// Linear value of an sRGB code (IEC 61966-2-1), rounded to three digits, which is finer than a byte needs.
pub fn linear(value: u8) -> f64 {
    let v = f64::from(value) / 255.0;
    let linear = if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) };
    (linear * 1000.0).round() / 1000.0
}

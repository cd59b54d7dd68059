//! PLY: polygons, triangle strips and edges, with normals, colours and textures. A file without polygons, strips and
//! edges shows its vertices as points.

use std::{collections::BTreeMap, path::Path};

use glam::DVec3;

use super::{
    ply_data::{Data, Element, Row},
    polygon::Triangulator,
    shape::{Drawing, FileObject, linear, origin_of, plain, scale_of_codes},
    text::BOM,
    texture_file::{NamedTextures, TextureFiles},
};
use crate::scene::{
    error::{Fault, Warnings},
    material::{AlphaMode, Material, TextureTransform, TextureUse},
};

/// Whether `bytes` are a PLY file.
pub fn is_ply(bytes: &[u8]) -> bool {
    let start = from_start(bytes);
    start.starts_with(b"ply\n") || start.starts_with(b"ply\r")
}

/// A file without the byte-order mark and the blank lines that some programs write before it.
fn from_start(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(BOM).unwrap_or(bytes).trim_ascii_start()
}

/// Reads a PLY file; images that it names are in the folder `base`.
pub fn read(bytes: &[u8], base: Option<&Path>, warnings: &mut Warnings) -> Result<Drawing, Fault> {
    decode(from_start(bytes), warnings)?.draw(base, warnings)
}

/// Contents of a file.
#[derive(Default)]
struct Decoded {
    positions: Vec<DVec3>,
    normals: Vec<[f32; 3]>,
    /// Codes of colours and alpha; empty if vertices have neither.
    codes: Vec<[f32; 4]>,
    /// Whether the codes of vertices are colours, and not alpha alone.
    is_colored: bool,
    uvs: Vec<[f32; 2]>,
    faces: Faces,
    strips: Vec<Vec<u32>>,
    edges: Vec<[u32; 2]>,
    textures: Vec<String>,
}

/// Polygons.
#[derive(Default)]
struct Faces {
    corners: Vec<u32>,
    /// End of each polygon among the corners.
    ends: Vec<usize>,
    /// Codes of colours and alpha; empty if faces have no colours.
    codes: Vec<[f32; 4]>,
    /// Texture coordinates of each corner; empty if the file has none of corners.
    uvs: Vec<[f32; 2]>,
    /// Number of each polygon's texture; empty if the file does not state it.
    textures: Vec<f64>,
}

/// Index of no vertex.
const NONE: u32 = u32::MAX;

/// Names of properties that hold a position, a normal, a colour and texture coordinates.
const POSITION: [&[&str]; 3] = [&["x"], &["y"], &["z"]];
const NORMAL: [&[&str]; 3] = [&["nx", "normal_x"], &["ny", "normal_y"], &["nz", "normal_z"]];
const COLOR: [&[&str]; 3] =
    [&["red", "diffuse_red", "r"], &["green", "diffuse_green", "g"], &["blue", "diffuse_blue", "b"]];
const ALPHA: &[&str] = &["alpha", "diffuse_alpha", "a"];
const UV: [&[&str]; 2] =
    [&["s", "u", "texture_u", "texture_s", "tex_u"], &["t", "v", "texture_v", "texture_t", "tex_v"]];
const INDICES: &[&str] = &["vertex_indices", "vertex_index"];

fn decode(bytes: &[u8], warnings: &mut Warnings) -> Result<Decoded, Fault> {
    let mut data = Data::new(bytes, warnings)?;
    let mut decoded = Decoded { textures: std::mem::take(&mut data.textures), ..Decoded::default() };
    for index in 0..data.elements.len() {
        match data.elements[index].name.as_str() {
            "vertex" => decoded.read_vertices(&mut data, index, warnings)?,
            "face" => decoded.faces.read(&mut data, index, warnings)?,
            "tristrips" => {
                let element = &data.elements[index];
                let indices = element.list(INDICES);
                name_unused(element, [indices], warnings);
                data.read(index, |row| {
                    let vertices: Vec<u32> = row.list(indices).iter().map(vertex).collect();
                    decoded.strips.extend(vertices.split(|v| *v == NONE).map(<[u32]>::to_vec));
                })?;
            }
            "edge" => {
                let element = &data.elements[index];
                let ends = [element.number(&["vertex1"]), element.number(&["vertex2"])];
                name_unused(element, ends, warnings);
                data.read(index, |row| {
                    let end = |property: Option<usize>| row.list(property).first().map_or(NONE, vertex);
                    decoded.edges.push(ends.map(end));
                })?;
            }
            name => {
                warnings.leave_out("elements", data.elements[index].count, name);
                data.read(index, |_| {})?;
            }
        }
    }
    warnings.leave_out("bytes behind the elements", data.rest(), "");
    Ok(decoded)
}

/// Counts the properties of an element that are not among those that are used.
fn name_unused(element: &Element, used: impl IntoIterator<Item = Option<usize>>, warnings: &mut Warnings) {
    if element.count == 0 {
        return;
    }
    let used: Vec<usize> = used.into_iter().flatten().collect();
    let kind = format!("properties of the element {}", element.name);
    for (index, property) in element.properties.iter().enumerate() {
        warnings.leave_out(&kind, usize::from(!used.contains(&index)), &property.name);
    }
}

/// Index of a vertex; [`NONE`] for a value that is none.
fn vertex(value: &f64) -> u32 {
    // The conversion gives the nearest index for a value that is none.
    let index = *value as u32;
    if f64::from(index) == *value { index } else { NONE }
}

/// Properties that hold the parts of a vector, if all are there.
fn numbers<const N: usize>(element: &Element, names: [&[&str]; N]) -> Option<[usize; N]> {
    let found = names.map(|names| element.number(names));
    found.iter().all(Option::is_some).then(|| found.map(Option::unwrap_or_default))
}

/// Codes of colours and alpha in properties.
struct Codes {
    color: Option<[usize; 3]>,
    alpha: Option<usize>,
    /// What each code is divided by.
    full: [f64; 4],
}

impl Codes {
    fn new(element: &Element) -> Self {
        let (color, alpha) = (numbers(element, COLOR), element.number(ALPHA));
        let full = |property: Option<usize>| property.map_or(1.0, |property| element.properties[property].kind.full());
        let [r, g, b] = color.map_or([None; 3], |color| color.map(Some));
        Self { color, alpha, full: [r, g, b, alpha].map(full) }
    }

    fn is_there(&self) -> bool {
        self.color.is_some() || self.alpha.is_some()
    }

    fn used(&self) -> impl Iterator<Item = Option<usize>> {
        let color = self.color.into_iter().flatten().map(Some);
        color.chain([self.alpha])
    }

    /// Codes of an element; NaN for those that are not there, which stands for 1.
    fn read(&self, row: &Row) -> [f32; 4] {
        let [r, g, b] = self.color.map_or([None; 3], |color| color.map(Some));
        let properties = [r, g, b, self.alpha];
        std::array::from_fn(|i| {
            let code = properties[i].map_or(f64::NAN, |p| row.number(p) / self.full[i]);
            code as f32
        })
    }
}

/// Linear colours and alpha.
fn colors(codes: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let largest = codes.as_flattened().iter().fold(0.0, |a, &b| f32::max(a, b));
    let scale = scale_of_codes(largest);
    let color = |[r, g, b, a]: &[f32; 4]| {
        let [r, g, b] = [r, g, b].map(|code| linear(f64::from(code / scale)));
        let alpha = if a.is_nan() { 1.0 } else { a.clamp(0.0, scale) / scale };
        [r, g, b, alpha]
    };
    codes.iter().map(color).collect()
}

impl Decoded {
    fn read_vertices(&mut self, data: &mut Data<'_>, index: usize, warnings: &mut Warnings) -> Result<(), Fault> {
        let element = &data.elements[index];
        let axes = POSITION.map(|names| element.number(names));
        let normal = numbers(element, NORMAL);
        let uv = numbers(element, UV);
        let codes = Codes::new(element);
        let used = axes.into_iter().chain(codes.used());
        let used = used.chain(normal.into_iter().flatten().map(Some));
        name_unused(element, used.chain(uv.into_iter().flatten().map(Some)), warnings);
        self.is_colored = codes.color.is_some();
        data.read(index, |row| {
            let at = axes.map(|axis| axis.map_or(0.0, |axis| row.number(axis)));
            self.positions.push(DVec3::from_array(at));
            let vector = |property: usize| row.number(property) as f32;
            self.normals.extend(normal.map(|normal| normal.map(vector)));
            self.uvs.extend(uv.map(|uv| uv.map(vector)));
            if codes.is_there() {
                self.codes.push(codes.read(row));
            }
        })
    }

    fn draw(mut self, base: Option<&Path>, warnings: &mut Warnings) -> Result<Drawing, Fault> {
        let used = self.faces.corners.iter().chain(self.strips.iter().flatten());
        let used = used.chain(self.edges.as_flattened());
        // Vertices that are not connected are drawn as points.
        let is_cloud = self.faces.ends.is_empty() && self.strips.is_empty() && self.edges.is_empty();
        let all = if is_cloud { &self.positions[..] } else { &[] };
        let position = |vertex: &u32| self.positions.get(*vertex as usize);
        let origin = origin_of(used.filter_map(position).chain(all).copied());
        let mut textures = NamedTextures::new(base);
        let mut looks = Looks::new(&self.textures, &mut textures, warnings);

        let points = if is_cloud { self.positions.len() as u32 } else { 0 };
        let vertices = FileObject {
            points: (0..points).collect(),
            lines: self.edges.clone(),
            positions: self.positions.iter().map(|p| (*p - origin).as_vec3().to_array()).collect(),
            normals: std::mem::take(&mut self.normals),
            uvs: std::mem::take(&mut self.uvs),
            colors: colors(&self.codes),
            ..FileObject::default()
        };
        let mut shapes = Vec::new();
        let mut triangulator = Triangulator::default();
        let faces = &self.faces;
        let mut whole = vertices;
        for strip in &self.strips {
            let corners = strip.as_slice().windows(3).enumerate();
            whole.triangles.extend(corners.map(|(i, c)| match i % 2 {
                0 => [c[0], c[1], c[2]],
                _ => [c[1], c[0], c[2]],
            }));
        }
        if faces.is_apart() {
            if !faces.codes.is_empty() && self.is_colored {
                warnings.leave_out("colours of vertices beside colours of faces", whole.colors.len(), "");
            }
            let apart = faces.apart(&whole, self.textures.len());
            shapes.extend(apart.into_iter().map(|(texture, mut shape, ends)| {
                triangulator.add_all(&ends, None, &mut shape);
                let is_colored = !faces.codes.is_empty() || self.is_colored;
                (texture, is_colored, shape)
            }));
        } else {
            triangulator.add_all(&faces.ends, Some(&faces.corners), &mut whole);
        }
        if shapes.is_empty() || !whole.triangles.is_empty() || !whole.lines.is_empty() {
            shapes.insert(0, (0, self.is_colored, whole));
        }
        triangulator.report("element face", warnings)?;
        let shapes: Vec<FileObject> = shapes
            .into_iter()
            .map(|(texture, is_colored, shape)| looks.dress(shape, texture, is_colored, warnings))
            .collect();
        let materials = looks.materials;
        let (textures, images) = textures.into_parts();
        Ok(Drawing { shapes, origin, materials, textures, images })
    }
}

impl Faces {
    fn read(&mut self, data: &mut Data<'_>, index: usize, warnings: &mut Warnings) -> Result<(), Fault> {
        let element = &data.elements[index];
        let indices = element.list(INDICES);
        let uvs = element.list(&["texcoord", "t"]);
        let texture = element.number(&["texnumber"]);
        let codes = Codes::new(element);
        let used = codes.used().chain([indices, uvs, texture]);
        name_unused(element, used, warnings);
        let mut unfit = 0;
        data.read(index, |row| {
            let corners = row.list(indices);
            self.corners.extend(corners.iter().map(vertex));
            self.ends.push(self.corners.len());
            if codes.is_there() {
                self.codes.push(codes.read(row));
            }
            if uvs.is_some() {
                let (found, rest) = row.list(uvs).as_chunks::<2>();
                let is_fit = found.len() == corners.len() && rest.is_empty();
                unfit += usize::from(!is_fit);
                let found = found.iter().map(|uv| uv.map(|x| x as f32));
                let found = found.chain(std::iter::repeat([0.0; 2]));
                self.uvs.extend(found.take(corners.len()));
            }
            self.textures.extend(texture.map(|texture| row.number(texture)));
        })?;
        if unfit > 0 {
            let reason = format!("{unfit} faces have other numbers of texture coordinates than of corners");
            warnings.push(&Fault::new("element face", reason));
        }
        Ok(())
    }

    /// Whether faces have properties that vertices can't hold for all their faces.
    fn is_apart(&self) -> bool {
        !self.codes.is_empty() || !self.uvs.is_empty() || !self.textures.is_empty()
    }

    /// Shapes with vertices of their own for each corner, by texture, and the ends of their polygons. `vertices` has the
    /// vertices of the file, and `textures` is the number of textures.
    fn apart(&self, vertices: &FileObject, textures: usize) -> Vec<(usize, FileObject, Vec<usize>)> {
        let colors = colors(&self.codes);
        let mut shapes: BTreeMap<usize, (FileObject, Vec<usize>)> = BTreeMap::new();
        let mut start = 0;
        for (face, &end) in self.ends.iter().enumerate() {
            let number = self.textures.get(face).copied().unwrap_or_default();
            let is_texture = number >= 0.0 && number < textures as f64;
            // A number of no texture stands for no texture.
            let number = if is_texture { number as usize } else { textures };
            let (shape, ends) = shapes.entry(number).or_default();
            for corner in start..end {
                let vertex = self.corners[corner] as usize;
                let position = vertices.positions.get(vertex);
                shape.positions.push(position.copied().unwrap_or([f32::NAN; 3]));
                let normal = vertices.normals.get(vertex);
                if !vertices.normals.is_empty() {
                    shape.normals.push(normal.copied().unwrap_or_default());
                }
                let uv = self.uvs.get(corner).or_else(|| vertices.uvs.get(vertex));
                shape.uvs.extend(uv);
                let color = colors.get(face).or_else(|| vertices.colors.get(vertex));
                shape.colors.extend(color);
            }
            ends.push(shape.positions.len());
            start = end;
        }
        let shapes = shapes.into_iter();
        shapes.map(|(number, (shape, ends))| (number, shape, ends)).collect()
    }
}

/// Materials of a file: one for each of its textures, and for shapes with colours.
struct Looks {
    /// Indices of textures.
    textures: Vec<Option<u32>>,
    materials: Vec<Material>,
}

impl Looks {
    fn new(files: &[String], textures: &mut NamedTextures<'_>, warnings: &mut Warnings) -> Self {
        let mut read = |file: &String| {
            let files = TextureFiles { folder: String::new(), color: Some(file.clone()), alpha: None };
            let texture = textures.get(files);
            let texture = texture.map_err(|fault| fault.report("comment TextureFile", warnings));
            texture.ok()
        };
        Self { textures: files.iter().map(&mut read).collect(), materials: Vec::new() }
    }

    /// Gives a shape its material. A texture replaces colours, which programs write besides as an approximation of it.
    fn dress(
        &mut self,
        mut shape: FileObject,
        texture: usize,
        is_colored: bool,
        warnings: &mut Warnings,
    ) -> FileObject {
        let texture = self.textures.get(texture).copied().flatten();
        let texture = texture.filter(|_| !shape.uvs.is_empty());
        if texture.is_none() && !shape.uvs.is_empty() {
            warnings.leave_out("texture coordinates without a texture", shape.uvs.len(), "");
        }
        if texture.is_some() && is_colored {
            warnings.leave_out("colours beneath a texture", shape.colors.len(), "");
            shape.colors.iter_mut().for_each(|color| *color = [1.0, 1.0, 1.0, color[3]]);
        }
        let mut material = plain();
        if is_colored || texture.is_some() {
            material.base_color = [1.0; 4];
        }
        if shape.colors.iter().any(|color| color[3] < 1.0) {
            material.alpha_mode = AlphaMode::Blend;
        }
        material.base_color_texture =
            texture.map(|texture| TextureUse { texture, uv_set: 0, transform: TextureTransform::default() });
        let known = self.materials.iter().position(|other| *other == material);
        shape.material = known.unwrap_or_else(|| {
            self.materials.push(material);
            self.materials.len() - 1
        });
        shape
    }
}

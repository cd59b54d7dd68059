//! Scenes of formats with triangles, lines, points and colours, but without nodes, cameras and lights.

use gltf::json::{self, Index, mesh::Mode};

use super::{limits::Budget, mesh::unlit_materials};
use crate::scene::{
    Loaded, Scene,
    document::{Document, Node, Parts, Primitive, Transform},
    error::{Fault, Warnings},
    material::{Image, Material, Texture},
    surface::{
        normals::{is_usable, mend_normals, turn_to_normals},
        strokes, triangles,
    },
};
use glam::DVec3;
use std::sync::Arc;

/// Object of a file. Streams other than the positions are empty or as long as the positions.
#[derive(Debug, Default)]
pub struct FileObject {
    pub name: Option<String>,
    /// Index into the materials of the [`Drawing`]; an index past the end stands for glTF's default.
    pub material: usize,
    pub triangles: Vec<[u32; 3]>,
    pub lines: Vec<[u32; 2]>,
    pub points: Vec<u32>,
    pub positions: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates; v points up, as in OBJ and PLY.
    pub uvs: Vec<[f32; 2]>,
    /// Linear colours.
    pub colors: Vec<[f32; 4]>,
}

/// Contents of a file.
#[derive(Debug, Default)]
pub struct Drawing {
    pub shapes: Vec<FileObject>,
    /// Origin to which the positions of all shapes are relative.
    pub origin: DVec3,
    pub materials: Vec<Material>,
    pub textures: Vec<Texture>,
    pub images: Vec<Image>,
}

/// Material for files that name none: grey, matt and double-sided, because not every program writes consistent
/// windings.
pub fn plain() -> Material {
    Material { base_color: [0.8, 0.8, 0.8, 1.0], metallic: 0.0, double_sided: true, ..Material::default() }
}

/// What the numbers of colours are divided by, by the largest of them: some programs write bytes as numbers with a
/// fraction. Colours brighter than white stay below the limit.
pub fn scale_of_codes(largest: f32) -> f32 {
    if largest > 16.0 { 255.0 } else { 1.0 }
}

/// Linear value of an sRGB code of 0 to 1; 1 for NaN.
pub fn linear(code: f64) -> f32 {
    let code = if code.is_nan() { 1.0 } else { code.clamp(0.0, 1.0) };
    let linear = if code <= 0.040_45 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) };
    linear as f32
}

/// Origin for positions in single precision: zero, unless the positions are far from zero for their extent, as those of
/// surveys are; then the first of them.
pub fn origin_of(positions: impl Iterator<Item = DVec3>) -> DVec3 {
    /// Distance from zero, in extents, from which on positions would lose more than 3 bits.
    const FAR: f64 = 8.0;
    let mut positions = positions.filter(|position| position.is_finite());
    let Some(first) = positions.next() else {
        return DVec3::ZERO;
    };
    let (low, high) = positions.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
    let extent = (high - low).max_element();
    let is_far = low.abs().max(high.abs()).max_element() > FAR * extent;
    if is_far { first } else { DVec3::ZERO }
}

impl Drawing {
    /// Makes a scene of the drawing; `format` is the file's format.
    pub fn into_scene(mut self, format: &'static str, file: &str, mut warnings: Warnings) -> Result<Loaded, Fault> {
        let mut document = Document { file: file.to_owned(), format, default_scene: Some(0), ..Document::default() };
        let root = &mut document.root;
        let mut roots = Vec::new();
        let budget = Budget::default();
        document.file_materials = self.materials.len();
        self.materials.push(Material::default());
        for (index, shape) in self.shapes.into_iter().enumerate() {
            let place = format!("object {index}");
            let strokes =
                strokes::number(Mode::Lines, 2 * shape.lines.len()) + strokes::number(Mode::Points, shape.points.len());
            let surfaces = shape.positions.len().max(3 * shape.triangles.len());
            let vertices = (surfaces + 4 * strokes) as u64;
            budget.add_vertices(vertices, &place)?;
            let material = shape.material.min(self.materials.len() - 1);
            let name = shape.name.clone();
            let uses_uvs = self.materials[material].textures().next().is_some();
            let strokes = [(Mode::Lines, shape.lines.as_flattened()), (Mode::Points, shape.points.as_slice())]
                .map(|(mode, path)| shape.strokes(mode, path, material, uses_uvs, &place, &mut warnings));
            let surface = shape.into_primitive(material, uses_uvs, &place, &mut warnings);
            let primitives = surface.into_iter().chain(strokes.into_iter().flatten());
            document.meshes.push(primitives.collect());
            let mesh = root.push(json::Mesh {
                extensions: None,
                extras: None,
                name: name.clone(),
                primitives: Vec::new(),
                weights: None,
            });
            document.order.push(index);
            document.nodes.push(Node {
                parent: None,
                transform: Transform::Parts(Parts { translation: self.origin, ..Parts::default() }),
                instances: None,
                visible: true,
            });
            roots.push(root.push(json::Node { mesh: Some(mesh), name, ..json::Node::default() }));
        }
        unlit_materials(&mut self.materials, document.meshes.iter_mut().flatten());
        let root = &mut document.root;
        let _: Index<json::Scene> = root.push(json::Scene { extensions: None, extras: None, name: None, nodes: roots });
        root.asset.version = String::new();
        Ok(Loaded {
            scene: Scene {
                descriptions: Arc::default(),
                materials: self.materials,
                textures: self.textures,
                images: self.images,
                environment: None,
                document,
            },
            warnings: warnings.into_vec(),
        })
    }
}

impl FileObject {
    /// Makes a primitive of the parts of a shape that can be drawn, and warns of the others.
    fn into_primitive(
        mut self,
        material: usize,
        uses_uvs: bool,
        place: &str,
        warnings: &mut Warnings,
    ) -> Option<Primitive> {
        let all = self.triangles.len();
        let usable = |v: u32| {
            let position = self.positions.get(v as usize);
            position.is_some_and(|p| p.iter().all(|x| x.is_finite()))
        };
        self.triangles.retain(|triangle| triangle.iter().all(|&v| usable(v)));
        if self.triangles.len() < all {
            let lost = all - self.triangles.len();
            let reason = format!(
                "{lost} of {all} triangles have no position, or an infinite or undefined one, and \
                 are left out"
            );
            warnings.push(&Fault::new(place, reason));
        }
        if self.triangles.is_empty() {
            return None;
        }
        let count = self.positions.len();
        let mut sources = triangles::compact(&mut self.triangles, count);
        let mut positions = pick(&self.positions, count, &sources);
        let mut normals = pick(&self.normals, count, &sources);
        turn_to_normals(&mut self.triangles, &positions, &normals);
        let mended = mend_normals(&self.triangles, &positions, &mut normals);
        if mended > 0 {
            let reason = format!("{mended} of the normals are unusable and replaced by those of the faces");
            warnings.push(&Fault::new(place, reason));
        }
        if normals.is_empty() {
            let corners = self.triangles.as_flattened();
            sources = corners.iter().map(|&v| sources[v as usize]).collect();
            positions = pick(&self.positions, count, &sources);
            let corners = 0..self.triangles.len() as u32;
            self.triangles = corners.map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        }
        Some(Primitive {
            material,
            uvs: self.uvs_of(uses_uvs, &sources, place, warnings),
            colors: pick(&self.colors, count, &sources),
            triangles: self.triangles,
            positions,
            normals,
            ..Primitive::default()
        })
    }

    /// Makes strokes of the lines or points of a shape that can be drawn, and warns of the others.
    fn strokes(
        &self,
        mode: Mode,
        path: &[u32],
        material: usize,
        uses_uvs: bool,
        place: &str,
        warnings: &mut Warnings,
    ) -> Option<Primitive> {
        let position = |v: u32| self.positions.get(v as usize).copied();
        let usable = |v: &u32| position(*v).is_some_and(|p| p.iter().all(|x| x.is_finite()));
        let whole: Vec<Option<u32>> = path.iter().map(|v| Some(*v).filter(usable)).collect();
        let lost = whole.iter().filter(|vertex| vertex.is_none()).count();
        if lost > 0 {
            let reason = format!(
                "{lost} of {} points or ends of lines have no position, or an infinite or undefined one, and are left out",
                path.len()
            );
            warnings.push(&Fault::new(place, reason));
        }
        let same = |a: u32, b: u32| position(a) == position(b);
        let mut strokes = strokes::assemble(mode, &whole, same);
        let count = self.positions.len();
        let sources = strokes.compact(count);
        let mut normals = pick(&self.normals, count, &sources);
        if !normals.iter().all(is_usable) {
            normals.clear();
        }
        (!strokes.corners.is_empty()).then(|| Primitive {
            material,
            positions: pick(&self.positions, count, &sources),
            normals,
            uvs: self.uvs_of(uses_uvs, &sources, place, warnings),
            colors: pick(&self.colors, count, &sources),
            triangles: strokes.triangles,
            corners: strokes.corners,
            ..Primitive::default()
        })
    }

    fn uvs_of(&self, uses_uvs: bool, sources: &[u32], place: &str, warnings: &mut Warnings) -> Vec<[f32; 4]> {
        if !uses_uvs {
            return Vec::new();
        }
        if self.uvs.len() != self.positions.len() {
            warnings.leave_out("textures of surfaces without texture coordinates", 1, place);
            return vec![[0.0; 4]; sources.len()];
        }
        let uvs = pick(&self.uvs, self.uvs.len(), sources);
        let lost = uvs.iter().filter(|uv| !uv.iter().all(|x| x.is_finite())).count();
        if lost > 0 {
            let reason = format!("{lost} texture coordinates are infinite or undefined, and 0 is used");
            warnings.push(&Fault::new(place, reason));
        }
        let uvs = uvs.into_iter().map(|[u, v]| [u, 1.0 - v, 0.0, 0.0]);
        uvs.map(|uv| uv.map(|x| if x.is_finite() { x } else { 0.0 })).collect()
    }
}

/// Entries of a stream for some of the `count` vertices; none if the stream does not have an entry for each vertex.
fn pick<T: Copy>(stream: &[T], count: usize, sources: &[u32]) -> Vec<T> {
    if stream.len() != count {
        return Vec::new();
    }
    sources.iter().map(|&v| stream[v as usize]).collect()
}

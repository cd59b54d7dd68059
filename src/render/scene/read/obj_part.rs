//! Parts of OBJ files: elements of one object, group and material, and the vertices that their corners make.

use std::collections::HashMap;

use glam::DVec3;

use super::{
    polygon::Triangulator,
    shape::{FileObject, linear, scale_of_codes},
};
use crate::scene::error::{Fault, Warnings};

/// Elements that all parts of a file share.
#[derive(Default)]
pub struct Pool {
    pub positions: Vec<DVec3>,
    pub uvs: Vec<[f32; 2]>,
    pub normals: Vec<[f32; 3]>,
    /// Colours of vertices; empty if none has a colour.
    pub colors: Vec<[f32; 3]>,
}

impl Pool {
    /// Numbers of vertices, texture coordinates and normals.
    pub fn counts(&self) -> [usize; 3] {
        [self.positions.len(), self.uvs.len(), self.normals.len()]
    }

    /// Makes colours linear.
    pub fn finish(&mut self, largest_code: f32) {
        if self.colors.is_empty() {
            return;
        }
        let scale = scale_of_codes(largest_code);
        self.colors.resize(self.positions.len(), [scale; 3]);
        for color in &mut self.colors {
            *color = color.map(|code| linear(f64::from(code / scale)));
        }
    }

    /// Gives the faces of smoothing groups normals, unless they have some: at each vertex the mean of the group's faces,
    /// weighted by area.
    pub fn smooth(&mut self, parts: &mut [Part], origin: DVec3) {
        let mut known: HashMap<(u32, u32), u32> = HashMap::new();
        let mut sums: Vec<DVec3> = Vec::new();
        let first = self.normals.len();
        let groups = parts.iter_mut().flat_map(Part::smooth_faces);
        for (group, face) in groups {
            if face.iter().all(|corner| self.has_normal(corner)) {
                continue;
            }
            let place = |corner: &Corner| {
                let position = self.positions.get(corner.0[0] as usize);
                position.map(|p| *p - origin).filter(|p| p.is_finite())
            };
            let places = || face.iter().filter_map(place);
            let Some(start) = places().next() else {
                continue;
            };
            let spokes = || places().map(|place| place - start);
            let area: DVec3 = spokes().zip(spokes().skip(1)).map(|(a, b)| a.cross(b)).sum();
            for corner in face {
                let index = *known.entry((corner.0[0], group)).or_insert_with(|| {
                    sums.push(DVec3::ZERO);
                    (first + sums.len() - 1) as u32
                });
                sums[index as usize - first] += area;
                corner.0[2] = index;
            }
        }
        let normal = |sum: &DVec3| sum.normalize_or(DVec3::Z).as_vec3().to_array();
        self.normals.extend(sums.iter().map(normal));
    }

    /// Whether a corner has a normal that the file has, too.
    fn has_normal(&self, corner: &Corner) -> bool {
        (corner.0[2] as usize) < self.normals.len()
    }

    /// Positions that parts use, or all if there are no parts.
    pub fn used<'p>(&'p self, parts: &'p [Part]) -> impl Iterator<Item = DVec3> + 'p {
        let all = if parts.is_empty() { &self.positions[..] } else { &[] };
        let corners = parts.iter().flat_map(Part::corners);
        let used = corners.filter_map(|corner| self.positions.get(corner.0[0] as usize));
        used.chain(all).copied()
    }

    /// All vertices as points. Programs write the normals of points in their order.
    pub fn cloud(&self, origin: DVec3, material: usize) -> FileObject {
        let count = self.positions.len();
        FileObject {
            material,
            points: (0..count as u32).collect(),
            positions: self.positions.iter().map(|p| local(*p, origin)).collect(),
            normals: if self.normals.len() == count { self.normals.clone() } else { Vec::new() },
            colors: self.colors.iter().map(|color| opaque(*color)).collect(),
            ..FileObject::default()
        }
    }
}

fn local(position: DVec3, origin: DVec3) -> [f32; 3] {
    (position - origin).as_vec3().to_array()
}

/// A colour with an alpha of 1, because the format has none.
fn opaque([r, g, b]: [f32; 3]) -> [f32; 4] {
    [r, g, b, 1.0]
}

/// Indices of a corner's vertex, texture coordinate and normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner(pub [u32; 3]);

impl Corner {
    /// Index of what a corner does not have.
    pub const NONE: u32 = u32::MAX;
}

/// Elements of one object or group and one material.
#[derive(Default)]
pub struct Part {
    pub name: Option<String>,
    /// Index among the names of materials.
    pub material: Option<u32>,
    /// Corners of all faces.
    pub corners: Vec<Corner>,
    /// End of each face among the corners.
    pub ends: Vec<usize>,
    pub lines: Vec<[Corner; 2]>,
    pub points: Vec<Corner>,
    /// Smoothing groups, each with the index of the first face in it; `None` for no group.
    pub smoothing: Vec<(usize, Option<u32>)>,
}

impl Part {
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty() && self.lines.is_empty() && self.points.is_empty()
    }

    fn corners(&self) -> impl Iterator<Item = &Corner> {
        let of_lines = self.lines.as_flattened().iter();
        self.corners.iter().chain(of_lines).chain(&self.points)
    }

    /// Sets the smoothing group of the faces to come.
    pub fn set_smoothing(&mut self, group: Option<u32>) {
        self.smoothing.push((self.ends.len(), group));
    }

    /// The present smoothing group, as the start of another part.
    pub fn present_smoothing(&self) -> Vec<(usize, Option<u32>)> {
        let last = self.smoothing.last();
        last.map(|(_, group)| (0, *group)).into_iter().collect()
    }

    /// Faces in smoothing groups, with the numbers of their groups.
    fn smooth_faces(&mut self) -> impl Iterator<Item = (u32, &mut [Corner])> {
        let (smoothing, mut next) = (&self.smoothing, 0);
        let mut group = None;
        let (mut rest, mut start) = (&mut self.corners[..], 0);
        let faces = self.ends.iter().enumerate().map(move |(face, &end)| {
            while let Some((_, other)) = smoothing.get(next).filter(|(first, _)| *first <= face) {
                (group, next) = (*other, next + 1);
            }
            let (corners, others) = std::mem::take(&mut rest).split_at_mut(end - start);
            (rest, start) = (others, end);
            group.map(|group| (group, corners))
        });
        faces.flatten()
    }

    fn faces(&self) -> impl Iterator<Item = &[Corner]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.corners[start..*end])
    }
}

/// Makes one vertex of equal corners.
pub struct Welder<'p> {
    pool: &'p Pool,
    origin: DVec3,
    /// For each position the shape that used it last, and the vertex that the shape made of it last.
    last: Vec<[u32; 2]>,
    /// Number of the present shape, from 1.
    shape: u32,
    /// For each vertex its corner, and the vertex that was made before it of the same position.
    vertices: Vec<(Corner, u32)>,
}

impl<'p> Welder<'p> {
    /// Number of vertices of one position that are compared; more become vertices of their own.
    const COMPARED: usize = 16;

    pub fn new(pool: &'p Pool, origin: DVec3) -> Self {
        Self { pool, origin, last: vec![[0; 2]; pool.positions.len()], shape: 0, vertices: Vec::new() }
    }

    /// Shapes of a part: its faces with normals, its faces without, and its lines and points.
    pub fn shapes(&mut self, part: &Part, material: usize, warnings: &mut Warnings) -> Result<Vec<FileObject>, Fault> {
        let mut shapes = Vec::new();
        let mut triangulator = Triangulator::default();
        for has_normals in [true, false] {
            self.begin();
            let is_smooth = |face: &[Corner]| face.iter().all(|corner| self.pool.has_normal(corner));
            let of_kind = |face: &&[Corner]| is_smooth(face) == has_normals;
            let faces: Vec<&[Corner]> = part.faces().filter(of_kind).collect();
            if faces.is_empty() {
                continue;
            }
            let mut corners: Vec<u32> = Vec::new();
            let mut ends = Vec::with_capacity(faces.len());
            for face in faces {
                let vertices = face.iter().map(|corner| self.vertex(*corner, has_normals));
                corners.extend(vertices);
                ends.push(corners.len());
            }
            let mut shape = self.finish(part, material, has_normals);
            triangulator.add_all(&ends, Some(&corners), &mut shape);
            shapes.push(shape);
        }
        if !part.lines.is_empty() || !part.points.is_empty() {
            self.begin();
            let lines = part.lines.iter();
            let lines = lines.map(|ends| ends.map(|end| self.vertex(end, false))).collect();
            let points = part.points.iter().map(|point| self.vertex(*point, false)).collect();
            let shape = self.finish(part, material, false);
            shapes.push(FileObject { lines, points, ..shape });
        }
        triangulator.report(part.name.as_deref().unwrap_or("unnamed object"), warnings)?;
        Ok(shapes)
    }

    fn begin(&mut self) {
        self.shape += 1;
        self.vertices.clear();
    }

    /// Index of the vertex of a corner.
    fn vertex(&mut self, corner: Corner, has_normals: bool) -> u32 {
        let [position, uv, normal] = corner.0;
        let corner = Corner([position, uv, if has_normals { normal } else { Corner::NONE }]);
        let [shape, newest] = self.last[position as usize];
        let mut before = if shape == self.shape { newest } else { Corner::NONE };
        let previous = before;
        for _ in 0..Self::COMPARED {
            let Some((other, next)) = self.vertices.get(before as usize) else {
                break;
            };
            if *other == corner {
                return before;
            }
            before = *next;
        }
        let vertex = self.vertices.len() as u32;
        self.vertices.push((corner, previous));
        self.last[position as usize] = [self.shape, vertex];
        vertex
    }

    /// A shape of the vertices, without its elements.
    fn finish(&self, part: &Part, material: usize, has_normals: bool) -> FileObject {
        let corners = || self.vertices.iter().map(|(corner, _)| corner.0.map(|i| i as usize));
        let pool = self.pool;
        let has_uvs = corners().any(|[_, uv, _]| uv < pool.uvs.len());
        let uv = |[_, uv, _]: [usize; 3]| pool.uvs.get(uv).copied().unwrap_or_default();
        let normal = |[.., normal]: [usize; 3]| pool.normals[normal];
        let color = |[vertex, ..]: [usize; 3]| pool.colors.get(vertex).copied().map(opaque);
        FileObject {
            name: part.name.clone(),
            material,
            positions: corners().map(|[vertex, ..]| local(pool.positions[vertex], self.origin)).collect(),
            normals: match has_normals {
                true => corners().map(normal).collect(),
                false => Vec::new(),
            },
            uvs: match has_uvs {
                true => corners().map(uv).collect(),
                false => Vec::new(),
            },
            colors: corners().map_while(color).collect(),
            ..FileObject::default()
        }
    }
}

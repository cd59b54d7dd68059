//! Tangents by MikkTSpace, as glTF 2.0, section 3.7.2.1, requires if a file has none.

use std::collections::HashMap;

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::{Vec2, Vec3};

use crate::scene::document::{Displacements, Influences, Primitive};

/// Largest number of corners of triangles in one position for which MikkTSpace averages tangents. Its time grows with the
/// square of this number, and it calls itself as many times.
const MOST_CORNERS: u32 = 256;

/// Generates tangents of `primitive` for a normal texture on UV set `uv_set`. A vertex whose triangles have different
/// tangents is split. A triangle with a corner where more than [`MOST_CORNERS`] corners meet follows its own texture
/// coordinates.
pub fn generate(primitive: &mut Primitive, uv_set: u32) {
    let mut corners = vec![None; 3 * primitive.triangles.len()];
    let sorted = SortedFaces::new(primitive);
    let mut surface = MikktspacePrimitive {
        primitive,
        faces: &sorted.averaged,
        flat: primitive.is_flat(),
        first_uv: if uv_set == 0 { 0 } else { 2 },
        corners: &mut corners,
    };
    if generate_tangents(&mut surface).is_err() {
        surface.corners.fill(None);
    }
    surface.faces = &sorted.crowded;
    for face in 0..sorted.crowded.len() {
        surface.set_own_tangent(face);
    }
    take_over(primitive, &mut corners);
    split(primitive, &corners);
}

/// Triangles of a primitive by the source of their tangents. Triangles with two corners in one position are in neither
/// list: they have no area, and MikkTSpace searches all others for each of them.
#[derive(Debug, Default, PartialEq)]
struct SortedFaces {
    /// Triangles for MikkTSpace.
    averaged: Vec<u32>,
    /// Triangles with a corner where too many meet.
    crowded: Vec<u32>,
}

impl SortedFaces {
    fn new(primitive: &Primitive) -> Self {
        // Adding 0 turns a negative zero into a positive one.
        let place = |v: u32| primitive.positions[v as usize].map(|x| (x + 0.0).to_bits());
        let has_area = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(place);
            a != b && b != c && c != a
        };
        let mut of_vertices = vec![0; primitive.positions.len()];
        for &v in primitive.triangles.as_flattened() {
            of_vertices[v as usize] += 1;
        }
        let mut of_places: HashMap<[u32; 3], u32> = HashMap::new();
        for (v, corners) in (0..).zip(of_vertices) {
            *of_places.entry(place(v)).or_default() += corners;
        }
        of_places.retain(|_, corners| *corners > MOST_CORNERS);
        let is_crowded = |v: &u32| !of_places.is_empty() && of_places.contains_key(&place(*v));
        let faces = (0..).zip(&primitive.triangles);
        let (crowded, averaged): (Vec<_>, Vec<_>) =
            faces.filter(|(_, triangle)| has_area(triangle)).partition(|(_, triangle)| triangle.iter().any(is_crowded));
        let indices = |faces: Vec<(u32, &[u32; 3])>| faces.into_iter().map(|(i, _)| i).collect();
        Self { averaged: indices(averaged), crowded: indices(crowded) }
    }
}

/// Triangles of a primitive with the interface of MikkTSpace.
struct MikktspacePrimitive<'p> {
    primitive: &'p Primitive,
    faces: &'p [u32],
    flat: bool,
    first_uv: usize,
    corners: &'p mut [Option<[f32; 4]>],
}

impl MikktspacePrimitive<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.primitive.triangles[self.faces[face] as usize][corner] as usize
    }

    fn set(&mut self, face: usize, corner: usize, tangent: [f32; 4]) {
        // The computation overflows for coordinates near the largest float.
        let tangent = Some(tangent).filter(|t| t.iter().all(|x| x.is_finite()));
        self.corners[3 * self.faces[face] as usize + corner] = tangent;
    }

    /// Sets the tangent of a triangle by itself: the direction in which its u grows.
    fn set_own_tangent(&mut self, face: usize) {
        let [a, b, c] = [0, 1, 2].map(|i| Vec3::from_array(self.position(face, i)).as_dvec3());
        let [uv, uv_b, uv_c] = [0, 1, 2].map(|i| Vec2::from_array(self.tex_coord(face, i)).as_dvec2());
        let (to_b, to_c) = (uv_b - uv, uv_c - uv);
        let area = to_b.perp_dot(to_c);
        let along = ((b - a) * to_c.y - (c - a) * to_b.y) * area.signum();
        for corner in 0..3 {
            let normal = Vec3::from_array(self.normal(face, corner)).as_dvec3();
            let tangent = along.reject_from_normalized(normal).try_normalize();
            if let Some(t) = tangent.filter(|_| area != 0.0) {
                self.set(face, corner, t.extend(-area.signum()).as_vec4().to_array());
            }
        }
    }
}

impl Geometry for MikktspacePrimitive<'_> {
    fn num_faces(&self) -> usize {
        self.faces.len()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.primitive.positions[self.vertex(face, corner)]
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        if self.flat {
            let [a, b, c] = [0, 1, 2].map(|i| Vec3::from_array(self.position(face, i)));
            return (b - a).cross(c - a).normalize_or(Vec3::Z).to_array();
        }
        let normal = Vec3::from_array(self.primitive.normals[self.vertex(face, corner)]);
        normal.normalize_or(Vec3::Z).to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        let uvs = self.primitive.uvs[self.vertex(face, corner)];
        [uvs[self.first_uv], uvs[self.first_uv + 1]]
    }

    fn set_tangent(&mut self, tangent: Option<TangentSpace>, face: usize, corner: usize) {
        if let Some(tangent) = tangent {
            let [x, y, z, sign] = tangent.tangent_encoded();
            // In MikkTSpace v points up, in glTF down, so that the bitangent changes its sign.
            self.set(face, corner, [x, y, z, -sign]);
        }
    }
}

/// Gives corners without a tangent the first one of their vertex.
fn take_over(primitive: &Primitive, corners: &mut [Option<[f32; 4]>]) {
    if !corners.contains(&None) {
        return;
    }
    let mut first = vec![None; primitive.positions.len()];
    let vertices = || primitive.triangles.as_flattened().iter();
    for (&v, tangent) in vertices().zip(&*corners) {
        let first = &mut first[v as usize];
        *first = first.or(*tangent);
    }
    for (&v, tangent) in vertices().zip(corners) {
        *tangent = tangent.or(first[v as usize]);
    }
}

/// Distributes the corners' tangents over the vertices.
fn split(primitive: &mut Primitive, corners: &[Option<[f32; 4]>]) {
    let mut origins: Vec<u32> = Vec::new();
    let mut tangents: Vec<[f32; 4]> = Vec::new();
    // Most vertices have a single tangent, so the newest one of each is tried before the map.
    let mut newest: Vec<Option<u32>> = vec![None; primitive.positions.len()];
    let mut places: HashMap<(u32, [u32; 4]), u32> = HashMap::new();
    let mut triangles = primitive.triangles.clone();
    for (corner, tangent) in triangles.as_flattened_mut().iter_mut().zip(corners) {
        let origin = *corner;
        let tangent = tangent.unwrap_or_else(|| any_tangent(primitive, origin as usize));
        let newest = &mut newest[origin as usize];
        if let Some(v) = *newest
            && tangents[v as usize] == tangent
        {
            *corner = v;
            continue;
        }
        let key = |tangent: [f32; 4]| (origin, tangent.map(f32::to_bits));
        if let Some(v) = *newest {
            places.insert(key(tangents[v as usize]), v);
        }
        let v = places.get(&key(tangent)).copied().unwrap_or_else(|| {
            origins.push(origin);
            tangents.push(tangent);
            tangents.len() as u32 - 1
        });
        *newest = Some(v);
        *corner = v;
    }
    primitive.tangents = tangents;
    primitive.triangles = triangles;
    select(&mut primitive.positions, &origins);
    select(&mut primitive.normals, &origins);
    select(&mut primitive.uvs, &origins);
    select(&mut primitive.colors, &origins);
    for Displacements { positions, normals, tangents } in &mut primitive.targets {
        select(positions, &origins);
        select(normals, &origins);
        select(tangents, &origins);
    }
    for Influences { joints, weights } in &mut primitive.influences {
        select(joints, &origins);
        select(weights, &origins);
    }
}

fn select<T: Copy>(stream: &mut Vec<T>, origins: &[u32]) {
    if !stream.is_empty() {
        *stream = origins.iter().map(|&v| stream[v as usize]).collect();
    }
}

/// A tangent for texture coordinates that determine none: any vector perpendicular to the normal.
fn any_tangent(primitive: &Primitive, vertex: usize) -> [f32; 4] {
    let normal = primitive.normals.get(vertex).map_or(Vec3::Z, |&n| Vec3::from_array(n).normalize_or(Vec3::Z));
    let [x, y, z] = normal.any_orthonormal_vector().to_array();
    [x, y, z, 1.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square that faces +Z, with u to the right and v down, like an image: two triangles that share two vertices.
    fn square(uvs: [[f32; 2]; 4]) -> Primitive {
        Primitive {
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            positions: vec![[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]],
            normals: vec![[0., 0., 1.]; 4],
            uvs: uvs.map(|[u, v]| [0., 0., u, v]).to_vec(),
            ..Primitive::default()
        }
    }

    #[test]
    fn bitangent_points_up_the_image() {
        let mut primitive = square([[0., 1.], [1., 1.], [1., 0.], [0., 0.]]);
        generate(&mut primitive, 1);
        assert_eq!(primitive.positions.len(), 4);
        for tangent in primitive.tangents {
            // Across the normal +Z: bitangent = w * (Z x X) = +Y.
            assert_eq!(tangent, [1., 0., 0., 1.]);
        }
    }

    #[test]
    fn mirrored_texture_turns_the_sign() {
        let mut primitive = square([[1., 1.], [0., 1.], [0., 0.], [1., 0.]]);
        generate(&mut primitive, 1);
        assert!(primitive.tangents.iter().all(|t| *t == [-1., 0., 0., -1.]));
    }

    #[test]
    fn no_texture_coordinates_no_direction() {
        let mut primitive = square([[0.; 2]; 4]);
        generate(&mut primitive, 1);
        for t in primitive.tangents {
            assert_eq!(t[2], 0.0);
            assert!((Vec3::new(t[0], t[1], t[2]).length() - 1.0).abs() < 1e-6);
        }
    }
}

//! Triangle meshes and the solids that the scenes are made of.

use glam::{DVec2, DVec3};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

/// Indexed triangles, counter-clockwise seen from outside.
#[derive(Clone, Default)]
pub struct Mesh {
    pub positions: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    /// Texture coordinates: empty, or one for each vertex.
    pub uvs: Vec<DVec2>,
    pub indices: Vec<u32>,
}

impl Mesh {
    fn vertex(&mut self, position: DVec3, normal: DVec3) -> u32 {
        let index = self.positions.len() as u32;
        self.positions.push(position);
        self.normals.push(normal);
        index
    }

    /// Adds a flat convex polygon with counter-clockwise corners.
    pub fn polygon(&mut self, corners: &[DVec3]) {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        let first = self.positions.len() as u32;
        for &corner in corners {
            self.vertex(corner, normal);
        }
        for i in 2..corners.len() as u32 {
            self.indices.extend([first, first + i - 1, first + i]);
        }
    }

    /// Adds a flat quad with texture coordinates. All polygons of such a mesh must have them.
    pub fn textured_quad(&mut self, corners: [DVec3; 4], uvs: [DVec2; 4]) {
        self.polygon(&corners);
        self.uvs.extend(uvs);
    }

    /// Adds a quad with a single normal, for cards that should be shaded like the object that they represent.
    pub fn card(&mut self, corners: [DVec3; 4], normal: DVec3) {
        let uvs = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]].map(DVec2::from_array);
        self.textured_quad(corners, uvs);
        let first = self.normals.len() - 4;
        self.normals[first..].fill(normal);
    }

    /// Adds an axis-aligned box.
    pub fn cuboid(&mut self, low: DVec3, high: DVec3) {
        let corner = |i: usize| {
            let pick = |bit: usize, a: f64, b: f64| if i & bit == 0 { a } else { b };
            DVec3::new(pick(1, low.x, high.x), pick(2, low.y, high.y), pick(4, low.z, high.z))
        };
        let faces = [[4, 5, 7, 6], [1, 0, 2, 3], [5, 1, 3, 7], [0, 4, 6, 2], [6, 7, 3, 2], [0, 1, 5, 4]];
        for face in faces {
            self.polygon(&face.map(corner));
        }
    }

    /// Adds a prism from `back` to `front` along z over a convex outline in the xy plane, counter-clockwise seen from
    /// +z.
    pub fn prism(&mut self, outline: &[DVec2], back: f64, front: f64) {
        let front_face: Vec<_> = outline.iter().map(|p| p.extend(front)).collect();
        self.polygon(&front_face);
        let back_face: Vec<_> = outline.iter().rev().map(|p| p.extend(back)).collect();
        self.polygon(&back_face);
        for (i, a) in outline.iter().enumerate() {
            let b = outline[(i + 1) % outline.len()];
            self.polygon(&[a.extend(back), b.extend(back), b.extend(front), a.extend(front)]);
        }
    }

    /// Adds a round tube along a path. Its radius changes evenly from `radii[0]` to `radii[1]`; the ends are open.
    pub fn tube(&mut self, path: &[DVec3], radii: [f64; 2], sides: u32) {
        let first = self.positions.len() as u32;
        let last = path.len() - 1;
        for (i, &centre) in path.iter().enumerate() {
            let along = (path[(i + 1).min(last)] - path[i.saturating_sub(1)]).normalize();
            let helper = if along.y.abs() > 0.9 { DVec3::X } else { DVec3::Y };
            let across = along.cross(helper).normalize();
            let other = along.cross(across);
            let radius = radii[0] + (radii[1] - radii[0]) * i as f64 / last as f64;
            for side in 0..sides {
                let (sin, cos) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
                let normal = across * cos + other * sin;
                self.vertex(centre + normal * radius, normal);
            }
        }
        for ring in 0..last as u32 {
            for side in 0..sides {
                let next = (side + 1) % sides;
                let [a, b] = [first + ring * sides + side, first + ring * sides + next];
                self.indices.extend([a, b, b + sides, a, b + sides, a + sides]);
            }
        }
    }
}

/// A unit sphere of meridians and parallels, with texture coordinates: u goes once around, v from the upper pole down.
pub fn globe(meridians: u32, parallels: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for row in 0..=parallels {
        for column in 0..=meridians {
            let uv = DVec2::new(f64::from(column) / f64::from(meridians), f64::from(row) / f64::from(parallels));
            let ((sin, cos), (radius, height)) = ((TAU * uv.x).sin_cos(), (PI * uv.y).sin_cos());
            let direction = DVec3::new(radius * cos, height, -radius * sin);
            mesh.vertex(direction, direction);
            mesh.uvs.push(uv);
        }
    }
    for row in 0..parallels {
        for column in 0..meridians {
            let a = row * (meridians + 1) + column;
            let below = a + meridians + 1;
            // At a pole, one of the two triangles has no area.
            if row > 0 {
                mesh.indices.extend([a, below + 1, a + 1]);
            }
            if row + 1 < parallels {
                mesh.indices.extend([a, below, below + 1]);
            }
        }
    }
    mesh
}

/// A unit sphere from an icosahedron, each of whose triangles is split into four, `levels` times. `radius` gives the
/// distance of the surface in a direction; normals are computed from its differences.
pub fn icosphere(levels: u32, radius: impl Fn(DVec3) -> f64) -> Mesh {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut points: Vec<DVec3> = Vec::new();
    for (a, b) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        points.push(DVec3::new(a, b, 0.0).normalize());
        points.push(DVec3::new(0.0, a, b).normalize());
        points.push(DVec3::new(b, 0.0, a).normalize());
    }
    // Each three corners of an icosahedron at its edge length from each other are a face.
    let near = |a: DVec3, b: DVec3| a.distance(b) < 1.2;
    let mut faces = Vec::new();
    for i in 0..points.len() {
        for j in i + 1..points.len() {
            for k in j + 1..points.len() {
                let [a, b, c] = [points[i], points[j], points[k]];
                if near(a, b) && near(b, c) && near(c, a) {
                    let outward = (b - a).cross(c - a).dot(a) > 0.0;
                    let [i, j, k] = [i as u32, j as u32, k as u32];
                    faces.push(if outward { [i, j, k] } else { [i, k, j] });
                }
            }
        }
    }
    for _ in 0..levels {
        faces = split(&mut points, &faces);
    }
    let surface = |direction: DVec3| direction * radius(direction);
    let normal = |direction: DVec3| {
        const STEP: f64 = 1e-4;
        let u = direction.any_orthonormal_vector();
        let v = direction.cross(u);
        let slope =
            |d: DVec3| surface((direction + d * STEP).normalize()) - surface((direction - d * STEP).normalize());
        slope(u).cross(slope(v)).normalize()
    };
    Mesh {
        positions: points.iter().map(|&p| surface(p)).collect(),
        normals: points.iter().map(|&p| normal(p)).collect(),
        uvs: Vec::new(),
        indices: faces.concat(),
    }
}

/// Splits each face of a unit sphere into four.
fn split(points: &mut Vec<DVec3>, faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            points.push((points[a as usize] + points[b as usize]).normalize());
            points.len() as u32 - 1
        })
    };
    let mut result = Vec::with_capacity(faces.len() * 4);
    for &[a, b, c] in faces {
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        result.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    result
}

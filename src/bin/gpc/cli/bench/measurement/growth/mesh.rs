//! Grids of triangles for the scenes of growth.

use glam::Vec3;
use gpc::scene::{DrawClass, DrawRange, Material, Pose, PosedGeometry, Scene, VertexStreams};

/// Mesh that is being built; all its triangles have the same material.
#[derive(Default)]
pub(super) struct Mesh {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    colors: Vec<[f32; 4]>,
    triangles: Vec<[u32; 3]>,
}

/// Vertex: position, normal and linear colour.
pub(super) struct Vertex {
    pub position: Vec3,
    pub normal: Vec3,
    pub color: Vec3,
}

impl Mesh {
    /// Adds `columns` x `rows` quadrilaterals with shared vertices. `vertex` makes the vertex at a fraction (0 to 1) of
    /// the grid's width and height, from the upper left.
    pub fn add_grid(&mut self, [columns, rows]: [u32; 2], vertex: impl Fn(f32, f32) -> Vertex) {
        let first = self.positions.len() as u32;
        for row in 0..=rows {
            for column in 0..=columns {
                let vertex = vertex(column as f32 / columns as f32, row as f32 / rows as f32);
                self.positions.push(vertex.position.to_array());
                self.normals.push(vertex.normal.to_array());
                self.colors.push(vertex.color.extend(1.0).to_array());
            }
        }
        let side = columns + 1;
        for row in 0..rows {
            for corner in (0..columns).map(|column| first + row * side + column) {
                self.triangles.push([corner, corner + side, corner + 1]);
                self.triangles.push([corner + 1, corner + side, corner + side + 1]);
            }
        }
    }

    /// Makes a scene of the mesh.
    pub fn build(self, material: Material) -> (Scene, Pose) {
        let draws = vec![DrawRange {
            first_triangle: 0,
            triangle_count: self.triangles.len() as u32,
            material: 0,
            class: DrawClass::OpaqueDoubleSided,
        }];
        let geometry = PosedGeometry {
            positions: self.positions,
            streams: VertexStreams { normals: self.normals, colors: self.colors, ..VertexStreams::default() },
            triangles: self.triangles,
            draws,
            ..PosedGeometry::default()
        };
        let pose = Pose { geometry, ..Pose::default() };
        (Scene::from_materials(vec![material]), pose)
    }
}

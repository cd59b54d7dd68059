//! Grids of triangles for the scenes of growth.

use glam::Vec3;
use gpc::scene::{DrawClass, DrawRange, Material, Pose, PosedGeometry, Scene};

/// Vertex: position, normal and linear colour.
pub(super) struct Vertex {
    pub position: Vec3,
    pub normal: Vec3,
    pub color: Vec3,
}

/// Adds `columns` x `rows` quadrilaterals with shared vertices. `vertex` makes the vertex at a fraction (0 to 1) of the
/// grid's width and height, from the upper left.
pub(super) fn add_grid(geometry: &mut PosedGeometry, [columns, rows]: [u32; 2], vertex: impl Fn(f32, f32) -> Vertex) {
    let first = geometry.positions.len() as u32;
    for row in 0..=rows {
        for column in 0..=columns {
            let vertex = vertex(column as f32 / columns as f32, row as f32 / rows as f32);
            geometry.positions.push(vertex.position.to_array());
            geometry.streams.normals.push(vertex.normal.to_array());
            geometry.streams.colors.push(vertex.color.extend(1.0).to_array());
        }
    }
    let side = columns + 1;
    for row in 0..rows {
        for corner in (0..columns).map(|column| first + row * side + column) {
            geometry.triangles.push([corner, corner + side, corner + 1]);
            geometry.triangles.push([corner + 1, corner + side, corner + side + 1]);
        }
    }
}

/// Scene whose triangles all have the same material.
pub(super) fn build(mut geometry: PosedGeometry, material: Material) -> (Scene, Pose) {
    geometry.draws = vec![DrawRange {
        first_triangle: 0,
        triangle_count: geometry.triangles.len() as u32,
        material: 0,
        class: DrawClass::OpaqueDoubleSided,
    }];
    (Scene::from_materials(vec![material]), Pose { geometry, ..Pose::default() })
}

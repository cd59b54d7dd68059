//! Edges of meshes as lines.

use crate::scene_builder::Builder;
use gpc::scene::{Edges, PoseRequest, PosedGeometry};
use serde_json::{Value, json};

/// Two squares of two faces each, whose planes meet at an angle in degrees.
fn folded(degrees: f32) -> Vec<[f32; 3]> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let at = |x: f32, y: f32| {
        if x > 0.0 { [x * cos, y, -x * sin] } else { [x, y, 0.0] }
    };
    let square = |x: f32| [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 0.0], [x + 1.0, 1.0], [x, 1.0]];
    [square(-1.0), square(0.0)].concat().iter().map(|[x, y]| at(*x, *y)).collect()
}

fn edges_of(primitives: &[Vec<[f32; 3]>]) -> PosedGeometry {
    let mut builder = Builder::new();
    let primitives: Vec<Value> =
        primitives.iter().map(|positions| json!({"attributes": {"POSITION": builder.floats(positions)}})).collect();
    let mesh = builder.push("meshes", json!({"primitives": primitives}));
    builder.push("nodes", json!({"mesh": mesh}));
    let mut scene = builder.load().unwrap().scene;
    scene.add_edges(&Edges::default());
    let pose = scene.pose(&PoseRequest::default()).unwrap();
    pose.geometry.check(scene.materials.len()).unwrap();
    pose.geometry
}

/// Numbers of smooth edges and of other edges.
fn counts(geometry: &PosedGeometry) -> [usize; 2] {
    let edges = &geometry.edges;
    let smooth = edges.iter().filter(|edge| edge.is_smooth).count();
    [smooth, edges.len() - smooth]
}

/// The common side of two faces in a plane is not an edge.
#[test]
fn faces_that_turn_far_make_a_crease() {
    for (angle, expected) in [(0.0, [0, 6]), (29.0, [1, 6]), (31.0, [0, 7]), (90.0, [0, 7])] {
        let geometry = edges_of(&[folded(angle)]);
        assert_eq!(counts(&geometry), expected, "{angle} degrees");
    }
}

#[test]
fn primitives_of_a_mesh_are_one_surface() {
    let all = folded(20.0);
    let (left, right) = all.split_at(6);
    let geometry = edges_of(&[left.to_vec(), right.to_vec()]);
    assert_eq!(counts(&geometry), [1, 6]);
}

#[test]
fn a_third_face_makes_an_edge_that_shows() {
    let mut fan = folded(0.0);
    fan.extend([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
    let geometry = edges_of(&[fan]);
    assert_eq!(counts(&geometry), [0, 9]);
    let double_sided = geometry.edges.iter().filter(|edge| edge.is_double_sided);
    assert_eq!(double_sided.count(), 1);
}

#[test]
fn faces_back_to_back_are_one() {
    let sheet = folded(0.0);
    let back = sheet.as_chunks().0.iter().flat_map(|[a, b, c]: &[[f32; 3]; 3]| [*a, *c, *b]);
    let both: Vec<_> = sheet.iter().copied().chain(back).collect();
    let geometry = edges_of(&[both]);
    assert_eq!(counts(&geometry), [0, 6]);
    assert!(geometry.edges.iter().all(|edge| edge.is_double_sided));
}

#[test]
fn edges_are_where_the_faces_are() {
    let geometry = edges_of(&[folded(90.0)]);
    let corners: Vec<[f32; 3]> = folded(90.0);
    let relative = |v: u32| {
        let p = geometry.positions[v as usize];
        [0, 1, 2].map(|axis| p[axis] + geometry.origin[axis] as f32)
    };
    let near = |a: [f32; 3], b: &[f32; 3]| (0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-6);
    for edge in &geometry.edges {
        let ([from, to], [a, b]) = (edge.ends, edge.opposite);
        for v in [from, to, a, b] {
            assert!(corners.iter().any(|corner| near(relative(v), corner)));
        }
        // Corners are at the ends of the edge until a camera places them.
        for (corner, end) in (edge.first_vertex..).zip([from, to, to, from]) {
            assert_eq!(relative(corner), relative(end));
        }
    }
}

//! The nearest triangle of a sample.

use twins::visibility::{Hit, Surface, nearest};

use super::meshes::{Random, tilings};

/// A front-facing triangle with constant depth that covers the middle of the screen.
fn wall(id: u32, depth: f32) -> Surface {
    let corners = [[0.0, -20.0], [-20.0, 20.0], [20.0, 20.0]];
    Surface::new(id, corners.map(|[x, y]| [x, y, depth, 1.0]), false).unwrap()
}

#[test]
fn the_larger_depth_is_nearer() {
    let seen = nearest(&[wall(1, 0.25), wall(2, 0.75), wall(3, 0.5)], [0.0, 0.0]);
    assert_eq!(seen.nearest, Some(Hit { id: 2, depth: 0.75 }));
    assert_eq!(seen.second, Some(0.5));
    assert!(!seen.contested());
}

#[test]
fn equal_depths_go_to_the_smaller_id_in_any_order() {
    for order in [[4, 9, 6], [9, 6, 4], [6, 4, 9]] {
        let surfaces = order.map(|id| wall(id, 0.5));
        let seen = nearest(&surfaces, [1.0, 1.0]);
        assert_eq!(seen.nearest, Some(Hit { id: 4, depth: 0.5 }));
        assert_eq!(seen.second, Some(0.5));
        assert!(seen.contested());
    }
}

#[test]
fn depths_outside_0_to_1_are_clipped() {
    let surfaces = [wall(1, 1.5), wall(2, -0.5), wall(3, 0.5)];
    let seen = nearest(&surfaces, [0.0, 0.0]);
    assert_eq!((seen.nearest, seen.second), (Some(Hit { id: 3, depth: 0.5 }), None));
    assert_eq!(nearest(&surfaces[..2], [0.0, 0.0]).nearest, None);
    for bound in [0.0, 1.0] {
        let seen = nearest(&[wall(1, bound)], [0.0, 0.0]);
        assert_eq!(seen.nearest.map(|hit| hit.id), Some(1));
        assert!(seen.contested());
    }
}

#[test]
fn nothing_is_background() {
    let seen = nearest(&[], [0.0, 0.0]);
    assert_eq!((seen.nearest, seen.second), (None, None));
    assert!(!seen.contested());
    assert_eq!(nearest(&[wall(1, 0.5)], [0.0, 50.0]).nearest, None);
}

#[test]
fn samples_near_an_edge_are_contested() {
    let surface = wall(1, 0.5);
    assert!(nearest([&surface], [0.0, 20.0 - 1.0 / 2048.0]).contested());
    assert!(nearest([&surface], [0.0, 20.0 + 1.0 / 2048.0]).contested());
    assert!(!nearest([&surface], [0.0, 20.0 - 1.0 / 512.0]).contested());
}

/// On a plane that recedes to the horizon and is cut by the near plane, depth is near / distance.
#[test]
fn depth_is_that_of_the_plane_at_the_sample() {
    // The plane is one unit below an eye with a focal length of 100 pixels and a near plane at 1/2; it extends from
    // behind the eye to 1,000 units ahead.
    let near = 0.5;
    let vertex = |x: f32, distance: f32| [100.0 * x, 100.0, near, distance];
    let plane = Surface::new(7, [vertex(0.0, 1000.0), vertex(-900.0, -5.0), vertex(900.0, -5.0)], true).unwrap();
    for row in 1..250 {
        let y = f64::from(row);
        let distance = 100.0 / y;
        let seen = nearest([&plane], [3.0, y]).nearest;
        if distance < 0.5 {
            assert_eq!(seen, None, "before the near plane, row {row}");
        } else {
            let hit = seen.unwrap();
            assert!((hit.depth * distance / f64::from(near) - 1.0).abs() < 1e-12, "row {row}: {hit:?}");
        }
    }
    assert_eq!(nearest([&plane], [3.0, -1.0]).nearest, None);
}

/// Coincident triangles have bit-identical depths, whatever the order of their vertices, so that the ID decides.
#[test]
fn coincident_triangles_tie_in_any_vertex_order() {
    let mut random = Random::new(2);
    let mut hits = 0;
    for mesh in tilings(9, 6.0) {
        for triangle in 0..mesh.triangles.len() {
            let mut corners = mesh.corners(triangle, 0);
            for corner in &mut corners {
                corner[2] = corner[3] * random.range(0.1, 0.9) as f32;
            }
            let surfaces: Vec<Surface> = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]]
                .iter()
                .zip([3, 6, 1, 5, 2, 4])
                .filter_map(|(order, id)| Surface::new(id, order.map(|corner| corners[corner]), true))
                .collect();
            let centre = |axis: usize| corners.iter().map(|c| f64::from(c[axis]) / f64::from(c[3]) / 3.0).sum::<f64>();
            let sample = [centre(0), centre(1)];
            let seen = nearest(&surfaces, sample);
            if let Some(hit) = seen.nearest {
                assert_eq!(hit.id, 1, "{}", mesh.name);
                assert_eq!(seen.second, Some(hit.depth), "{}", mesh.name);
                hits += 1;
            }
        }
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn what_is_not_finite_or_faces_away_is_no_surface() {
    let corners = [[0.0, -20.0], [-20.0, 20.0], [20.0, 20.0]];
    let vertices = corners.map(|[x, y]| [x, y, 0.5, 1.0]);
    for bad in [f32::NAN, f32::INFINITY] {
        let mut broken = vertices;
        broken[1][2] = bad;
        assert!(Surface::new(1, broken, true).is_none());
    }
    let away = [vertices[0], vertices[2], vertices[1]];
    assert!(Surface::new(1, away, false).is_none());
    assert!(Surface::new(1, away, true).is_some());
}

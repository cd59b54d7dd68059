//! Closed-form areas, compared with each other and with samples.

use gpc::sampling::Pattern;
use twins::coverage::EdgeFunctions;
use twins::edge::{clipped_area, half_plane_area, triangle_area};

use super::meshes::{Depths, Random, delaunay, fan, slivers};

#[test]
fn simple_areas_are_right() {
    assert_eq!(half_plane_area([1.0, 0.0, 0.0]), 0.5);
    assert_eq!(half_plane_area([0.0, 2.0, 0.5]), 0.75);
    assert_eq!(half_plane_area([-3.0, 0.0, -0.75]), 0.25);
    assert_eq!(half_plane_area([1.0, 1.0, -0.5]), 0.125);
    assert_eq!(half_plane_area([1.0, -1.0, 0.5]), 0.875);
    assert_eq!(half_plane_area([0.0, 0.0, 1.0]), 1.0);
    assert_eq!(half_plane_area([0.0, 0.0, -1.0]), 0.0);
    assert_eq!(half_plane_area([1.0, 2.0, 9.0]), 1.0);
    assert_eq!(triangle_area([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [0.5, 0.5]), 0.5);
    assert_eq!(triangle_area([[0.0, 1.0], [1.0, 0.0], [0.0, 0.0]], [0.5, 0.5]), 0.5);
    assert_eq!(triangle_area([[-9.0, -9.0], [9.0, -9.0], [0.0, 20.0]], [0.0, 0.0]), 1.0);
    assert_eq!(triangle_area([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], [0.5, 0.5]), 0.0);
    assert_eq!(triangle_area([[5.0, 5.0], [6.0, 5.0], [5.0, 6.0]], [0.0, 0.0]), 0.0);
    assert_eq!(clipped_area(&[]), 1.0);
}

#[test]
fn both_forms_of_a_half_plane_agree() {
    let mut random = Random::new(1);
    for round in 0..20_000 {
        // Some edges are almost parallel to an axis.
        let tilt = if round % 3 == 0 { 1e-12 } else { 1.0 };
        let (a, b) = (random.range(-1.0, 1.0), random.range(-1.0, 1.0) * tilt);
        let line = if round % 2 == 0 { [a, b] } else { [b, a] };
        let line = [line[0], line[1], random.range(-1.2, 1.2) * a.abs()];
        let (closed, clipped) = (half_plane_area(line), clipped_area(&[line]));
        assert!((closed - clipped).abs() < 1e-12, "{line:?}: {closed} and {clipped}");
        let other_side = half_plane_area(line.map(|v| -v));
        assert!((closed + other_side - 1.0).abs() < 1e-14, "{line:?}");
    }
}

#[test]
fn areas_of_a_tiling_sum_to_one() {
    for mesh in
        [delaunay(3, 3.0, 9, Depths::Snapped), fan(3, 3.0, 30, Depths::Snapped), slivers(3, 3.0, 30, Depths::Snapped)]
    {
        for pixel in 0..36 {
            let centre = [pixel % 6, pixel / 6].map(|v| f64::from(v) - 2.5);
            let areas = (0..mesh.triangles.len()).map(|triangle| {
                let corners = mesh.corners(triangle, triangle).map(|[x, y, _, _]| [x, y].map(f64::from));
                triangle_area(corners, centre)
            });
            let sum: f64 = areas.sum();
            assert!((sum - 1.0).abs() < 1e-12, "{}: {sum} at {centre:?}", mesh.name);
        }
    }
}

#[test]
fn samples_measure_the_area_of_triangles() {
    let offsets = Pattern::Sobol.offsets(1024).unwrap();
    let mut random = Random::new(8);
    let mut square = 0.0;
    for _ in 0..400 {
        let corners = [0; 3].map(|_| [0; 2].map(|_| random.range(-1.5, 1.5) as f32));
        let area = triangle_area(corners.map(|corner| corner.map(f64::from)), [0.0, 0.0]);
        let edges = EdgeFunctions::new(corners.map(|[x, y]| [x, y, 1.0]), true).unwrap();
        let covered = offsets.iter().filter(|offset| edges.covers(offset.map(f64::from))).count();
        let error = covered as f64 / 1024.0 - area;
        assert!(error.abs() < 0.02, "{corners:?}: {area}, off by {error}");
        square += error * error / 400.0;
    }
    // There are up to three edges, with an error of 0.0017 each.
    assert!(square.sqrt() < 0.003, "{}", square.sqrt());
}

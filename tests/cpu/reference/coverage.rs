//! Exact coverage: each sample of a tiled region has one owner.

use gpc::sampling::Pattern;
use twins::coverage::{EdgeFunctions, Facing, facing};

use super::meshes::{Mesh, Random, ground, tilings};

/// Half of the side of the sampled region, in pixels.
const HALF: f64 = 6.0;

/// X, Y and w of each vertex.
fn planar(corners: [[f32; 4]; 3]) -> [[f32; 3]; 3] {
    corners.map(|[x, y, _, w]| [x, y, w])
}

/// Asserts that exactly one triangle covers each sample at `offsets` of each pixel of the region whose y is above
/// `top`. The order of the vertices differs from triangle to triangle. Returns the number of samples.
fn assert_owned_once(mesh: &Mesh, offsets: &[[f32; 2]], top: f64) -> u64 {
    let triangles: Vec<EdgeFunctions> = (0..mesh.triangles.len())
        .filter_map(|triangle| EdgeFunctions::new(planar(mesh.corners(triangle, triangle)), true))
        .collect();
    let mut samples = 0;
    let side = 2 * HALF as i32;
    for (row, column) in (0..side).flat_map(|row| (0..side).map(move |column| (row, column))) {
        let centre = [column, row].map(|v| f64::from(v) + 0.5 - HALF);
        if centre[1] - 0.5 < top {
            continue;
        }
        let near: Vec<&EdgeFunctions> = triangles.iter().filter(|t| t.margin(centre) > -0.75).collect();
        for offset in offsets {
            let sample = [0, 1].map(|axis| centre[axis] + f64::from(offset[axis]));
            let owners = near.iter().filter(|triangle| triangle.covers(sample)).count();
            assert_eq!(owners, 1, "{}: owners of the sample at {sample:?}", mesh.name);
            samples += 1;
        }
    }
    samples
}

#[test]
fn every_sample_of_a_tiling_has_one_owner() {
    for (pattern, count, seeds) in
        [(Pattern::Grid, 1, 8), (Pattern::Lattice, 7, 4), (Pattern::Grid, 64, 2), (Pattern::Sobol, 1024, 1)]
    {
        let offsets = pattern.offsets(count).unwrap();
        for mesh in (0..seeds).flat_map(|seed| tilings(seed, HALF)) {
            let samples = assert_owned_once(&mesh, &offsets, f64::NEG_INFINITY);
            assert_eq!(samples, 144 * u64::from(count), "{}", mesh.name);
        }
    }
}

/// The test above covers the rule for ties, because some samples lie on edges.
#[test]
fn snapped_tilings_have_samples_on_edges() {
    let offsets = Pattern::Grid.offsets(64).unwrap();
    let mut on_edges = 0;
    for mesh in tilings(0, HALF) {
        for triangle in 0..mesh.triangles.len() {
            let corners = planar(mesh.corners(triangle, 0));
            let Some(edges) = EdgeFunctions::new(corners, true) else {
                continue;
            };
            on_edges += offsets.iter().filter(|offset| edges.margin(offset.map(|v| f64::from(v) + 0.5)) == 0.0).count();
        }
    }
    assert!(on_edges > 10, "{on_edges} samples on edges");
}

#[test]
fn planes_through_the_eye_have_one_owner_below_the_horizon() {
    let offsets = Pattern::Sobol.offsets(64).unwrap();
    let mut samples = 0;
    for seed in 0..8 {
        let mesh = ground(seed, HALF, 1.0, 9);
        for vertices_behind in 0..3 {
            let crosses = mesh.triangles.iter().any(|triangle| {
                triangle.iter().filter(|&&corner| mesh.vertices[corner][3] < 0.0).count() == vertices_behind
            });
            assert!(crosses, "no triangle with {vertices_behind} vertices behind the eye");
        }
        samples += assert_owned_once(&mesh, &offsets, 1.0);
    }
    assert!(samples > 10_000);
}

#[test]
fn nothing_behind_the_eye_is_covered() {
    let mesh = ground(5, HALF, 1.0, 9);
    for triangle in 0..mesh.triangles.len() {
        let Some(edges) = EdgeFunctions::new(planar(mesh.corners(triangle, 0)), true) else {
            continue;
        };
        // Above the horizon, lines of sight meet the plane only behind the eye.
        for step in 1..200 {
            assert!(!edges.covers([f64::from(step % 20) - 10.0, -f64::from(step) / 16.0]));
        }
    }
}

/// The decision for integer vertices, and samples in sixteenths, computed with 128-bit integers.
fn covers_in_integers(vertices: [[i64; 3]; 3], sample: [i64; 2]) -> bool {
    let cross = |a: [i64; 3], b: [i64; 3]| {
        let [a, b] = [a, b].map(|v| v.map(i128::from));
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let [v0, v1, v2] = vertices;
    let dot = |a: [i128; 3], b: [i64; 3]| (0..3).map(|i| a[i] * i128::from(b[i])).sum::<i128>();
    let sign = dot(cross(v0, v1), v2).signum();
    [(v0, v1), (v1, v2), (v2, v0)].into_iter().all(|(from, to)| {
        let [a, b, c] = cross(from, to).map(|v| v * sign);
        let value = dot([a, b, c], [sample[0], sample[1], 16]);
        value > 0 || (value == 0 && (a > 0 || (a == 0 && b > 0)))
    })
}

#[test]
fn decisions_agree_with_integer_arithmetic() {
    let mut random = Random::new(7);
    let (mut covered, mut ties) = (0, 0);
    for round in 0..60_000 {
        let mut coordinate = |bits: u64| (random.below(2 << bits) as i64) - (1 << bits);
        let (vertices, sample) = if round % 4 == 0 {
            // Whole numbers of pixels close to each other make ties frequent.
            let vertices = [0; 3].map(|_| [coordinate(2), coordinate(2), 1]);
            (vertices, [0; 2].map(|_| 16 * coordinate(1)))
        } else {
            // The coordinates have every magnitude, and w has both signs and is also zero.
            let bits = 3 + round % 20;
            let vertices = [0; 3].map(|_| [coordinate(bits), coordinate(bits), coordinate(2 + bits / 8)]);
            (vertices, [coordinate(4), coordinate(4)])
        };
        let expected = covers_in_integers(vertices, sample);
        let edges = EdgeFunctions::new(vertices.map(|v| v.map(|c| c as f32)), true);
        let position = sample.map(|v| v as f64 / 16.0);
        let found = edges.as_ref().is_some_and(|edges| edges.covers(position));
        assert_eq!(found, expected, "{vertices:?} at {sample:?} sixteenths");
        covered += u32::from(found);
        ties += u32::from(edges.is_some_and(|edges| edges.margin(position) == 0.0));
    }
    assert!(covered > 1000 && ties > 1000, "{covered} covered, {ties} ties");
}

#[test]
fn counter_clockwise_on_the_screen_is_the_front() {
    // The vertices are top, bottom left and bottom right; y points down.
    let front = [[0.0, -1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, 1.0, 1.0]];
    let back = [front[0], front[2], front[1]];
    assert_eq!(facing(front), Facing::Front);
    assert_eq!(facing(back), Facing::Back);
    assert!(EdgeFunctions::new(front, false).unwrap().covers([0.0, 0.0]));
    assert!(EdgeFunctions::new(back, false).is_none());
    assert!(EdgeFunctions::new(back, true).unwrap().covers([0.0, 0.0]));
}

#[test]
fn degenerate_triangles_cover_nothing() {
    let point = [1.0, 2.0, 1.0];
    let line = [[0.0, 0.0, 1.0], [1.0, 1.0, 1.0], [3.0, 3.0, 1.0]];
    let edge_on = [[2.0, 1.0, 4.0], [4.0, 2.0, 1.0], [6.0, 3.0, 9.0]];
    let mut degenerates = vec![[point; 3], [point, point, [0.0, 0.0, 1.0]], line, edge_on, [[0.0; 3]; 3]];
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        degenerates.push([[bad, 0.0, 1.0], [9.0, 0.0, 1.0], [0.0, 9.0, 1.0]]);
        degenerates.push([[0.0, 0.0, bad], [9.0, 0.0, 1.0], [0.0, 9.0, 1.0]]);
    }
    for vertices in degenerates {
        assert_eq!(facing(vertices), Facing::Neither, "{vertices:?}");
        assert!(EdgeFunctions::new(vertices, true).is_none());
    }
}

/// Neither tiny nor huge coordinates change the decision.
#[test]
fn scale_does_not_matter() {
    let triangle = [[-3.0, -2.0, 1.0], [-1.0, 4.0, 1.0], [5.0, 1.0, 1.0]];
    let unit = EdgeFunctions::new(triangle, true).unwrap();
    for exponent in [-140, -60, 60, 120] {
        let factor = 2.0_f64.powi(exponent);
        let scaled = triangle.map(|v: [f32; 3]| v.map(|c| (f64::from(c) * factor) as f32));
        let scaled = EdgeFunctions::new(scaled, true).unwrap();
        let mut random = Random::new(3);
        for _ in 0..500 {
            let sample = [0; 2].map(|_| (random.range(-4.0, 5.0) * 16.0).round() / 16.0);
            assert_eq!(scaled.covers(sample), unit.covers(sample), "times 2^{exponent}, {sample:?}");
        }
    }
}

#[test]
fn margin_is_the_distance_from_the_edges() {
    let right_angled = EdgeFunctions::new([[0.0, 0.0, 1.0], [0.0, 6.0, 2.0], [8.0, 0.0, 2.0]], true).unwrap();
    // The corners are (0, 0), (0, 3) and (4, 0), so that the incircle's radius is 1.
    assert!((right_angled.margin([1.0, 1.0]) - 1.0).abs() < 1e-12);
    assert!((right_angled.margin([-0.5, 1.0]) + 0.5).abs() < 1e-12);
    assert_eq!(right_angled.margin([0.0, 2.0]), 0.0);
    assert!((right_angled.margin([4.0, 3.0]) + 2.4).abs() < 1e-12);
}

#[test]
fn factors_restore_the_sample() {
    let mut random = Random::new(11);
    for _ in 0..2000 {
        let vertices = [0; 3].map(|_| [0; 3].map(|_| random.range(-50.0, 50.0) as f32));
        let Some(edges) = EdgeFunctions::new(vertices, true) else {
            continue;
        };
        let sample = [random.range(-9.0, 9.0), random.range(-9.0, 9.0)];
        let factors = edges.factors(sample);
        for (axis, expected) in [sample[0], sample[1], 1.0].into_iter().enumerate() {
            let terms = (0..3).map(|i| factors[i] * f64::from(vertices[i][axis]));
            let size: f64 = terms.clone().map(f64::abs).sum();
            assert!((terms.sum::<f64>() - expected).abs() <= size * 1e-14);
        }
    }
}

//! Meshes, made from seeds, that tile a square of the screen and are hard to rasterize without holes or overlaps.

use glam::DVec3;
use gpc::testing::Random;

/// Triangles with shared vertices in clip space.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Kind of mesh, for messages.
    pub name: String,
    /// Clip-space vertices (X, Y, z, w): X and Y are w times the pixels from the screen's centre, y down; 0 < z < w
    /// where w > 0.
    pub vertices: Vec<[f32; 4]>,
    /// Indices in `vertices` of each triangle's corners.
    pub triangles: Vec<[usize; 3]>,
}

impl Mesh {
    /// Corners of a triangle in one of their six orders, three of which flip its facing; `permutation` is taken
    /// modulo 6.
    ///
    /// # Panics
    /// If there is no triangle with this index.
    pub fn corners(&self, triangle: usize, permutation: usize) -> [[f32; 4]; 3] {
        const PERMUTATIONS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
        PERMUTATIONS[permutation % 6].map(|corner| self.vertices[self.triangles[triangle][corner]])
    }
}

/// Distances of a mesh's vertices from the eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depths {
    /// w = 1, and positions rounded to 1/16 pixel: samples on a grid fall on edges and corners.
    Snapped,
    /// Random w for each vertex, from 1/8 to 8.
    Random,
}

impl Depths {
    fn vertex(self, random: &mut Random, [x, y]: [f64; 2]) -> [f32; 4] {
        match self {
            Self::Snapped => [snap(x), snap(y), 0.25, 1.0],
            Self::Random => {
                let w = random.range(-3.0, 3.0).exp2();
                [(x * w) as f32, (y * w) as f32, (0.25 * w) as f32, w as f32]
            }
        }
    }
}

/// Meshes of every kind that cover the square from -half to half pixels on both axes with positive w.
pub fn tilings(seed: u64, half: f64) -> Vec<Mesh> {
    let mut meshes = Vec::new();
    for depths in [Depths::Snapped, Depths::Random] {
        meshes.push(delaunay(seed, half, 7, depths));
        meshes.push(delaunay(seed + 1, half, 40, depths));
        meshes.push(fan(seed, half, 48, depths));
        meshes.push(slivers(seed, half, 60, depths));
    }
    meshes
}

/// Jittered grid of `cells` x `cells` quadrilaterals, each split along its Delaunay diagonal; `half` is half of the
/// square's side in pixels.
pub fn delaunay(seed: u64, half: f64, cells: usize, depths: Depths) -> Mesh {
    let mut random = Random::new(seed);
    let side = cells + 1;
    // The vertices on the rim stay on a square slightly larger than the one to cover.
    let step = (2.0 * half + 2.0) / cells as f64;
    let mut jitter = |index: usize| match index {
        0 => 0.0,
        _ if index == cells => 0.0,
        // Quadrilaterals stay convex while their corners move by less than a quarter of a cell, which includes
        // rounding to 1/16 pixel.
        _ => random.range(-1.0, 1.0) * (0.24 * step - 1.0 / 16.0).max(0.0),
    };
    let positions: Vec<[f64; 2]> = (0..side * side)
        .map(|index| [index % side, index / side].map(|i| -half - 1.0 + i as f64 * step + jitter(i)))
        .collect();
    let mut random = Random::new(!seed);
    let vertices = positions.iter().map(|&position| depths.vertex(&mut random, position)).collect();
    let mut triangles = Vec::with_capacity(2 * cells * cells);
    for corner in (0..cells).flat_map(|row| (0..cells).map(move |column| row * side + column)) {
        let [a, b, c, d] = [corner, corner + 1, corner + 1 + side, corner + side];
        // The fourth corner is inside of the others' circumcircle, so the other diagonal is the Delaunay one.
        if in_circle([a, b, c, d].map(|index| positions[index])) > 0.0 {
            triangles.extend([[a, b, d], [b, c, d]]);
        } else {
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh { name: format!("{cells} x {cells} Delaunay cells, {depths:?}"), vertices, triangles }
}

/// Positive if the last point lies in the circumcircle of the others, which are counter-clockwise in the axes' sense.
/// The sign may be wrong by rounding; either diagonal makes a tiling.
fn in_circle([a, b, c, d]: [[f64; 2]; 4]) -> f64 {
    let rows = [a, b, c].map(|[x, y]| {
        let [x, y] = [x - d[0], y - d[1]];
        DVec3::new(x, y, x * x + y * y)
    });
    rows[0].dot(rows[1].cross(rows[2]))
}

/// Fan of `spokes` triangles around one vertex in the square; `half` is half of the square's side in pixels.
pub fn fan(seed: u64, half: f64, spokes: usize, depths: Depths) -> Mesh {
    let mut random = Random::new(seed);
    let hub = [random.range(-half, half), random.range(-half, half)];
    let mut angles: Vec<f64> = (0..spokes)
        .map(|spoke| (spoke as f64 + random.range(0.1, 0.9)) / spokes as f64 * std::f64::consts::TAU)
        .collect();
    angles.sort_unstable_by(f64::total_cmp);
    // The chord between neighbouring spokes stays outside of the square from every hub in it.
    let radius = 4.0 * half + 4.0;
    let mut vertices = vec![depths.vertex(&mut random, hub)];
    for angle in angles {
        let rim = [hub[0] + radius * angle.cos(), hub[1] + radius * angle.sin()];
        vertices.push(depths.vertex(&mut random, rim));
    }
    Mesh {
        name: format!("fan of {spokes}, {depths:?}"),
        vertices,
        triangles: (0..spokes).map(|spoke| [0, 1 + spoke, 1 + (spoke + 1) % spokes]).collect(),
    }
}

/// Strip of long thin triangles, with `count` vertices on either side; many are far thinner than the distance between
/// samples. `half` is half of the square's side in pixels.
pub fn slivers(seed: u64, half: f64, count: usize, depths: Depths) -> Mesh {
    let mut random = Random::new(seed);
    let side = |random: &mut Random, x: f64| {
        let mut heights: Vec<f64> = (1..count - 1).map(|_| random.range(-half, half)).collect();
        // Every third vertex almost coincides with the one before.
        for index in (0..heights.len()).step_by(3).skip(1) {
            heights[index] = heights[index - 1] + random.range(-16.0, -4.0).exp2();
        }
        heights.extend([-half - 2.0, half + 2.0]);
        heights.sort_unstable_by(f64::total_cmp);
        heights.into_iter().map(|y| depths.vertex(random, [x, y])).collect::<Vec<_>>()
    };
    let mut vertices = side(&mut random, -3.0 * half - 0.3);
    vertices.extend(side(&mut random, 3.0 * half + 0.7));
    let strip = |row: usize| [[row, row + 1, count + row], [row + 1, count + row + 1, count + row]];
    Mesh { name: format!("slivers, {depths:?}"), vertices, triangles: (0..count - 1).flat_map(strip).collect() }
}

/// Horizontal plane under the camera, of `cells` x `cells` irregular cells that begin behind the camera. The near plane
/// cuts its quadrilaterals in many ways, and its vertices lie up to 10^6 pixels off the screen. The mesh covers the
/// screen from the pixel row `horizon` (from the centre) downwards; `half` is the distance in pixels from the screen's
/// centre to its sides.
pub fn ground(seed: u64, half: f64, horizon: f64, cells: usize) -> Mesh {
    let mut random = Random::new(seed);
    // The plane is one unit below the eye, and a slope of 1 is seen at the screen's side.
    let farthest = half / horizon;
    let side = cells + 1;
    let mut coordinate = |low: f64, high: f64| {
        let mut inner: Vec<f64> = (1..cells).map(|_| random.range(low, high)).collect();
        // Some vertices lie exactly or almost in the plane of the eye.
        inner[0] = 0.0;
        inner[1] = 1e-6;
        inner.extend([low, high]);
        inner.sort_unstable_by(f64::total_cmp);
        inner
    };
    let across = coordinate(-2.0 * farthest, 2.0 * farthest);
    let along = coordinate(-farthest, 2.0 * farthest);
    let vertices = (0..side * side)
        .map(|index| {
            let (x, depth) = (across[index % side], along[index / side]);
            [x * half, half, 0.01, depth].map(|v| v as f32)
        })
        .collect();
    let corners = (0..cells).flat_map(|row| (0..cells).map(move |column| row * side + column));
    Mesh {
        name: "ground plane through the eye".to_owned(),
        vertices,
        triangles: corners.flat_map(|a| [[a, a + 1, a + 1 + side], [a, a + 1 + side, a + side]]).collect(),
    }
}

/// Nearest multiple of 1/16.
fn snap(value: f64) -> f32 {
    ((value * 16.0).round() / 16.0) as f32
}

//! Visible triangles of a stage's samples, computed by the exact twin.

use twins::visibility::{Surface, Visibility, nearest};

use crate::stage::{Stage, centre, clip};

/// Twice the step of the grid onto which rasterizers move corners, in pixels: steps are 2^-8 pixel on known devices.
const SNAP: f64 = 1.0 / 128.0;

/// Surfaces of a stage, and the indices of those near each pixel.
pub struct Twin {
    surfaces: Vec<Surface>,
    near: Vec<Vec<u32>>,
}

impl Twin {
    /// Makes the twin of a stage in an image of `size` pixels.
    pub fn new(stage: &Stage, size: [u32; 2]) -> Self {
        let mut twin = Self { surfaces: Vec::new(), near: vec![Vec::new(); size[0] as usize * size[1] as usize] };
        for (index, triangle) in stage.triangles.iter().enumerate() {
            let vertices = triangle.corners.map(|corner| clip(corner, size));
            let double_sided = stage.materials[triangle.material].double_sided;
            let Some(surface) = Surface::new(index as u32 + 1, vertices, double_sided) else {
                continue;
            };
            let [columns, rows] = [0, 1].map(|axis| reach(vertices, axis, size[axis]));
            for row in rows {
                for pixel in columns.clone().map(|column| row * size[0] as usize + column) {
                    // No sample is more than 0.71 pixels from its pixel's centre.
                    if surface.edges().margin(centre(pixel, size)) > -0.75 {
                        twin.near[pixel].push(twin.surfaces.len() as u32);
                    }
                }
            }
            twin.surfaces.push(surface);
        }
        twin
    }

    /// Visibility of a sample in a pixel's square.
    pub fn nearest(&self, pixel: usize, sample: [f64; 2]) -> Visibility {
        self.without(pixel, sample, &[])
    }

    /// Visibility of a pixel's centre, and whether the device's rasterizer may see another triangle there. It moves corners to a
    /// grid, and so moves an edge by as much, and a depth by as much as the depth changes over this distance. It also rounds
    /// depths to 32 bits.
    pub fn rasterized(&self, pixel: usize, centre: [f64; 2]) -> (Visibility, bool) {
        let seen = self.nearest(pixel, centre);
        let Some(nearest) = seen.nearest else {
            return (seen, seen.contested() || seen.edge_margin < SNAP);
        };
        let around = |surface: &Surface| {
            let depth = surface.depth(centre);
            let slopes = [[1.0, 0.0], [0.0, 1.0]].map(|[x, y]| surface.depth([centre[0] + x, centre[1] + y]) - depth);
            let error = SNAP * (slopes[0].abs() + slopes[1].abs());
            [depth - error, depth + error]
        };
        let surfaces = self.near[pixel].iter().map(|&i| &self.surfaces[i as usize]);
        let covering: Vec<_> = surfaces.filter(|s| s.edges().covers(centre)).collect();
        let lowest = covering.iter().find(|s| s.id() == nearest.id);
        let lowest = lowest.map_or(nearest.depth, |surface| around(surface)[0]);
        let mut others = covering.iter().filter(|s| s.id() != nearest.id);
        // Nothing in front of the near plane is drawn.
        let rivalled = others.any(|surface| {
            let [furthest, nearest] = around(surface);
            furthest <= 1.0 && nearest >= lowest
        });
        (seen, rivalled || seen.contested() || seen.edge_margin < SNAP)
    }

    /// Visibility of a sample without the surfaces with the IDs `hidden`.
    pub fn without(&self, pixel: usize, sample: [f64; 2], hidden: &[u32]) -> Visibility {
        let surfaces = self.near[pixel].iter().map(|&i| &self.surfaces[i as usize]);
        nearest(surfaces.filter(|s| !hidden.contains(&s.id())), sample)
    }
}

/// Range of the columns or rows of pixels that are at most a pixel away from a triangle; all of them if a vertex is not
/// in front of the eye.
fn reach(vertices: [[f32; 4]; 3], axis: usize, pixels: u32) -> std::ops::Range<usize> {
    if vertices.iter().any(|v| v[3] <= 0.0) {
        return 0..pixels as usize;
    }
    let places = vertices.map(|v| f64::from(v[axis]) / f64::from(v[3]) + f64::from(pixels) / 2.0);
    let low = places.into_iter().fold(f64::INFINITY, f64::min) - 1.0;
    let high = places.into_iter().fold(f64::NEG_INFINITY, f64::max) + 2.0;
    let bound = |place: f64| place.clamp(0.0, f64::from(pixels)) as usize;
    bound(low)..bound(high)
}

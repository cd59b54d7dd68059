//! Visibility: which triangle a sample sees.
//!
//! Depth is z/w in [0, 1], with 1 at the near plane (reversed), so that larger values are nearer. It is linear over
//! the screen, and computed at each sample from the clip-space vertices. A surface exists only where 0 <= depth <= 1
//! and w > 0. Of equal depths the smaller triangle ID wins; triangles with identical vertices have identical depths,
//! whatever the order of their vertices.

use super::coverage::EdgeFunctions;

/// Distance from an edge in pixels within which a result that was rounded to 32 bits may be on the other side.
const EDGE_MARGIN: f64 = 1.0 / 1024.0;

/// Relative difference of depths within which results that were rounded to 32 bits may have another order.
const DEPTH_MARGIN: f64 = 1.0 / 1048576.0;

/// A triangle that can be visible.
#[derive(Clone, Debug)]
pub struct Surface {
    id: u32,
    edges: EdgeFunctions,
    /// Clip-space z of the vertices.
    z: [f64; 3],
    /// Indices of the vertices in an order that depends on the vertices alone.
    order: [usize; 3],
}

/// A surface at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// ID of the triangle.
    pub id: u32,
    /// Depth at the sample.
    pub depth: f64,
}

/// Visible surface at a sample, and how close the decision was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visibility {
    /// The nearest surface; `None` for background.
    pub nearest: Option<Hit>,
    /// Depth of the next surface behind the nearest one, or of an equally near one.
    pub second: Option<f64>,
    /// Distance in pixels of the sample from the nearest edge of any triangle, including hidden ones; infinite without
    /// triangles.
    pub edge_margin: f64,
    /// Smallest distance of the triangles' depths at the sample from the bounds 0 and 1, relative to the size of the
    /// terms that add up to a depth; infinite without triangles.
    pub clip_margin: f64,
}

impl Surface {
    /// Triangle with clip-space vertices (X, Y, z, w), where X and Y are pixel-scaled as in
    /// [`coverage`](super::coverage) and z/w is the depth. `None` if it covers no sample, or a coordinate is not
    /// finite.
    pub fn new(id: u32, vertices: [[f32; 4]; 3], double_sided: bool) -> Option<Self> {
        let edges = EdgeFunctions::new(vertices.map(|[x, y, _, w]| [x, y, w]), double_sided)?;
        let z = vertices.map(|[_, _, z, _]| f64::from(z));
        if !z.iter().all(|z| z.is_finite()) {
            return None;
        }
        let mut indexed = [(vertices[0], 0), (vertices[1], 1), (vertices[2], 2)];
        indexed.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        Some(Self { id, edges, z, order: indexed.map(|(_, index)| index) })
    }

    /// ID of the triangle.
    pub fn id(&self) -> u32 {
        self.id
    }

    /// Edge functions of the triangle.
    pub fn edges(&self) -> &EdgeFunctions {
        &self.edges
    }

    /// Depth of the triangle's plane at a sample.
    pub fn depth(&self, sample: [f64; 2]) -> f64 {
        self.depth_and_size(sample)[0]
    }

    /// Depth of the triangle's plane at a sample, and the size of the terms that add up to the depth.
    fn depth_and_size(&self, sample: [f64; 2]) -> [f64; 2] {
        let values = self.edges.values(sample);
        // The order depends on the vertices alone, so that coincident triangles agree to the bit.
        let terms = self.order.map(|vertex| values[vertex] * self.z[vertex]);
        let sums: [f64; 2] = [terms.iter().sum(), terms.iter().map(|term| term.abs()).sum()];
        sums.map(|sum| sum / self.edges.determinant())
    }
}

impl Visibility {
    /// Whether a result that was rounded to 32 bits may differ: the sample is within 2^-10 pixel of an edge, the two
    /// nearest depths differ by less than 2^-20 of the nearer one, or a triangle's depth is that close to the near or
    /// the far plane.
    pub fn contested(&self) -> bool {
        let depths_agree = match (self.nearest, self.second) {
            (Some(hit), Some(second)) => hit.depth - second <= hit.depth * DEPTH_MARGIN,
            _ => false,
        };
        depths_agree || self.edge_margin < EDGE_MARGIN || self.clip_margin < DEPTH_MARGIN
    }

    /// Inserts a hit in order of depth.
    fn add(&mut self, hit: Hit) {
        let behind = match self.nearest {
            Some(nearest) if nearest.depth > hit.depth || (nearest.depth == hit.depth && nearest.id < hit.id) => hit,
            previous => {
                self.nearest = Some(hit);
                match previous {
                    Some(previous) => previous,
                    None => return,
                }
            }
        };
        self.second = Some(self.second.map_or(behind.depth, |second| second.max(behind.depth)));
    }
}

/// Visible surface at a sample, which is in pixels from the screen's centre. The order of the surfaces does not
/// matter.
pub fn nearest<'a>(surfaces: impl IntoIterator<Item = &'a Surface>, sample: [f64; 2]) -> Visibility {
    let mut seen = Visibility { nearest: None, second: None, edge_margin: f64::INFINITY, clip_margin: f64::INFINITY };
    for surface in surfaces {
        seen.edge_margin = seen.edge_margin.min(surface.edges.margin(sample).abs());
        if !surface.edges.covers(sample) {
            continue;
        }
        let [depth, size] = surface.depth_and_size(sample);
        let from_far = if size > 0.0 { depth.abs() / size } else { 0.0 };
        seen.clip_margin = seen.clip_margin.min((1.0 - depth).abs()).min(from_far);
        if (0.0..=1.0).contains(&depth) {
            seen.add(Hit { id: surface.id, depth });
        }
    }
    seen
}

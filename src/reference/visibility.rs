//! Which triangle a sample sees.
//!
//! Depth is z/w in [0, 1], 1 at the near plane (reversed): the larger is the nearer. It is linear over the screen, and
//! found per sample from the clip-space vertices. A surface is there only where 0 <= depth <= 1 and w > 0. Of equal
//! depths the smaller triangle ID wins, and triangles with identical vertices have identical depths in whatever order
//! their vertices come.

use super::coverage::EdgeFunctions;

/// Distance from an edge in pixels below which a result that is rounded to 32 bits may fall on the other side of it.
const EDGE_MARGIN: f64 = 1.0 / 1024.0;

/// Relative difference of depths below which a result that is rounded to 32 bits may order them otherwise.
const DEPTH_MARGIN: f64 = 1.0 / 1048576.0;

/// A triangle that can be seen.
#[derive(Clone, Debug)]
pub struct Surface {
    id: u32,
    edges: EdgeFunctions,
    /// The vertices' clip-space z.
    z: [f64; 3],
    /// The vertices' places in an order of their own.
    order: [usize; 3],
}

/// What a sample sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The triangle's ID.
    pub id: u32,
    /// Its depth at the sample.
    pub depth: f64,
}

/// The answer for one sample, and how close it was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visibility {
    /// The nearest surface; `None` is the background.
    pub nearest: Option<Hit>,
    /// The depth of the next surface behind it, or of an equally near one.
    pub second: Option<f64>,
    /// Distance in pixels of the sample from the nearest edge of any triangle, hidden ones included. Infinite if there
    /// are none.
    pub edge_margin: f64,
    /// Distance of the depths of the triangles at the sample from the bounds 0 and 1, relative to the size of the terms
    /// that they are summed from; the least of all triangles. Infinite if there are none.
    pub clip_margin: f64,
}

impl Surface {
    /// A triangle with clip-space vertices (X, Y, z, w), where X and Y are pixel-scaled as in
    /// [`coverage`](super::coverage) and z/w is the depth. `None` where it covers no sample at all, or a coordinate is
    /// not finite.
    pub fn new(id: u32, vertices: [[f32; 4]; 3], double_sided: bool) -> Option<Self> {
        let edges = EdgeFunctions::new(vertices.map(|[x, y, _, w]| [x, y, w]), double_sided)?;
        let z = vertices.map(|[_, _, z, _]| f64::from(z));
        if !z.iter().all(|z| z.is_finite()) {
            return None;
        }
        let mut indexed = [(vertices[0], 0), (vertices[1], 1), (vertices[2], 2)];
        indexed.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        Some(Self {
            id,
            edges,
            z,
            order: indexed.map(|(_, index)| index),
        })
    }

    /// The triangle's ID.
    pub fn id(&self) -> u32 {
        self.id
    }

    /// The triangle's edge functions.
    pub fn edges(&self) -> &EdgeFunctions {
        &self.edges
    }

    /// The depth of the triangle's plane at a sample, and the size of the terms that it is summed from.
    fn depth(&self, sample: [f64; 2]) -> [f64; 2] {
        let values = self.edges.values(sample);
        // Summed in the vertices' own order, so that coincident triangles agree to the bit.
        let terms = self.order.map(|vertex| values[vertex] * self.z[vertex]);
        let sums: [f64; 2] = [
            terms.iter().sum(),
            terms.iter().map(|term| term.abs()).sum(),
        ];
        sums.map(|sum| sum / self.edges.determinant())
    }
}

impl Visibility {
    /// Whether a result that is rounded to 32 bits may differ: the sample is within 2^-10 pixel of an edge, the two
    /// nearest depths differ by less than 2^-20 of the nearer, or a triangle's depth is as near to the near or the far
    /// plane.
    pub fn contested(&self) -> bool {
        let depths_agree = match (self.nearest, self.second) {
            (Some(hit), Some(second)) => hit.depth - second <= hit.depth * DEPTH_MARGIN,
            _ => false,
        };
        depths_agree || self.edge_margin < EDGE_MARGIN || self.clip_margin < DEPTH_MARGIN
    }

    /// Puts a hit into its place.
    fn add(&mut self, hit: Hit) {
        let behind = match self.nearest {
            Some(nearest)
                if nearest.depth > hit.depth
                    || (nearest.depth == hit.depth && nearest.id < hit.id) =>
            {
                hit
            }
            previous => {
                self.nearest = Some(hit);
                match previous {
                    Some(previous) => previous,
                    None => return,
                }
            }
        };
        self.second = Some(
            self.second
                .map_or(behind.depth, |second| second.max(behind.depth)),
        );
    }
}

/// What a sample, in pixels from the screen's centre, sees of some surfaces. Their order does not matter.
pub fn nearest<'a>(
    surfaces: impl IntoIterator<Item = &'a Surface>,
    sample: [f64; 2],
) -> Visibility {
    let mut seen = Visibility {
        nearest: None,
        second: None,
        edge_margin: f64::INFINITY,
        clip_margin: f64::INFINITY,
    };
    for surface in surfaces {
        seen.edge_margin = seen.edge_margin.min(surface.edges.margin(sample).abs());
        if !surface.edges.covers(sample) {
            continue;
        }
        let [depth, size] = surface.depth(sample);
        let from_far = if size > 0.0 { depth.abs() / size } else { 0.0 };
        seen.clip_margin = seen.clip_margin.min((1.0 - depth).abs()).min(from_far);
        if (0.0..=1.0).contains(&depth) {
            seen.add(Hit {
                id: surface.id,
                depth,
            });
        }
    }
    seen
}

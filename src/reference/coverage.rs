//! Which samples a triangle covers, decided exactly.
//!
//! A vertex is given in *pixel-scaled homogeneous form*: (X, Y, w) with X and Y the position in pixels from the screen's
//! centre, y down, times the clip-space w. The three edge functions of such vertices (M. Olano and T. Greer, "Triangle
//! Scan Conversion using 2D Homogeneous Coordinates", 1997) need no clipping: a sample is inside where all three are
//! positive, which also implies a positive w there, whatever the signs of the vertices' w.
//!
//! An edge function E(x, y) = A x + B y + C is oriented so that the inside is positive. A sample on the edge, E = 0, is
//! inside if A > 0, or A = 0 and B > 0: as if every sample lay to the right by an infinitesimal amount, and down by one
//! smaller still. Of triangles that tile a region, exactly one owns each sample of it, edges and corners included.
//!
//! The front is the side from which the vertices run counter-clockwise on the screen (glTF 2.0, section 3.7.2.1). With
//! y down that makes the *facing determinant* -det(v0, v1, v2) positive.

use super::exact::{Pair, difference_of_products, dot, dot_sign};

/// The side of a triangle that a camera sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// The vertices run counter-clockwise.
    Front,
    /// The vertices run clockwise.
    Back,
    /// The triangle is seen edge-on, has no area, or has a coordinate that is not finite: it covers nothing.
    Neither,
}

/// The edge functions of a triangle that faces the camera, or is seen from both sides.
#[derive(Clone, Debug)]
pub struct EdgeFunctions {
    /// A, B and C of the edges opposite the vertices, exactly.
    edges: [[Pair; 3]; 3],
    /// The facing determinant's magnitude.
    determinant: f64,
}

/// The side of a triangle that the camera sees, decided exactly. `vertices` are in pixel-scaled homogeneous form.
pub fn facing(vertices: [[f32; 3]; 3]) -> Facing {
    if !vertices.iter().flatten().all(|v| v.is_finite()) {
        return Facing::Neither;
    }
    let [v0, v1, v2] = vertices.map(|v| v.map(f64::from));
    match dot_sign(&cross(v2, v1), v0) {
        1 => Facing::Front,
        -1 => Facing::Back,
        _ => Facing::Neither,
    }
}

impl EdgeFunctions {
    /// The edge functions of a triangle whose vertices are in pixel-scaled homogeneous form. `None` where the triangle
    /// covers nothing: it faces [neither](Facing::Neither) way, or faces away and is not double-sided.
    pub fn new(vertices: [[f32; 3]; 3], double_sided: bool) -> Option<Self> {
        let [v0, v1, v2] = vertices.map(|v| v.map(f64::from));
        let edges = match facing(vertices) {
            Facing::Front => [cross(v2, v1), cross(v0, v2), cross(v1, v0)],
            Facing::Back if double_sided => [cross(v1, v2), cross(v2, v0), cross(v0, v1)],
            _ => return None,
        };
        // Rounding may differ between the three ways to expand the determinant. The choice must not depend on which
        // vertex comes first, or coincident triangles would differ in depth.
        let by_value =
            |a: &[f64; 3], b: &[f64; 3]| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal);
        let (edge, vertex) = edges
            .iter()
            .zip([v0, v1, v2])
            .min_by(|a, b| by_value(&a.1, &b.1))?;
        let determinant = dot(edge, vertex);
        Some(Self { edges, determinant })
    }

    /// Whether the triangle covers a sample, in pixels from the screen's centre; exact, by the module's rule on edges.
    pub fn covers(&self, [x, y]: [f64; 2]) -> bool {
        self.edges
            .iter()
            .all(|edge| match dot_sign(edge, [x, y, 1.0]) {
                0 => {
                    let [[a, _], [b, _], _] = *edge;
                    a > 0.0 || (a == 0.0 && b > 0.0)
                }
                sign => sign > 0,
            })
    }

    /// How deep inside the triangle a sample lies, in pixels: the least of its signed distances from the lines through
    /// the edges. Inside it is the distance from the nearest edge. Outside it is negative, and the sample is at least
    /// that far from the triangle.
    pub fn margin(&self, [x, y]: [f64; 2]) -> f64 {
        let distances = self.edges.iter().map(|edge| {
            let [[a, _], [b, _], _] = *edge;
            // An edge without a direction (both ends at one place of the screen) is infinitely far.
            dot(edge, [x, y, 1.0]) / a.hypot(b)
        });
        distances.fold(f64::INFINITY, f64::min)
    }

    /// The factors l0, l1, l2 with l0 v0 + l1 v1 + l2 v2 = (x, y, 1), by which any attribute that is linear in clip
    /// space is interpolated: their sum is 1/w at the sample, and with each vertex's clip-space z they give z/w. Each
    /// has a relative error below 2^-49.
    pub fn factors(&self, sample: [f64; 2]) -> [f64; 3] {
        self.values(sample).map(|value| value / self.determinant)
    }

    /// The edge functions at a sample, each rounded once: the factors times the determinant.
    pub(super) fn values(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        self.edges.map(|edge| dot(&edge, [x, y, 1.0]))
    }

    /// The facing determinant's magnitude.
    pub(super) fn determinant(&self) -> f64 {
        self.determinant
    }
}

/// The cross product of two vertices: the coefficients of the function that vanishes on the line through them.
fn cross(a: [f64; 3], b: [f64; 3]) -> [Pair; 3] {
    let [ax, ay, aw] = a;
    let [bx, by, bw] = b;
    [
        difference_of_products(ay, bw, aw, by),
        difference_of_products(aw, bx, ax, bw),
        difference_of_products(ax, by, ay, bx),
    ]
}

//! Coverage: which samples a triangle covers, decided exactly.
//!
//! A vertex is given in *pixel-scaled homogeneous form*: (X, Y, w), where X and Y are the position in pixels from the
//! screen's centre, y down, times the clip-space w. The three edge functions of such vertices (M. Olano and T. Greer,
//! "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997) need no clipping: a sample is inside if all
//! three are positive, which implies a positive w there, whatever the signs of the vertices' w.
//!
//! An edge function E(x, y) = A x + B y + C is positive inside. A sample on the edge, where E = 0, is inside if A > 0,
//! or if A = 0 and B > 0: as if every sample were moved to the right by an infinitesimal distance, and down by a
//! smaller one. Of triangles that tile a region, exactly one owns each sample, on edges and corners too.
//!
//! The front is the side from which the vertices are counter-clockwise on the screen (glTF 2.0, section 3.7.2.1). With
//! y down, the *facing determinant* -det(v0, v1, v2) is then positive.

use super::exact::{Pair, difference_of_products, dot, dot_sign, estimate};

/// The side of a triangle that a camera sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// Front: the vertices are counter-clockwise.
    Front,
    /// Back: the vertices are clockwise.
    Back,
    /// Neither: the triangle is seen edge-on, has no area, or has a coordinate that is not finite. It covers nothing.
    Neither,
}

/// Edge functions of a triangle that faces the camera or is double-sided.
#[derive(Clone, Debug)]
pub struct EdgeFunctions {
    /// Coefficients A, B and C of the edges opposite the vertices, exact.
    edges: [[Pair; 3]; 3],
    /// Absolute value of the facing determinant.
    determinant: f64,
}

/// Side of a triangle that the camera sees, decided exactly. `vertices` are in pixel-scaled homogeneous form.
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
    /// Edge functions of a triangle whose vertices are in pixel-scaled homogeneous form. `None` if the triangle covers
    /// nothing: it faces [neither](Facing::Neither) way, or faces away and is not double-sided.
    pub fn new(vertices: [[f32; 3]; 3], double_sided: bool) -> Option<Self> {
        let [v0, v1, v2] = vertices.map(|v| v.map(f64::from));
        let edges = match facing(vertices) {
            Facing::Front => [cross(v2, v1), cross(v0, v2), cross(v1, v0)],
            Facing::Back if double_sided => [cross(v1, v2), cross(v2, v0), cross(v0, v1)],
            _ => return None,
        };
        // Rounding may differ between the three ways to expand the determinant. The expansion must not depend on which
        // vertex comes first; otherwise coincident triangles would differ in depth.
        let by_value = |a: &[f64; 3], b: &[f64; 3]| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal);
        let (edge, vertex) = edges.iter().zip([v0, v1, v2]).min_by(|a, b| by_value(&a.1, &b.1))?;
        let determinant = dot(edge, vertex);
        Some(Self { edges, determinant })
    }

    /// Whether the triangle covers a sample, given in pixels from the screen's centre. The decision is exact, by the
    /// module's rule for edges.
    pub fn covers(&self, [x, y]: [f64; 2]) -> bool {
        self.edges.iter().all(|edge| match dot_sign(edge, [x, y, 1.0]) {
            0 => {
                let [[a, _], [b, _], _] = *edge;
                a > 0.0 || (a == 0.0 && b > 0.0)
            }
            sign => sign > 0,
        })
    }

    /// Signed distance in pixels from a sample to the border: the smallest of its signed distances from the lines
    /// through the edges. Inside it is the distance from the nearest edge. Outside it is negative, and the sample is
    /// at least that far from the triangle.
    pub fn margin(&self, [x, y]: [f64; 2]) -> f64 {
        let distances = self.edges.iter().map(|edge| {
            let [[a, _], [b, _], _] = *edge;
            // An edge whose ends are at the same place on the screen has no direction, and counts as infinitely far.
            estimate(edge, [x, y, 1.0]) / a.hypot(b)
        });
        distances.fold(f64::INFINITY, f64::min)
    }

    /// Factors l0, l1, l2 with l0 v0 + l1 v1 + l2 v2 = (x, y, 1). They interpolate any attribute that is linear in
    /// clip space: their sum is 1/w at the sample, and with each vertex's clip-space z they give z/w. The relative
    /// error of each is below 2^-49.
    pub fn factors(&self, sample: [f64; 2]) -> [f64; 3] {
        self.values(sample).map(|value| value / self.determinant)
    }

    /// Values of the edge functions at a sample, each rounded once: the factors times the determinant.
    pub(super) fn values(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        self.edges.map(|edge| dot(&edge, [x, y, 1.0]))
    }

    /// Absolute value of the facing determinant.
    pub(super) fn determinant(&self) -> f64 {
        self.determinant
    }
}

/// Cross product of two vertices: the coefficients of the function that vanishes on the line through them.
fn cross(a: [f64; 3], b: [f64; 3]) -> [Pair; 3] {
    let [ax, ay, aw] = a;
    let [bx, by, bw] = b;
    [
        difference_of_products(ay, bw, aw, by),
        difference_of_products(aw, bx, ax, bw),
        difference_of_products(ax, by, ay, bx),
    ]
}

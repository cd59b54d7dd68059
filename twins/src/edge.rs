//! Areas of a pixel behind straight edges and in triangles.
//!
//! A pixel is the unit square around its centre, x to the right, y down. A line `[a, b, c]` bounds the half-plane of
//! the points (x, y), in pixels from the centre, with a x + b y + c > 0.

/// Area of the pixel that lies in a half-plane, 0 to 1.
///
/// A line with a = b = 0 has no direction: its half-plane is the whole plane if c > 0, and empty otherwise.
pub fn half_plane_area([a, b, c]: [f64; 3]) -> f64 {
    let (wide, narrow) = (a.abs().max(b.abs()), a.abs().min(b.abs()));
    // Values of c at which the line passes through the nearer and the farther pair of corners.
    let (near, far) = ((wide - narrow) / 2.0, (wide + narrow) / 2.0);
    let distance = c.abs();
    let smaller = if distance >= far {
        0.0
    } else if distance <= near {
        // The line leaves through two opposite sides, and cuts off a trapezium.
        0.5 - distance / wide
    } else {
        // The line cuts off one corner, a triangle.
        (far - distance).powi(2) / (2.0 * wide * narrow)
    };
    if c > 0.0 { 1.0 - smaller } else { smaller }
}

/// Area of the pixel that lies in all of the half-planes, 0 to 1. The square is clipped by each of them (Sutherland
/// and Hodgman, "Reentrant Polygon Clipping", 1974).
pub fn clipped_area(lines: &[[f64; 3]]) -> f64 {
    let square = vec![[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    let polygon = lines.iter().fold(square, |polygon, line| clip(&polygon, line));
    let twice: f64 = sides(&polygon).map(|([x0, y0], [x1, y1])| x0 * y1 - x1 * y0).sum();
    twice.max(0.0) / 2.0
}

/// Area of the pixel with centre (x, y) that a triangle covers, 0 to 1. All coordinates are in pixels and finite; the
/// winding does not matter.
pub fn triangle_area(corners: [[f64; 2]; 3], [x, y]: [f64; 2]) -> f64 {
    let [p, q, r] = corners.map(|corner| [corner[0] - x, corner[1] - y]);
    let turn = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    if turn == 0.0 {
        return 0.0;
    }
    let lines = [(p, q), (q, r), (r, p)].map(|(from, to)| {
        let [a, b] = [(from[1] - to[1]) * turn.signum(), (to[0] - from[0]) * turn.signum()];
        [a, b, -a * from[0] - b * from[1]]
    });
    clipped_area(&lines)
}

/// Part of a convex polygon that lies in a half-plane.
fn clip(polygon: &[[f64; 2]], &[a, b, c]: &[f64; 3]) -> Vec<[f64; 2]> {
    let height = |[x, y]: [f64; 2]| a * x + b * y + c;
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (from, to) in sides(polygon) {
        let (start, end) = (height(from), height(to));
        if start > 0.0 {
            kept.push(from);
        }
        if (start > 0.0) != (end > 0.0) {
            let t = start / (start - end);
            kept.push([from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])]);
        }
    }
    kept
}

/// Sides of a polygon, each as its two ends.
fn sides(polygon: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

//! The area of a triangle within a pixel.

/// The area that a triangle, by its projected vertices in pixels, has in common with the square of side 1 around
/// `centre`; 0 to 1.
#[must_use]
pub fn in_pixel(vertices: [[f64; 2]; 3], centre: [f64; 2]) -> f64 {
    let mut polygon: Vec<[f64; 2]> = vertices
        .iter()
        .map(|v| [v[0] - centre[0], v[1] - centre[1]])
        .collect();
    // Sutherland and Hodgman, "Reentrant Polygon Clipping" (1974).
    for (axis, side) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
        let inside = |p: &[f64; 2]| side * p[axis] <= 0.5;
        let mut clipped = Vec::new();
        for (index, p) in polygon.iter().enumerate() {
            let q = polygon[(index + 1) % polygon.len()];
            if inside(p) {
                clipped.push(*p);
            }
            if inside(p) != inside(&q) {
                let t = (0.5 * side - p[axis]) / (q[axis] - p[axis]);
                let mut crossing = [p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])];
                crossing[axis] = 0.5 * side;
                clipped.push(crossing);
            }
        }
        polygon = clipped;
    }
    let twice: f64 = (0..polygon.len())
        .map(|index| {
            let (p, q) = (polygon[index], polygon[(index + 1) % polygon.len()]);
            p[0] * q[1] - p[1] * q[0]
        })
        .sum();
    0.5 * twice.abs()
}

#[cfg(test)]
mod tests {
    use super::in_pixel;

    #[test]
    fn areas_of_known_shapes() {
        let half = [[-10.0, -10.0], [10.0, -10.0], [-10.0, 10.0]];
        assert!((in_pixel(half, [0.0, 0.0]) - 0.5).abs() < 1e-12);
        assert!((in_pixel(half, [-2.0, -2.0]) - 1.0).abs() < 1e-12);
        assert!(in_pixel(half, [2.0, 2.0]) == 0.0);
        let small = [[3.0, 3.0], [3.25, 3.0], [3.0, 3.5]];
        assert!((in_pixel(small, [3.1, 3.1]) - 0.0625).abs() < 1e-12);
        assert!((in_pixel(small, [3.5, 3.0]) - 0.0625).abs() < 1e-12);
    }
}

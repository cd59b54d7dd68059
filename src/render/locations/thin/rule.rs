//! Which cells a thin triangle makes superpixels of: the rule of `shaders/thin.comp`, for cells of any shape.
//!
//! A triangle is thin in a cell if its height over its longest side is below [`THIN`], both measured with the cell as the
//! unit. Where it crosses a cell, the cell is marked if
//!
//! - all of the triangle that lies there is nearer than what the cell shows, by more than the cell's width: it stands
//!   **apart**; or
//! - some of it may be nearer, and it is **painted** on a surface: the cell lies amid another triangle, which it and both
//!   its neighbours to the sides, or above and below, show.
//!
//! On a dense mesh each small triangle lies within its neighbours' surface, and marks nothing.

/// Height over the longest side, in cells, that thin triangles stay below: a wider one is seen by some cell.
pub const THIN: f64 = 1.5;

/// How a thin triangle crosses a cell. Nearness is linear over the plane and larger for what is nearer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Least and largest nearness of the triangle within the cell.
    pub nearness: [f64; 2],
    /// Nearness of the surface that the cell shows.
    pub behind: f64,
    /// Difference of nearness that is a cell's width in front of the triangle's farthest place.
    pub gap: f64,
    /// Whether the triangle is the nearest BLEND layer that the cell shows.
    pub layer: bool,
}

impl Crossing {
    /// Whether the cell becomes a superpixel; `amid_another` tells whether it lies amid another triangle.
    pub fn marks(&self, amid_another: impl FnOnce() -> bool) -> bool {
        let [farthest, nearest] = self.nearness;
        let apart = farthest - self.behind > self.gap;
        !self.layer && (apart || nearest >= self.behind && amid_another())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Before a surface at nearness 1, a cell's width being 0.1.
    fn over_surface(farthest: f64, nearest: f64) -> Crossing {
        Crossing {
            nearness: [farthest, nearest],
            behind: 1.0,
            gap: 0.1,
            layer: false,
        }
    }

    #[test]
    fn the_threshold_is_the_shaders() {
        let shader = include_str!("../../../../shaders/thin.comp");
        assert!(shader.contains(&format!("const float THIN = {THIN:?};")));
    }

    #[test]
    fn a_wire_apart_from_the_wall_is_marked() {
        let cases = [
            ([1.2, 1.3], true),
            ([1.05, 1.3], false), // some of it touches the wall
            ([0.8, 0.9], false),  // behind
        ];
        for ([farthest, nearest], expected) in cases {
            let marks = over_surface(farthest, nearest).marks(|| false);
            assert_eq!(marks, expected, "{farthest} to {nearest}");
        }
        // Nothing is behind it: perspective, and parallel rays.
        for behind in [0.0, f64::NEG_INFINITY] {
            let free = Crossing {
                behind,
                ..over_surface(0.8, 0.9)
            };
            assert!(free.marks(|| false));
        }
    }

    #[test]
    fn paint_is_marked_amid_another_triangle() {
        let paint = over_surface(0.99, 1.0);
        assert!(paint.marks(|| true));
        assert!(!paint.marks(|| false));
        assert!(!over_surface(0.98, 0.999).marks(|| true), "surely hidden");
    }

    #[test]
    fn a_layer_that_the_cell_shows_is_not_marked() {
        let layer = Crossing {
            layer: true,
            ..over_surface(1.5, 1.6)
        };
        assert!(!layer.marks(|| true));
    }
}

//! Which cells a thin triangle makes superpixels of: the rule of `shaders/thin.comp`, for cells of any shape.
//!
//! A triangle is thin in a cell if its height over its longest side is below [`THIN`], both measured with the cell as the
//! unit. Where it crosses a cell that does not show it, the cell is marked if
//!
//! - all of the triangle that lies there is nearer than what the cell shows, by more than the cell's width: it stands
//!   **apart**; or
//! - some of it may be nearer, and it is **painted** on that surface: it contrasts with what the cell shows in the
//!   colour that it was last seen in along its way. Where no cell shows the triangle, it counts as painted amid a larger
//!   one, where the cell and its four neighbours show the same triangle.
//!
//! On a dense mesh each small triangle lies within its neighbours' surface, and marks nothing.

/// Height over the longest side, in cells, that thin triangles stay below: a wider one is seen by some cell.
pub const THIN: f64 = 1.5;

/// A cell that a thin triangle crosses. Nearness is linear over the plane and larger for what is nearer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Index of the output cell.
    pub cell: u32,
    /// Whether the triangle is the nearest opaque or MASK one there.
    pub seen: bool,
    /// Whether it is the nearest BLEND layer there.
    pub layer: bool,
    /// The colour that the cell shows: 8-bit sRGB codes, red in the lowest byte.
    pub code: u32,
    /// Least and largest nearness of the triangle within the cell.
    pub nearness: [f64; 2],
    /// Nearness of the surface that the cell shows.
    pub behind: f64,
    /// Difference of nearness that is a cell's width in front of the triangle's farthest place.
    pub gap: f64,
}

/// The cells to mark of those that one triangle crosses, given in the order of its longer side. `contrast` is the
/// threshold between two colours in code values, `None` where colours do not count; `amid_one` tells whether a cell and
/// its four neighbours show the same triangle.
pub fn marked(
    crossings: &[Crossing],
    contrast: Option<u8>,
    amid_one: impl Fn(u32) -> bool,
) -> impl Iterator<Item = u32> {
    // Before any cell shows the triangle, its colour is that of the first that will.
    let first = crossings.iter().find(|at| at.seen);
    let mut own = first.filter(|_| contrast.is_some()).map(|at| at.code);
    crossings.iter().filter_map(move |at| {
        if at.seen {
            own = own.and(Some(at.code));
            return None;
        }
        let [farthest, nearest] = at.nearness;
        let apart = farthest - at.behind > at.gap;
        let painted = || match (own, contrast) {
            (Some(own), Some(threshold)) => contrasting(own, at.code, threshold),
            _ => amid_one(at.cell),
        };
        let marks = !at.layer && (apart || nearest >= at.behind && painted());
        marks.then_some(at.cell)
    })
}

/// Whether a colour channel differs by more than the threshold.
fn contrasting(a: u32, b: u32, threshold: u8) -> bool {
    let channels = a.to_le_bytes().into_iter().zip(b.to_le_bytes());
    channels.take(3).any(|(a, b)| a.abs_diff(b) > threshold)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GREY: u32 = 0xff80_8080;
    const CONTRAST: Option<u8> = Some(12);

    /// A cell that shows a grey surface at nearness 1, a cell's width being 0.1, where the triangle's reaches from
    /// `farthest` to `nearest`.
    fn over_grey(cell: u32, farthest: f64, nearest: f64) -> Crossing {
        Crossing {
            cell,
            seen: false,
            layer: false,
            code: GREY,
            nearness: [farthest, nearest],
            behind: 1.0,
            gap: 0.1,
        }
    }

    fn seen(cell: u32, code: u32) -> Crossing {
        Crossing {
            seen: true,
            code,
            ..over_grey(cell, 1.0, 1.0)
        }
    }

    fn marks(crossings: &[Crossing], contrast: Option<u8>, amid_one: bool) -> Vec<u32> {
        marked(crossings, contrast, |_| amid_one).collect()
    }

    #[test]
    fn the_threshold_is_the_shaders() {
        let shader = include_str!("../../../../shaders/thin.comp");
        assert!(shader.contains(&format!("const float THIN = {THIN:?};")));
    }

    #[test]
    fn a_wire_apart_from_the_wall_is_marked() {
        let wire = [
            over_grey(3, 1.2, 1.3),
            over_grey(4, 1.05, 1.3), // some of it touches the wall
            over_grey(5, 0.8, 0.9),  // behind
        ];
        assert_eq!(marks(&wire, CONTRAST, false), [3]);
        // Nothing is behind it: perspective, and parallel rays.
        for behind in [0.0, f64::NEG_INFINITY] {
            let free = Crossing { behind, ..wire[2] };
            assert_eq!(marks(&[free], CONTRAST, false), [5]);
        }
    }

    #[test]
    fn what_a_cell_shows_is_not_marked() {
        let layer = Crossing {
            layer: true,
            ..over_grey(7, 1.5, 1.6)
        };
        assert_eq!(marks(&[seen(6, 0), layer], CONTRAST, true), [0_u32; 0]);
    }

    #[test]
    fn paint_is_marked_where_it_contrasts() {
        let faint = GREY + 12;
        let strong = GREY + (13 << 16);
        let line = |code| {
            [
                over_grey(0, 1.0, 1.0),
                seen(1, code),
                over_grey(2, 1.0, 1.0),
                over_grey(3, 0.8, 0.9), // surely hidden
            ]
        };
        assert_eq!(marks(&line(strong), CONTRAST, true), [0, 2]);
        assert_eq!(marks(&line(faint), CONTRAST, true), [0_u32; 0]);
        // Colours count by the cell that showed the triangle last.
        let fading = [seen(0, faint), over_grey(1, 1.0, 1.0), seen(2, strong)];
        assert_eq!(marks(&fading, CONTRAST, true), [0_u32; 0]);
        let after = [seen(0, faint), seen(1, strong), over_grey(2, 1.0, 1.0)];
        assert_eq!(marks(&after, CONTRAST, true), [2]);
    }

    #[test]
    fn paint_that_no_cell_shows_is_marked_amid_one_triangle() {
        let line = [over_grey(0, 1.0, 1.0), over_grey(1, 1.0, 1.0)];
        assert_eq!(marks(&line, CONTRAST, true), [0, 1]);
        assert_eq!(marks(&line, CONTRAST, false), [0_u32; 0]);
        // Colours that do not count tell nothing of the next cell.
        let line = [seen(0, 0), over_grey(1, 1.0, 1.0)];
        assert_eq!(marks(&line, None, true), [1]);
        assert_eq!(marks(&line, None, false), [0_u32; 0]);
    }
}
